// Light on surfaces (W40-W42, C21):
//   c = C ka A + sum over lights f_j (kd C I_j max(0, N.L_j) + ks max(0, I_j - C) max(0, N.H_j)^n)
// C the surface's colour, A the ambient light, I_j the light's colour, H the unit mean of L and the
// way to the eye (which is local), f_j = 1 for directional lights and max(0, 1 - d / range)^2 for
// local ones; no highlight where n = 0 or the light stands behind the surface. N is turned to the
// eye, so both sides are lit alike. f_j times what shadows let through (shadow_map.h). The same
// bits at every SIMD level.
#pragma once

#include <array>
#include <span>

#include "engine/render/built_frame.h"
#include "engine/render/rays.h"
#include "engine/render/surface_hits.h"

namespace fjord {

// A light with its direction or place worked out.
struct ShadeLight {
  bool local = false;
  Vec3 place{0};  // unit direction towards it, or position
  float inverse_range = 0;
  Rgb color{0};
  int32_t shadow = -1;  // which of SurfaceHits::arrives is its; -1: all of it arrives
};

struct Surface {
  float diffuse = 1, specular = 0, shininess = 0;
  Rgb ambient{0};                        // ka A
  bool lit = true;                       // strokes are not: their colour is what is seen
  std::array<float, 9> normal_matrix{};  // object to world, for normals
};

// Where a point is seen from, and how high it is in its object.
struct HitGeometry {
  Rays rays;
  Vec3 eye{0};
  Vec3 forward{0};
  bool orthographic = false;
  bool wants_position = false;
  // height = height_row . (world point) + height_offset
  Vec3 height_row{0};
  double height_offset = 0;
};

// Fills to_eye, height and (where wanted) position from x, y and depth.
void LocateHits(const HitGeometry& geometry, SurfaceHits* hits);

// Fills color from height: linear between stops, the end colours outside (S29).
void ColorByHeight(std::span<const RampStop> ramp, SurfaceHits* hits);

// color becomes what is seen. Local lights need position, those with shadows arrives.
void Illuminate(const Surface& surface, std::span<const ShadeLight> lights, SurfaceHits* hits);

}  // namespace fjord
