#include "server/engine_planner.h"

#include "engine/animation/estimate.h"
#include "engine/animation/frame_key.h"
#include "engine/scene/load.h"

namespace fjord::server {
namespace {

constexpr size_t kAnimationsKept = 4;
constexpr size_t kErrorsShown = 10;

Error Together(const Errors& errors) {
  Error all = errors.front();
  all.message.clear();
  for (size_t i = 0; i < errors.size() && i < kErrorsShown; ++i) {
    if (i > 0) all.message += "\n";
    all.message += errors[i].ToString();
  }
  if (errors.size() > kErrorsShown) {
    all.message += "\nand " + std::to_string(errors.size() - kErrorsShown) + " more";
  }
  all.place = {};
  return all;
}

}  // namespace

Result<std::shared_ptr<const Animation>> EnginePlanner::AnimationOf(const Digest& scene) {
  for (auto entry = recent_.begin(); entry != recent_.end(); ++entry) {
    if (entry->first != scene) continue;
    recent_.splice(recent_.begin(), recent_, entry);
    return entry->second;
  }
  const Result<std::string> bytes = blobs_.Get(scene, kMaxSceneBytes);
  if (!bytes.ok()) return bytes.error();
  LoadResult loaded =
      LoadSceneBinary(*bytes, "scene", [this](const v1::File& file) -> Result<std::string> {
        const std::optional<Digest> digest = ParseDigest(file.digest());
        if (!digest) return Invalid("file \"" + file.path() + "\" has no digest");
        return blobs_.Get(*digest, kMaxAssetBytes);
      });
  if (!loaded.ok()) return Together(loaded.errors);
  Result<std::shared_ptr<const Animation>> animation =
      Animation::Make(std::move(loaded.loaded), &stop_);
  if (!animation.ok()) return animation;
  recent_.emplace_front(scene, *animation);
  if (recent_.size() > kAnimationsKept) recent_.pop_back();
  return animation;
}

Result<uint32_t> EnginePlanner::LastFrame(const Digest& scene) {
  const Result<std::shared_ptr<const Animation>> animation = AnimationOf(scene);
  if (!animation.ok()) return animation.error();
  return animation.value()->last_frame();
}

Result<Digest> EnginePlanner::KeyOf(const Digest& scene, uint32_t frame) {
  const Result<std::shared_ptr<const Animation>> animation = AnimationOf(scene);
  if (!animation.ok()) return animation.error();
  AssetSet assets;
  const Result<v1::FrameScene> inbetween = animation.value()->Inbetween(frame, &assets);
  if (!inbetween.ok()) return inbetween.error();
  const v1::Scene& whole = animation.value()->scene();
  OverBudget over;
  const Result<> held =
      HoldAgainstBudget(*inbetween, &assets, whole, frame_budget_, Counted::kInView,
                        "the coordinator's --budget lifts it", &over);
  if (!held.ok()) return held.error();
  if (!over.message.empty()) {
    return MakeError(ErrorCode::kLimit,
                     "objects[" + whole.objects(over.object).name() + "]: " + over.message);
  }
  return FrameKey(*inbetween);
}

}  // namespace fjord::server
