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

// Pixels that a stroke reaches beyond its line: half its width, to the corners of its square ends.
double StrokeSpread(double line_width);

// Filled curves are counted from one side of the rows: what lies on that side of a tile is wanted
// too (outline_fill.h).
enum class OpenSide : uint8_t { kNone, kLeft, kRight };

// One object, as culling sees it.
struct CullObject {
  const PreparedFractal* prepared = nullptr;
  Projection to;
  double spread = 0;  // StrokeSpread; 0 for triangles
  OpenSide open = OpenSide::kNone;
  bool before_near = false;  // what lies before the near plane is wanted too
};

class TileFrustum {
 public:
  TileFrustum(const CullObject& object, const TileRect& rect);

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

  std::span<const RootRef> Of(size_t tile) const {
    return std::span(refs).subspan(start[tile], start[tile + 1] - start[tile]);
  }
};

// Tiles lie on the grid of the whole picture, cut to `region`.
TileLists BinRoots(const TileRect& region, int32_t tile_width, int32_t tile_height,
                   std::span<const CullObject> objects);

}  // namespace fjord
