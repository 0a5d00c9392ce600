// A plane of the world as depths over the picture: the sea, and the inside of filled curves. Depth
// is linear over the picture, so it is evaluated per sample, not drawn.
#pragma once

#include <cstddef>
#include <optional>

#include "engine/render/view.h"

namespace fjord {

struct ViewPlane {
  double depth = 0, along_x = 0,
         along_y = 0;  // depth = (depth + along_x x) + along_y y, 1/256 pixel
  // What rounding corners to the fixed grid can move a triangle in this plane: the sea counts as so
  // much farther, so that land at its level shows.
  double rounding = 0;
  double least = 0, most = 0;  // depths it can be seen at: horizon and near plane

  double At(double x, double y) const { return (depth + along_x * x) + along_y * y; }
  bool Seen(double at) const { return at > least && at <= most; }
};

// None where the eye lies in the plane or looks along it.
std::optional<ViewPlane> MakeViewPlane(const View& view, const Vec3& point, const Vec3& normal);

// What must be passed to be seen before the plane: its depth less the rounding, -infinity where it
// is not seen. Of count samples at x, top + y (1/256 pixel); `depth` is padded for SIMD lanes.
void LayPlane(const ViewPlane& plane, const double* x, const double* y, double top, size_t count,
              double* depth);

}  // namespace fjord
