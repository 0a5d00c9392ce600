// Affine maps of the plane, as .svg writes them.
#pragma once

#include "engine/geometry/vec.h"

namespace fjord::formats {

// x' = a x + c y + e, y' = b x + d y + f, as in `matrix(a b c d e f)`.
struct SvgMatrix {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;

  Vec2 operator()(const Vec2& p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
  Vec2 Direction(const Vec2& v) const { return {a * v.x + c * v.y, b * v.x + d * v.y}; }
};

inline SvgMatrix operator*(const SvgMatrix& o, const SvgMatrix& i) {
  return {o.a * i.a + o.c * i.b, o.b * i.a + o.d * i.b,       o.a * i.c + o.c * i.d,
          o.b * i.c + o.d * i.d, o.a * i.e + o.c * i.f + o.e, o.b * i.e + o.d * i.f + o.f};
}

inline SvgMatrix Translation(const Vec2& by) { return {1, 0, 0, 1, by.x, by.y}; }

}  // namespace fjord::formats
