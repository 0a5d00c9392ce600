// Air that takes on a colour with distance: the medium between a surface and the eye.
#pragma once

#include "engine/geometry/vec.h"

namespace fjord {

struct SurfaceHits;

struct Haze {
  Rgb color{0};
  double density = 0;  // at 1 / density of the way, 1 / e of the surface's own colour is left
};

// color becomes color t + haze.color (1 - t), t = exp(-density distance). Reads depth and to_eye.
void AddHaze(const Haze& haze, bool orthographic, SurfaceHits* hits);

}  // namespace fjord
