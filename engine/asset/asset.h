// The long lists of a frame scene (points, faces, colours, heights, placements) as values that are
// named by the digest of their samples, so that a frame scene stays small and a list that stays is
// digested once.
//
// Ownership: assets are immutable and shared. Threads: any number may read.
//
// Invariants
// A1 The digest covers the kind, the counts and every sample, as docs/frame_key.md says byte by
//    byte: equal samples have equal digests on every machine. -0 counts as +0.
// A2 What an AssetSet was given stays until the set goes: no frame loses a list while it is drawn.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <variant>
#include <vector>

#include "engine/base/digest.h"
#include "engine/base/result.h"
#include "engine/geometry/heights.h"
#include "engine/geometry/vec.h"

namespace fjord {

// As in Mesh: face f has size[f] entries of vertex.
struct FaceList {
  std::vector<uint32_t> size;
  std::vector<uint32_t> vertex;
};

using PointList = std::vector<Vec3>;
using ColorList = std::vector<Rgb>;
using HeightSamples = std::shared_ptr<const HeightSource>;
using Rows = std::array<double, 12>;  // 3 rows of 4: an affine map
using PlacementList = std::vector<Rows>;
using AssetData = std::variant<PointList, FaceList, ColorList, HeightSamples, PlacementList>;

struct Asset {
  AssetData data;
  Digest digest;
  uint64_t numbers = 0;  // in the list
};
using SharedAsset = std::shared_ptr<const Asset>;

SharedAsset MakeAsset(AssetData data);

// Where the lists behind a frame scene's digests come from.
class AssetResolver {
 public:
  virtual ~AssetResolver() = default;
  // kNotFound where it is not at hand.
  virtual Result<SharedAsset> Find(const Digest& digest) const = 0;
};

// The lists of one frame or a few. Fill it from one thread; then any number may read.
class AssetSet final : public AssetResolver {
 public:
  void Add(SharedAsset asset);
  Result<SharedAsset> Find(const Digest& digest) const override;
  size_t size() const { return assets_.size(); }

 private:
  std::map<Digest, SharedAsset> assets_;
};

}  // namespace fjord
