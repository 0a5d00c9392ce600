// Where on the picture, and how near, all that a subtree can become must lie (S7).
#pragma once

#include <optional>

#include "engine/fractal/method.h"
#include "engine/render/view.h"

namespace fjord {

struct ScreenBound {
  double left = 0, top = 0, right = 0, bottom = 0;  // 1/256 pixel, rounding included
  double depth = 0;                                 // no sample can be nearer
};

// Of what lies within `reach` of the triangle and of what is drawn `spread` pixels round it. None
// where it may come before the near plane.
std::optional<ScreenBound> BoundOnScreen(const Projection& to, const Vec3& a, const Vec3& b,
                                         const Vec3& c, const StreamReach& reach, double spread);

}  // namespace fjord
