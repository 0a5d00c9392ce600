// Places in the box of an <svg>: view boxes and how they fit, and the origin of a transform. Errors
// carry the offset of the fault in the value.
#pragma once

#include <string_view>

#include "engine/formats/svg_matrix.h"
#include "engine/formats/svg_scan.h"
#include "engine/formats/svg_value.h"

namespace fjord::formats {

struct SvgViewBox {
  Vec2 low{0}, size{0};
};
SvgFault ParseViewBox(std::string_view text, SvgViewBox* box);

// The map from the view box to a viewport of `size` at (0, 0), by the value of a
// preserveAspectRatio attribute, which may be empty.
SvgFault FitViewBox(const SvgViewBox& box, const Vec2& size, std::string_view aspect,
                    SvgMatrix* matrix);

// "10 20", "50% top": the point that a transform leaves where it is.
SvgFault ParseOrigin(std::string_view text, const SvgViewport& view, Vec2* origin);

}  // namespace fjord::formats
