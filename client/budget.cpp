#include "client/budget.h"

#include <charconv>

#include "engine/scene/locate.h"

namespace fjord {
namespace {

constexpr uint32_t kFramesLookedAt = 24;

}  // namespace

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
  return MakeError(ErrorCode::kLimit,
                   "frame " + std::to_string(number) + ": " +
                       PrintRoute(animation.scene(), object) + ": " + over.message,
                   LocateField(origin.file, origin.settings, knob));
}

Result<> CheckBudget(const Animation& animation, const FrameSet& frames, double budget,
                     Counted counted, const SceneOrigin& origin, FrameEstimate* worst) {
  const uint32_t last = frames.size() - 1;
  const uint32_t looks = std::min(last, kFramesLookedAt - 1);
  for (uint32_t i = 0; i <= looks; ++i) {
    const uint32_t frame =
        frames[looks == 0 ? 0 : static_cast<uint32_t>(uint64_t{last} * i / looks)];
    AssetSet assets;
    const Result<v1::FrameScene> scene = animation.Inbetween(frame, &assets);
    if (!scene.ok()) return InScene(scene.error(), origin.file);
    if (worst != nullptr) {
      Result<FrameEstimate> estimate = EstimateFrame(*scene, &assets);
      if (!estimate.ok()) return InScene(estimate.error(), origin.file);
      if (worst->objects.empty() || estimate->all.leaves > worst->all.leaves) {
        *worst = std::move(*estimate);
      }
    }
    Result<> held = CheckFrameBudget(animation, *scene, &assets, frame, budget, counted, origin);
    if (!held.ok()) return held;
  }
  return Ok{};
}

}  // namespace fjord
