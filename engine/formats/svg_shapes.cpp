#include "engine/formats/svg_shapes.h"

#include <algorithm>
#include <array>

#include "engine/base/exact_math.h"

namespace fjord::formats {
namespace {

using Names = std::span<const SvgNumberName>;

constexpr std::array<SvgNumberName, 4> kLine = {
    {{"x1", SvgAxis::kX}, {"y1", SvgAxis::kY}, {"x2", SvgAxis::kX}, {"y2", SvgAxis::kY}}};
constexpr std::array<SvgNumberName, 6> kRect = {{{"x", SvgAxis::kX},
                                                 {"y", SvgAxis::kY},
                                                 {"width", SvgAxis::kX},
                                                 {"height", SvgAxis::kY},
                                                 {"rx", SvgAxis::kX},
                                                 {"ry", SvgAxis::kY}}};
constexpr std::array<SvgNumberName, 3> kCircle = {
    {{"cx", SvgAxis::kX}, {"cy", SvgAxis::kY}, {"r", SvgAxis::kBoth}}};
constexpr std::array<SvgNumberName, 4> kEllipse = {
    {{"cx", SvgAxis::kX}, {"cy", SvgAxis::kY}, {"rx", SvgAxis::kX}, {"ry", SvgAxis::kY}}};

double Of(const SvgNumbers& numbers, std::string_view name, double otherwise = 0) {
  const auto found = numbers.find(name);
  return found == numbers.end() ? otherwise : found->second;
}

// One radius given stands for both.
Vec2 Radii(const SvgNumbers& numbers) {
  return {Of(numbers, "rx", Of(numbers, "ry")), Of(numbers, "ry", Of(numbers, "rx"))};
}

// A quarter of the ellipse around `center`, from the point at `quarter` right angles on.
void Quarter(const Vec2& center, const Vec2& radii, int quarter, SvgPen* pen) {
  constexpr std::array<Vec2, 4> kEnds = {Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1), Vec2(1, 0)};
  constexpr double kRight = exact::kPi / 2;
  pen->ArcTo({center, Vec2(radii.x, 0), Vec2(0, radii.y)}, quarter * kRight, kRight,
             center + radii * kEnds[static_cast<size_t>(quarter)]);
}

void DrawEllipse(const Vec2& center, const Vec2& radii, SvgPen* pen) {
  if (radii.x == 0 || radii.y == 0) return;
  pen->MoveTo(center + Vec2(radii.x, 0));
  for (int quarter = 0; quarter < 4; ++quarter) Quarter(center, radii, quarter, pen);
  pen->End(true);
}

void DrawRect(const Vec2& low, const Vec2& size, const Vec2& wanted, SvgPen* pen) {
  if (size.x == 0 || size.y == 0) return;
  const Vec2 high = low + size;
  Vec2 r(std::min(wanted.x, size.x / 2), std::min(wanted.y, size.y / 2));
  if (r.x == 0 || r.y == 0) {
    pen->MoveTo(low);
    pen->LineTo({high.x, low.y});
    pen->LineTo(high);
    pen->LineTo({low.x, high.y});
  } else {
    pen->MoveTo({low.x + r.x, low.y});
    if (r.x * 2 < size.x) pen->LineTo({high.x - r.x, low.y});
    Quarter({high.x - r.x, low.y + r.y}, r, 3, pen);
    if (r.y * 2 < size.y) pen->LineTo({high.x, high.y - r.y});
    Quarter(high - r, r, 0, pen);
    if (r.x * 2 < size.x) pen->LineTo({low.x + r.x, high.y});
    Quarter({low.x + r.x, high.y - r.y}, r, 1, pen);
    if (r.y * 2 < size.y) pen->LineTo({low.x, low.y + r.y});
    Quarter(low + r, r, 2, pen);
  }
  pen->End(true);
}

}  // namespace

Names NumbersOf(std::string_view element) {
  if (element == "line") return kLine;
  if (element == "rect") return kRect;
  if (element == "circle") return kCircle;
  if (element == "ellipse") return kEllipse;
  return {};
}

bool IsSvgShape(std::string_view element) {
  return element == "path" || element == "polyline" || element == "polygon" ||
         !NumbersOf(element).empty();
}

std::string DrawSvgShape(std::string_view element, const SvgNumbers& numbers, SvgPen* pen) {
  for (const char* name : {"width", "height", "r", "rx", "ry"}) {
    if (Of(numbers, name) < 0) return std::string(name) + " is negative";
  }
  if (element == "line") {
    pen->MoveTo({Of(numbers, "x1"), Of(numbers, "y1")});
    pen->LineTo({Of(numbers, "x2"), Of(numbers, "y2")});
    pen->End(false);
  } else if (element == "rect") {
    DrawRect({Of(numbers, "x"), Of(numbers, "y")}, {Of(numbers, "width"), Of(numbers, "height")},
             Radii(numbers), pen);
  } else if (element == "circle") {
    DrawEllipse({Of(numbers, "cx"), Of(numbers, "cy")}, Vec2(Of(numbers, "r")), pen);
  } else if (element == "ellipse") {
    DrawEllipse({Of(numbers, "cx"), Of(numbers, "cy")}, Radii(numbers), pen);
  }
  return {};
}

}  // namespace fjord::formats
