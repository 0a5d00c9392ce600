// The planner's engine: scenes and assets from the blob store, inbetweens and keys from the engine.
#pragma once

#include <list>
#include <memory>
#include <utility>

#include "engine/animation/inbetween.h"
#include "server/blob_store.h"
#include "server/planner.h"

namespace fjord::server {

inline constexpr uint64_t kMaxSceneBytes = uint64_t{64} << 20;
inline constexpr uint64_t kMaxAssetBytes = uint64_t{1} << 30;

// For one thread. Keeps the last few animations.
class EnginePlanner : public FramePlanner {
 public:
  explicit EnginePlanner(const BlobStore& blobs) : blobs_(blobs) {}

  Result<uint32_t> LastFrame(const Digest& scene) override;
  Result<Digest> KeyOf(const Digest& scene, uint32_t frame) override;

 private:
  Result<std::shared_ptr<const Animation>> AnimationOf(const Digest& scene);

  const BlobStore& blobs_;
  std::list<std::pair<Digest, std::shared_ptr<const Animation>>> recent_;
};

}  // namespace fjord::server
