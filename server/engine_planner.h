// The planner's engine: scenes and assets from the blob store, inbetweens and keys from the engine.
#pragma once

#include <atomic>
#include <list>
#include <memory>
#include <utility>

#include "engine/animation/inbetween.h"
#include "server/blob_store.h"
#include "server/planner.h"

namespace fjord::server {

inline constexpr uint64_t kMaxSceneBytes = uint64_t{64} << 20;
inline constexpr uint64_t kMaxAssetBytes = uint64_t{1} << 30;

// Frames that by estimate have more leaves than `frame_budget` are refused before anyone renders
// them. For one thread, but for Stop. Keeps the last few animations.
class EnginePlanner : public FramePlanner {
 public:
  EnginePlanner(BlobStore& blobs, double frame_budget)
      : blobs_(blobs), frame_budget_(frame_budget) {}

  Result<uint32_t> LastFrame(const Digest& scene) override;
  Result<Digest> KeyOf(const Digest& scene, uint32_t frame) override;
  void Stop() override { stop_ = true; }

 private:
  Result<std::shared_ptr<const Animation>> AnimationOf(const Digest& scene);

  BlobStore& blobs_;
  const double frame_budget_;
  std::atomic<bool> stop_{false};
  std::list<std::pair<Digest, std::shared_ptr<const Animation>>> recent_;
};

}  // namespace fjord::server
