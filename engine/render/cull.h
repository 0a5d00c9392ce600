// What lies before a tile: planes in object space that subtrees are tested against (S7), and the
// list of roots that may touch each tile. Never says no wrongly; yes costs time only.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/fractal/method.h"
#include "engine/render/tile_buffer.h"
#include "engine/render/view.h"

namespace fjord {

// Pixels round a tile that still count as touching it: sample places, rounding to the fixed grid,
// and half the width of strokes with their square ends.
double TileMargin(double line_width);

class TileFrustum {
 public:
  TileFrustum(const Projection& to, const TileRect& rect, double margin, bool open_left);

  // May anything within `reach` of the triangle be seen in the tile?
  bool MayTouch(const Vec3& a, const Vec3& b, const Vec3& c, const StreamReach& reach) const;

 private:
  // normal . p + distance >= 0 inside.
  struct Plane {
    Vec3 normal{0};  // unit
    double distance = 0;
  };
  void Add(const std::array<double, 4>& row);

  std::array<Plane, 5> planes_;
  int count_ = 0;
};

struct RootRef {
  uint32_t object = 0;
  uint32_t root = 0;
};

// Tiles of a region, row by row, and what may touch each: roots of tile t are
// refs[start[t]] .. refs[start[t + 1]], objects ascending, near roots first: what they hide need
// not be made.
struct TileLists {
  std::vector<TileRect> tiles;
  std::vector<TileRect> busy;  // the rows of a tile that anything may touch; height 0: none
  std::vector<uint32_t> start;
  std::vector<RootRef> refs;
};

struct CullObject {
  const PreparedFractal* prepared = nullptr;
  Projection to;
  double margin = 1;  // TileMargin
  // What lies left of a tile is wanted too (winding numbers are counted from the left).
  bool open_left = false;
};

// Tiles lie on the grid of the whole picture, cut to `region`.
TileLists BinRoots(const TileRect& region, int32_t tile_width, int32_t tile_height,
                   std::span<const CullObject> objects);

}  // namespace fjord
