// What keeps a directional light from a point: over a plane square to the light, per texel, how
// near to the light the nearest surface lies.
//
// Texels lie on a grid that is fixed in the world: where things or the camera move, they move
// through the grid, and the grid does not follow them. A point is compared with 4x4 texels,
// weighted by a cubic B-spline, and each comparison goes from "free" to "hidden" over a texel's
// length: so what arrives changes smoothly with the point and with what stands before it, and edges
// show no steps. Texels say nothing about what happens within one, so what is less than kBias
// texels nearer to the light than the point does not hide it, nor what the point's own surface may
// reach there.
//
// Immutable once made; free to share between threads.
#pragma once

#include <span>
#include <vector>

#include "engine/geometry/vec.h"
#include "engine/render/view.h"

namespace fjord {

// A map as what compares with it reads it (shadow_share.cpp).
struct ShadowTexels {
  static constexpr int kBlockShift = 3;  // blocks are 8 texels wide and high

  const float* nearness;  // of each texel, row by row
  const float* most;      // of a block and those round it
  uint32_t width, height, blocks_x;
};

class ShadowMap {
 public:
  // No more texels than this in one map.
  static constexpr double kMostTexels = 1 << 25;

  // `view`: orthographic, from the light, one pixel a texel; width x height texels. `nearness`: of
  // each texel, row by row, View's depth; minus infinity where nothing is.
  ShadowMap(const View& view, std::vector<float> nearness);

  const View& view() const { return view_; }
  ShadowTexels texels() const {
    return {nearness_.data(), most_.data(), view_.width, view_.height,
            static_cast<uint32_t>(blocks_x_)};
  }

  size_t Bytes() const { return (nearness_.capacity() + most_.capacity()) * sizeof(float); }

 private:
  static constexpr int32_t kBlock = 1 << ShadowTexels::kBlockShift;  // texels

  View view_;
  int32_t width_, height_;
  std::vector<float> nearness_;
  size_t BlockIndex(int32_t x, int32_t y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(blocks_x_) + static_cast<size_t>(x);
  }

  int32_t blocks_x_, blocks_y_;
  std::vector<float> most_;  // of a block and those round it
};

// The plane of a shadow map for what lies in `low`..`high` (places along its axes): the light's
// view with texels `detail` wide, on the grid of the world.
struct LightBounds {
  double left = 0, right = 0, bottom = 0, top = 0;  // along view.right and view.up
};
View MakeLightView(const Vec3& to_light);  // unit; its size and scale are not set yet
// False where the map would have more than kMostTexels; `view` then has the size it would need.
bool FitLightView(const LightBounds& bounds, double detail, View* view);

}  // namespace fjord
