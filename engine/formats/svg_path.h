// Draws path data (all commands in both forms) and lists of points, as .svg attributes hold them.
// Errors carry the offset of the fault in the attribute.
#pragma once

#include <string_view>

#include "engine/formats/svg_pen.h"
#include "engine/formats/svg_scan.h"

namespace fjord::formats {

SvgFault DrawPath(std::string_view data, SvgPen* pen);
SvgFault DrawPoints(std::string_view list, bool closed, SvgPen* pen);

}  // namespace fjord::formats
