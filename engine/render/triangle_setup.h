// Depth over one triangle, evaluated from absolute picture coordinates through its leading corner,
// so that no tile, cut or order of corners changes a bit (D3).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "engine/render/view.h"

namespace fjord {

// The corner with the smallest (x, y) leads; the others follow in their cyclic order. Equal corners
// mean area 0, which is never drawn.
inline int LeadingCorner(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c) {
  const auto key = [](const ScreenPoint& p) {
    return (static_cast<int64_t>(p.x) << 32) + static_cast<int64_t>(p.y);
  };
  const int64_t ka = key(a), kb = key(b), kc = key(c);
  return ka < kb ? (ka < kc ? 0 : 2) : (kb < kc ? 1 : 2);
}

struct DepthPlane {
  double depth = 0, along_x = 0, along_y = 0;  // along: per 1/256 pixel
  int32_t x = 0, y = 0;
  double least = 0, most = 0;  // of the corners: no sample may lie outside

  // a leads. The area is not 0.
  DepthPlane(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c)
      : depth(a.depth), x(a.x), y(a.y) {
    const double bx = static_cast<double>(int64_t{b.x} - a.x);
    const double by = static_cast<double>(int64_t{b.y} - a.y);
    const double cx = static_cast<double>(int64_t{c.x} - a.x);
    const double cy = static_cast<double>(int64_t{c.y} - a.y);
    const double inverse = 1 / (bx * cy - cx * by);
    const double db = b.depth - a.depth;
    const double dc = c.depth - a.depth;
    along_x = (db * cy - dc * by) * inverse;
    along_y = (dc * bx - db * cx) * inverse;
    least = std::min(std::min(a.depth, b.depth), c.depth);
    most = std::max(std::max(a.depth, b.depth), c.depth);
  }

  // px, py: the sample in 1/256 pixel.
  double At(int32_t px, int32_t py) const {
    const double dx = static_cast<double>(int64_t{px} - x);
    const double dy = static_cast<double>(int64_t{py} - y);
    const double d = (depth + along_x * dx) + along_y * dy;
    return std::min(std::max(d, least), most);
  }
};

}  // namespace fjord
