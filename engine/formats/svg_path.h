// The curves of .svg attributes: path data (M L H V C S Q T Z and their relative forms; curved
// pieces become chains of short segments), point lists and transforms. Coordinates as they stand in
// the file (y down). Errors carry the offset of the fault in the attribute.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/geometry/vec.h"

namespace fjord::formats {

struct SvgFault {
  size_t offset = 0;
  std::string message;  // empty: no fault
  bool ok() const { return message.empty(); }
};

struct SvgCurve {
  std::vector<Vec2> points;
  bool closed = false;
};

// x' = a x + c y + e, y' = b x + d y + f, as in `matrix(a b c d e f)`.
struct SvgMatrix {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
  Vec2 operator()(const Vec2& p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
};
SvgMatrix operator*(const SvgMatrix& outer, const SvgMatrix& inner);

// A curved piece deviates from its chain by at most 1e-4 of the length of its control polygon.
SvgFault ParsePath(std::string_view data, size_t most_points, std::vector<SvgCurve>* curves);
SvgFault ParsePoints(std::string_view list, size_t most_points, std::vector<Vec2>* points);
// matrix, translate, scale, rotate, skewX and skewY, from left to right.
SvgFault ParseTransform(std::string_view text, SvgMatrix* matrix);
// "12", "12.5px", "1in", in pixels, of which an inch has 96. Other units are faults.
SvgFault ParseLength(std::string_view text, double* value);

}  // namespace fjord::formats
