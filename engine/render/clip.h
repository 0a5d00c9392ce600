// Clipping against the frame's near plane and the guard of the fixed-point grid, never against a
// tile, so that every tile sees the same pieces (D3).
#pragma once

#include <array>
#include <cstddef>

#include "engine/fractal/method.h"
#include "engine/render/view.h"

namespace fjord {

struct ClipCorner {
  ClipPoint clip;
  Vec3 position{0};  // object space
  Weights place{0};
};

// A convex polygon of at most 3 + 5 corners.
struct ClipPolygon {
  std::array<ClipCorner, 8> corner;
  size_t size = 0;
};

// Cuts `polygon` (2 corners: a segment) to what can be put on the picture; may leave nothing. A cut
// point depends on its edge alone, not on the direction the edge is walked in.
void ClipToView(const Projection& to, ClipPolygon* polygon);

}  // namespace fjord
