// What is seen where nothing else is: a function of the direction of sight, or a gradient over the
// picture. The same bits at every SIMD level.
#pragma once

#include <cstdint>

#include "engine/geometry/vec.h"

namespace fjord {

struct SurfaceHits;

enum class SkyKind : uint32_t {
  kPicture = 0,  // from the top row of the picture to its bottom row
  kDome = 1,     // from the horizon to the zenith, by the height of the direction of sight
};

struct Sky {
  SkyKind kind = SkyKind::kPicture;
  Rgb top{0};     // of the picture, or the zenith
  Rgb bottom{0};  // of the picture, or the horizon and all below it
};

// The colour of row y (kPicture).
inline Rgb SkyOfRow(const Sky& sky, int32_t y, uint32_t height) {
  const double t = (y + .5) / height;
  return sky.top + (sky.bottom - sky.top) * static_cast<float>(t);
}

// Fills color from to_eye (kDome).
void ColorByDirection(const Sky& sky, SurfaceHits* hits);

// Still water throws back the sky (Schlick): color mixed with it by .02 + .98 (1 - c)^5, c the
// cosine of the angle of sight to the vertical. The sky runs from `horizon` (c = 0) to `top`.
void ReflectSky(const Rgb& horizon, const Rgb& top, SurfaceHits* hits);

}  // namespace fjord
