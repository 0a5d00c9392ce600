// The values of .svg attributes and style properties: lengths and transforms. Errors carry the
// offset of the fault in the value.
#pragma once

#include <string_view>

#include "engine/formats/svg_matrix.h"
#include "engine/formats/svg_scan.h"

namespace fjord::formats {

// What per cents are parts of: the size of the nearest <svg> or <symbol>, in its own coordinates.
struct SvgViewport {
  Vec2 size{0};
  bool known = false;
};

enum class SvgAxis { kX, kY, kBoth };  // kBoth: radii, parts of the mean square of both sides

// "12", "12.5px", "1in", "50%", in pixels, of which an inch has 96. Other units are faults, and per
// cents where the viewport's size is not known.
SvgFault ParseLength(std::string_view text, const SvgViewport& view, SvgAxis axis, double* value);

// matrix, translate, scale, rotate, skewX, skewY and their forms for one axis, from left to right;
// angles in degrees unless they have a unit.
SvgFault ParseTransform(std::string_view text, const SvgViewport& view, SvgMatrix* matrix);
}  // namespace fjord::formats
