// A patch of one or several triangles on its way into a welded shape: which of its points lie along
// which side, and the upper halves of identities, which the stream has no use for.
//
// Triangle t has vertices 3 t .. 3 t + 2, and sides with the same numbers: side 3 t + k from corner
// k to corner k + 1. Triangles of one group share nothing in the patch.
//
// Owned by one thread at a time. Tables keep their memory.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/random.h"
#include "engine/fractal/patch.h"

namespace fjord {

class SurfaceGroup {
 public:
  void Clear(bool colored, size_t most_vertices);
  // Sites of the next triangle: its inside, then its sides. All before the first step.
  void AddSites(const std::array<EdgeSite, 4>& sites);
  const EdgeSite* SitesOf(size_t triangle) const { return &sites_[4 * triangle]; }
  // For triangles to be loaded into.
  Patch& patch() { return patch_; }
  const Patch& patch() const { return patch_; }

  // Splits until nothing is long; false where there are more points than allowed. `level`: of the
  // triangles.
  bool Expand(const SurfaceRules& rules, uint32_t level);
  // The same; afterwards UpperOf and LevelOf answer too. `corners`: upper halves of the identities
  // of all corners.
  bool Expand(const SurfaceRules& rules, uint32_t level, std::span<const uint64_t> corners);

  // How many points a side has between its corners.
  uint32_t CountAlong(size_t side) const { return along_[side]; }
  // Those points, from the side's first corner to its second. Good until the next call.
  std::span<const uint32_t> Along(size_t side);

  Identity IdentityOf(size_t vertex) const {
    return {patch_.vertices.value[vertex].id, upper_[vertex]};
  }
  uint8_t LevelOf(size_t vertex) const { return level_[vertex]; }

 private:
  static constexpr uint32_t kNone = 0xffffffffu;

  // A piece of a side, with the two that it was split into.
  struct Piece {
    uint32_t edge;
    uint32_t side;
    uint32_t middle;  // vertex, or kNone
    uint32_t halves;  // pieces `halves` and `halves` + 1
  };

  void Begin();
  // After a step: the pieces that it split.
  void Follow();
  void Collect(uint32_t piece);

  Patch patch_;
  std::vector<EdgeSite> sites_;
  std::vector<Piece> pieces_;
  std::vector<uint32_t> whole_;  // pieces that a later step may split
  std::vector<uint32_t> along_;
  std::vector<uint64_t> upper_;
  std::vector<uint8_t> level_;
  std::vector<uint32_t> chain_;
};

}  // namespace fjord
