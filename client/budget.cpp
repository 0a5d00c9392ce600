#include "client/budget.h"

#include <charconv>
#include <utility>

#include "engine/scene/locate.h"

namespace fjord {
namespace {

constexpr double kWorthIt = .25;  // of the leaves, with the other split

// What the frame would make if an object under split SHOT, as fine all along as the nearest frame
// of the shot asks for, were split ADAPTIVE, by each frame's own camera. Negative: there is no
// telling.
double AdaptiveEstimate(const Animation& animation, int object, uint32_t frame,
                        const SceneOrigin& origin) {
  const v1::Object& asked = animation.scene().objects(object);
  if (asked.fractal().split() != v1::Fractal::SHOT || asked.fractal().has_epsilon()) return -1;
  std::vector<Setting> settings = origin.settings;
  settings.push_back({"objects[" + asked.name() + "].fractal.split", "ADAPTIVE"});
  LoadResult loaded = LoadSceneFile(origin.file, settings);
  if (!loaded.ok()) return -1;
  const auto adaptive = Animation::Make(std::move(loaded.loaded));
  if (!adaptive.ok()) return -1;
  AssetSet assets;
  const Result<v1::FrameScene> scene = (*adaptive)->Inbetween(frame, &assets);
  if (!scene.ok()) return -1;
  const Result<ObjectEstimate> estimate = EstimateObject(*scene, &assets, object);
  return estimate.ok() ? estimate->in_view : -1;
}

}  // namespace

std::string AdaptiveAdvice(const Animation& animation, int object, uint32_t frame, double leaves,
                           const SceneOrigin& origin) {
  const double adaptive = AdaptiveEstimate(animation, object, frame, origin);
  if (!(adaptive >= 0 && adaptive <= kWorthIt * leaves)) return "";
  return "split: ADAPTIVE, by each frame's own camera, would make about " + LeavesText(adaptive);
}

void AddBudget(CLI::App* command, std::string* budget, const std::string& fallback) {
  command->add_option("--budget", *budget,
                      "Triangles a frame may have by estimate, or unlimited; default " + fallback);
}

Result<double> ParseBudget(const std::string& text, double otherwise) {
  if (text.empty()) return otherwise;
  if (text == "unlimited") return kNoBudget;
  double budget = 0;
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, budget);
  if (error != std::errc() || stopped != end || !(budget > 0)) {
    return MakeError(ErrorCode::kUsage,
                     "--budget " + text + ": write a number above 0, as 5e9, or unlimited");
  }
  return budget;
}

Result<> CheckFrameBudget(const Animation& animation, const v1::FrameScene& frame,
                          const AssetResolver* assets, uint32_t number, double budget,
                          Counted counted, const SceneOrigin& origin) {
  if (budget >= kNoBudget) return Ok{};
  OverBudget over;
  const Result<> held = HoldAgainstBudget(frame, assets, animation.scene(), budget, counted,
                                          "--budget lifts it", &over);
  if (!held.ok()) return InScene(held.error(), origin.file);
  if (over.message.empty()) return Ok{};
  const Route object = Route().Then("objects", over.object);
  const Route knob =
      over.knob.empty() ? object.Then("shape") : object.Then("fractal").Then(over.knob);
  std::string message = "frame " + std::to_string(number) + ": " +
                        PrintRoute(animation.scene(), object) + ": " + over.message;
  const std::string adaptive = AdaptiveAdvice(animation, over.object, number, budget, origin);
  if (!adaptive.empty()) message += "; " + adaptive;
  return MakeError(ErrorCode::kLimit, message, LocateField(origin.file, origin.settings, knob));
}

}  // namespace fjord
