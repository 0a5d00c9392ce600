// The basic shapes of .svg: which numbers they have, and how they are drawn.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "engine/formats/svg_pen.h"
#include "engine/formats/svg_value.h"

namespace fjord::formats {

// path, polyline, polygon, and those below.
bool IsSvgShape(std::string_view element);

struct SvgNumberName {
  const char* name;
  SvgAxis axis;
};
// Of line, rect, circle and ellipse.
std::span<const SvgNumberName> NumbersOf(std::string_view element);

// By name, in pixels; those that are not given are missing.
using SvgNumbers = std::map<std::string_view, double>;

// Draws a line, rect, circle or ellipse: clockwise as seen, rectangles from their upper left
// corner, circles from their right. Those without size draw nothing. The message says what is
// wrong; empty: nothing.
std::string DrawSvgShape(std::string_view element, const SvgNumbers& numbers, SvgPen* pen);

}  // namespace fjord::formats
