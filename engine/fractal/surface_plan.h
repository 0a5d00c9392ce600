// What a surface is cut into to be welded: triangles that each become a patch of their own, and the
// borders that they share, as trees of halves. Counting makes every patch once, so that the numbers
// of all points and leaves are known, and a shape beyond the limit is refused, before any is kept.
//
// Made by one thread, which may use others while it counts; afterwards any number may read it and
// call Expand.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "engine/fractal/surface_group.h"
#include "engine/fractal/surface_weld.h"

namespace fjord {

class SurfacePlan {
 public:
  static constexpr uint32_t kNone = 0xffffffffu;

  // What two triangles share: an edge from point a to point b. Where a neighbour was cut through
  // it, it has a middle and two halves; otherwise `count` points from `first` on lie along it.
  struct Border {
    uint32_t a = 0, b = 0;
    uint32_t middle = kNone;
    uint32_t half[2] = {kNone, kNone};
    uint32_t first = 0, count = 0;
    uint32_t side = kNone;  // that writes its points: 3 * part + k
    bool coast = false;
  };

  // A border as a triangle runs along it.
  struct Side {
    uint32_t border = 0;
    bool against = false;

    Side Half(const Border& whole, int k) const {
      return {whole.half[against ? 1 - k : k], against};
    }
  };

  // A triangle that is expanded at once.
  struct Part {
    uint32_t triangle = 0;    // coarse
    uint32_t root = kNone;    // among cut roots; kNone: the coarse triangle itself
    uint32_t corner[3] = {};  // points
    Side side[3];             // side k from corner k to k + 1
    uint32_t along[3] = {};   // points on each side
  };

  // Parts first..end, made in one patch.
  struct Group {
    uint32_t first = 0, end = 0;
    uint32_t inner = 0, leaves = 0;
    uint64_t first_point = 0, first_leaf = 0;
  };

  SurfacePlan(const SurfaceRoots& roots, const CoarseSurface& coarse, const SurfaceRules& rules,
              const WeldLimits& limits);

  // Cuts and counts; false beyond the limit.
  bool Make();
  // Makes a group's patch; false where it has too many points.
  bool Expand(const Group& group, bool identities, SurfaceGroup* made) const;
  // Tables for Expand, used again and again. From any thread.
  std::unique_ptr<SurfaceGroup> Borrow();
  void Return(std::unique_ptr<SurfaceGroup> group);

  std::vector<Border> borders;
  std::vector<Part> parts;
  std::vector<Group> groups;
  WeldedShape shape;  // the coarse points and those of cuts
  const bool colored;
  const uint64_t limit;  // points

 private:
  uint32_t AddPoint(const StreamVertex& v, const Rgb& color, const Identity& identity,
                    uint8_t level, bool coast);
  uint32_t AddBorder(uint32_t a, uint32_t b, bool coast);
  void AddPart(Part part, const PatchRoot& root, double leaves);
  void Cut(const Part& part, const PatchRoot& root, const EdgeSite* sites,
           std::vector<std::pair<Part, PatchRoot>>* stack);
  PatchRoot RootOf(const Part& part) const;
  bool CountGroups(size_t end);

  const SurfaceRoots& roots_;
  const CoarseSurface& coarse_;
  const SurfaceRules& rules_;
  const int threads_;
  Patch cut_;
  std::vector<PatchRoot> cut_roots_;
  bool open_ = false;  // may the last group take more coarse triangles?
  double open_leaves_ = 0;
  size_t counted_ = 0;  // groups
  uint64_t inner_ = 0;  // points inside of those
  std::mutex mutex_;
  std::vector<std::unique_ptr<SurfaceGroup>> idle_;
};

}  // namespace fjord
