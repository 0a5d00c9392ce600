// The welded form of a surface, for files and checks. Triangles are cut as the stream cuts them,
// until each makes some two thousand leaves; what two of them share is a border, and every point on
// it is made once and numbered along it. Nothing is searched for: a point is known by its border
// and its place there, or by its patch.
//
// Every patch is made twice. The first time says how many points and leaves there are, so that a
// shape beyond the limit is refused before anything is kept, and the arrays are made once in their
// final size; the second time every patch writes into its own part of them, on as many threads as
// are wanted.
//
// Order of points: those of the coarse shape; those that cuts make; along each border; inside each
// group of triangles. It depends on shape and settings alone, never on threads.
//
// Memory while it is made: the result, some 60 bytes a coarse triangle and 36 a coarse edge.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/fractal/method.h"
#include "engine/fractal/patch.h"
#include "engine/fractal/surface_coarse.h"

namespace fjord {

// A triangle that waits to be expanded: a coarse one, or a child of one that was too large.
struct PatchRoot {
  StreamVertex vertex[3];
  double eye_distance2[3];  // as the vertices', not rounded
  Rgb color[3];             // while welding
  Weights place[3];         // while streaming, where it is read
  double length2[3];        // as in Patch
  double current2[3];
  uint64_t inside[3];   // shares (shares.h): the triangle's own, as each side knows it, and those
  uint64_t outside[3];  // of its neighbours
  uint32_t site[3];     // 1..3: the side of the coarse triangle that it lies on; 0: inside
  uint32_t level;
};

// What a surface says of its triangles. Safe to ask from many threads.
class SurfaceRoots {
 public:
  virtual ~SurfaceRoots() = default;
  virtual PatchRoot CoarseRoot(size_t triangle) const = 0;
  // Of a coarse triangle: its inside, then its sides.
  virtual std::array<EdgeSite, 4> SitesOf(size_t triangle) const = 0;
  // About how many leaves it becomes.
  virtual double ExpectedLeaves(const PatchRoot& root) const = 0;
  // What the edges of a triangle with these sites are split by.
  virtual const SurfaceRules& RulesOf(const PatchRoot& root, const EdgeSite* sites) const = 0;
  // Adds it to a patch; its sites begin at `first_site` of those of the patch.
  virtual void Load(const PatchRoot& root, uint32_t first_site, bool sites_kept,
                    Patch& patch) const = 0;
  // Triangle t of a patch that holds `parent` after one step.
  virtual PatchRoot ChildOf(const PatchRoot& parent, const Patch& patch, size_t t,
                            bool sites_kept) const = 0;
};

// kLimit where there are more points than limits.max_points.
Result<WeldedShape> WeldSurface(const SurfaceRoots& roots, const CoarseSurface& coarse,
                                const SurfaceRules& rules, const WeldLimits& limits);

}  // namespace fjord
