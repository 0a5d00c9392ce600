// The camera as numbers: from points to 24.8 fixed-point picture coordinates and depth, and back.
//
// Picture coordinates: x to the right, y down, pixel (i, j) covers i..i+1, j..j+1; one unit of the
// fixed-point grid is 1/256 pixel. Depth is larger where nearer and linear over the picture: 1 /
// distance along the view for perspective, minus that distance for orthographic views.
#pragma once

#include <array>
#include <cstdint>

#include "engine/render/built_frame.h"

namespace fjord {

inline constexpr int32_t kFixedOne = 256;        // units a pixel
inline constexpr int32_t kFixedGuard = 1 << 29;  // |coordinate| below this, else clipped
inline constexpr int32_t kOutOfGuard = 1 << 30;  // marks a vertex that must be clipped

struct View {
  Vec3 eye{0};
  Vec3 forward{0}, right{0}, up{0};  // unit, square to each other
  double focal = 1;  // pixels a unit, at distance 1 (perspective) or anywhere (orthographic)
  double center_x = 0, center_y = 0;  // pixels
  double near = 0;
  bool orthographic = false;
  uint32_t width = 0, height = 0;
};

// Every camera has a view: one without a direction looks along +y, and where `up` says nothing
// another upward direction is taken.
View MakeView(const Camera& camera, uint32_t width, uint32_t height);

// Object space to clip space: x and y in 1/256 pixel times z (times 1 when orthographic), z the
// distance along the view.
struct Projection {
  std::array<double, 4> x{}, y{}, z{};
  double near = 0;
  bool orthographic = false;
};
Projection MakeProjection(const View& view, const Transform& transform);

struct ClipPoint {
  double x = 0, y = 0, z = 0;
};
// Operation by operation what the SIMD kernel does.
inline double Row(const std::array<double, 4>& r, const Vec3& p) {
  return ((r[0] * p.x + r[1] * p.y) + r[2] * p.z) + r[3];
}
inline ClipPoint ToClip(const Projection& to, const Vec3& p) {
  return {Row(to.x, p), Row(to.y, p), Row(to.z, p)};
}

struct ScreenPoint {
  int32_t x = 0, y = 0;  // 24.8
  double depth = 0;
};
// z >= near (> 0 for perspective). Coordinates saturate at the guard.
ScreenPoint ToScreen(const Projection& to, const ClipPoint& p);

// The world point seen at picture coordinates (1/256 pixel) with that depth.
Vec3 PointAt(const View& view, double x, double y, double depth);

Vec3 Apply(const Transform& transform, const Vec3& p);
// The object point of a world point; the origin for a transform that flattens.
Vec3 ApplyInverse(const Transform& transform, const Vec3& world);

}  // namespace fjord
