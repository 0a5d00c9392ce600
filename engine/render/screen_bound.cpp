#include "engine/render/screen_bound.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fjord {
namespace {

// Least and most of a row over everything within reach.
struct Range {
  double least, most;
};

Range RangeOf(const std::array<double, 4>& row, const std::array<Vec3, 3>& corner,
              const StreamReach& reach) {
  const double at[3] = {Row(row, corner[0]), Row(row, corner[1]), Row(row, corner[2])};
  const Vec3 way(row[0], row[1], row[2]);
  const double length = Length(way);
  // Rounding of these sums, and of the kernel's.
  double spread = std::abs(row[3]) * 1e-13;
  for (const double v : at) spread += std::abs(v) * 1e-13;
  if (length > 0) spread += length * reach.Towards(way * (1 / length));
  return {std::min(std::min(at[0], at[1]), at[2]) - spread,
          std::max(std::max(at[0], at[1]), at[2]) + spread};
}

}  // namespace

std::optional<ScreenBound> BoundOnScreen(const Projection& to, const Vec3& a, const Vec3& b,
                                         const Vec3& c, const StreamReach& reach, double spread) {
  // Vertices are rounded to the grid, and so is this.
  const double round = 2 + spread * kFixedOne;
  const std::array<Vec3, 3> corner = {a, b, c};
  const Range z = RangeOf(to.z, corner, reach);
  if (!(z.least > to.near)) return std::nullopt;
  ScreenBound bound;
  if (to.orthographic) {
    const Range x = RangeOf(to.x, corner, reach), y = RangeOf(to.y, corner, reach);
    bound.left = x.least - round;
    bound.right = x.most + round;
    bound.top = y.least - round;
    bound.bottom = y.most + round;
    bound.depth = -z.least;
    return bound;
  }
  // Distances from the line of sight through the first corner, so that moving along it counts for
  // little.
  const auto side = [&](const std::array<double, 4>& row, double* least, double* most) {
    const double middle = Row(row, a) / Row(to.z, a);
    std::array<double, 4> off;
    for (size_t i = 0; i < 4; ++i) off[i] = row[i] - middle * to.z[i];
    const Range range = RangeOf(off, corner, reach);
    *least = middle + range.least / (range.least < 0 ? z.least : z.most) - round;
    *most = middle + range.most / (range.most > 0 ? z.least : z.most) + round;
  };
  side(to.x, &bound.left, &bound.right);
  side(to.y, &bound.top, &bound.bottom);
  bound.depth = 1 / z.least;
  return bound;
}

}  // namespace fjord
