#include "client/look_ahead.h"

#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "engine/base/clamp.h"
#include "engine/render/build.h"
#include "engine/render/shadow_draw.h"
#include "engine/scene/locate.h"
#include "engine/scene/track.h"

namespace fjord {
namespace {

constexpr uint32_t kEvenLooks = 24;
constexpr size_t kMostLooks = 96;   // with those at keys
constexpr size_t kMostBuilds = 12;  // frames whose objects are prepared
constexpr double kLarge = 1e8;      // leaves in view, some seconds of one core: worth advice

std::vector<double> KeyFramesOf(const v1::Scene& scene) {
  std::vector<double> keys = TrackSet(scene).KeyFrames();
  for (const v1::Object& object : scene.objects()) {
    for (const v1::Key& key : object.key()) keys.push_back(key.frame());
  }
  return keys;
}

// An even choice of some of a sorted list, its ends among them.
std::vector<uint32_t> Some(const std::vector<uint32_t>& list, size_t most) {
  if (list.size() <= most) return list;
  std::vector<uint32_t> some;
  for (size_t i = 0; i < most; ++i) some.push_back(list[i * (list.size() - 1) / (most - 1)]);
  return some;
}

std::vector<uint32_t> FramesToLookAt(const v1::Scene& scene, const FrameSet& frames) {
  std::set<uint32_t> at_keys;
  for (const double key : KeyFramesOf(scene)) {
    for (const int32_t frame : {FloorToInt32(key), -FloorToInt32(-key)}) {
      const auto number = static_cast<uint32_t>(std::max(frame, 1));
      if (frames.Contains(number)) at_keys.insert(number);
    }
  }
  const std::vector<uint32_t> some =
      Some({at_keys.begin(), at_keys.end()}, kMostLooks - kEvenLooks);
  std::set<uint32_t> chosen(some.begin(), some.end());
  const uint32_t last = frames.size() - 1;
  const uint32_t looks = std::min(last, kEvenLooks - 1);
  for (uint32_t i = 0; i <= looks; ++i) {
    chosen.insert(frames[looks == 0 ? 0 : static_cast<uint32_t>(uint64_t{last} * i / looks)]);
  }
  return {chosen.begin(), chosen.end()};
}

// What the renderer says of a frame before it draws anything.
Result<> TryToBuild(const v1::FrameScene& scene, const AssetSet& assets, uint32_t frame,
                    const SceneOrigin& origin) {
  const auto at_frame = [&](Error error) {
    error.message = "frame " + std::to_string(frame) + ": " + error.message;
    return InScene(std::move(error), origin.file);
  };
  const Result<BuiltFrame> built = BuildFrame(scene, &assets);
  if (!built.ok()) return at_frame(built.error());
  const std::optional<ShadowDefect> defect = FindShadowDefect(*built);
  if (!defect) return Ok{};
  Error error = at_frame(defect->error);
  error.place =
      LocateField(origin.file, origin.settings,
                  Route().Then("lights", static_cast<int>(defect->light)).Then("shadow_detail"));
  return error;
}

// For the frame that makes most.
std::string AdviceFor(const Animation& animation, const FrameEstimate& worst, uint32_t frame,
                      const SceneOrigin& origin) {
  const auto largest = std::max_element(
      worst.objects.begin(), worst.objects.end(),
      [](const ObjectEstimate& a, const ObjectEstimate& b) { return a.in_view < b.in_view; });
  if (largest == worst.objects.end() || largest->in_view < kLarge) return "";
  const auto object = static_cast<int>(largest - worst.objects.begin());
  const std::string adaptive = AdaptiveAdvice(animation, object, frame, largest->in_view, origin);
  if (adaptive.empty()) return "";
  const Route route = Route().Then("objects", object);
  return LocateField(origin.file, origin.settings, route.Then("fractal")).ToString() +
         ": note: frame " + std::to_string(frame) + ": " + PrintRoute(animation.scene(), route) +
         ": split SHOT, as fine all along as the nearest frame asks for, makes about " +
         LeavesText(largest->in_view) + " triangles; " + adaptive;
}

}  // namespace

Result<> LookAtFrames(const Animation& animation, const FrameSet& frames, double budget,
                      const SceneOrigin& origin, LookAhead* found) {
  const std::vector<uint32_t> looked_at = FramesToLookAt(animation.scene(), frames);
  uint32_t worst = 0;
  for (const uint32_t frame : looked_at) {
    AssetSet assets;
    const Result<v1::FrameScene> scene = animation.Inbetween(frame, &assets);
    if (!scene.ok()) return InScene(scene.error(), origin.file);
    Result<FrameEstimate> estimate = EstimateFrame(*scene, &assets);
    if (!estimate.ok()) return InScene(estimate.error(), origin.file);
    const ObjectEstimate &now = estimate->all, &most = found->worst.all;
    if (worst == 0 || now.in_view > most.in_view ||
        (now.in_view == most.in_view && now.leaves > most.leaves)) {
      found->worst = std::move(*estimate);
      worst = frame;
    }
    Result<> held =
        CheckFrameBudget(animation, *scene, &assets, frame, budget, Counted::kInView, origin);
    if (!held.ok()) return held;
  }
  std::vector<uint32_t> built = Some(looked_at, kMostBuilds);
  built.push_back(worst);
  for (const uint32_t frame : built) {
    AssetSet assets;
    const Result<v1::FrameScene> scene = animation.Inbetween(frame, &assets);
    if (!scene.ok()) return InScene(scene.error(), origin.file);
    if (Result<> tried = TryToBuild(*scene, assets, frame, origin); !tried.ok()) return tried;
  }
  found->advice = AdviceFor(animation, found->worst, worst, origin);
  return Ok{};
}

}  // namespace fjord
