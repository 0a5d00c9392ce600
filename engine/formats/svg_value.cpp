#include "engine/formats/svg_value.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "engine/base/exact_math.h"
#include "engine/formats/text.h"

namespace fjord::formats {
namespace {

struct Unit {
  std::string_view name;
  double size;
};
constexpr std::array<Unit, 8> kPixels = {{{"", 1},
                                          {"px", 1},
                                          {"in", 96},
                                          {"cm", 96 / 2.54},
                                          {"mm", 96 / 25.4},
                                          {"q", 96 / 101.6},
                                          {"pt", 96 / 72.},
                                          {"pc", 16}}};
constexpr std::array<Unit, 5> kDegrees = {
    {{"", 1}, {"deg", 1}, {"grad", .9}, {"rad", 180 / exact::kPi}, {"turn", 360}}};

template <size_t n>
bool Scale(std::string_view unit, const std::array<Unit, n>& units, double* value) {
  for (const Unit& known : units) {
    if (known.name != unit) continue;
    *value *= known.size;
    return true;
  }
  return false;
}

double Whole(const Vec2& size, SvgAxis axis) {
  if (axis == SvgAxis::kX) return size.x;
  if (axis == SvgAxis::kY) return size.y;
  return std::sqrt((size.x * size.x + size.y * size.y) / 2);
}

SvgFault ReadLength(const SvgViewport& view, SvgAxis axis, SvgScan* scan, double* value) {
  if (!scan->ReadNumber(value)) return scan->fault();
  if (scan->Peek() == '%') {
    if (!view.known) {
      return scan->Fault(
          "a per cent of a drawing whose size is not known; give the outer <svg> a viewBox");
    }
    *value *= Whole(view.size, axis) / 100;
    scan->Skip();
    return {};
  }
  const SvgFault unknown =
      scan->Fault("a length is in px, in, cm, mm, Q, pt, pc or %; others are not read");
  return Scale(scan->ReadWord(), kPixels, value) ? SvgFault() : unknown;
}

double Radians(double degrees) { return degrees * (exact::kPi / 180); }

// What stands between the brackets of one transform.
struct Arguments {
  std::array<double, 6> number{};
  size_t count = 0;
};

SvgFault ReadArguments(const std::string& name, const SvgViewport& view, SvgScan* scan,
                       Arguments* arguments) {
  const bool turns = name == "rotate" || name.rfind("skew", 0) == 0;
  const bool moves = name.rfind("translate", 0) == 0;
  while (arguments->count < 6 && scan->AtNumber()) {
    double& value = arguments->number[arguments->count];
    const bool angle = turns && (arguments->count == 0 || name == "skew");
    const SvgAxis axis = arguments->count == 1 || name == "translatey" ? SvgAxis::kY : SvgAxis::kX;
    ++arguments->count;
    if (moves) {
      if (SvgFault fault = ReadLength(view, axis, scan, &value); !fault.ok()) return fault;
      continue;
    }
    if (!scan->ReadNumber(&value)) return scan->fault();
    if (!angle) continue;
    const SvgFault unknown = scan->Fault("an angle is in deg, rad, grad or turn");
    if (!Scale(scan->ReadWord(), kDegrees, &value)) return unknown;
    if (value > 36000 || value < -36000) return scan->Fault("an angle beyond 36000 degrees");
  }
  scan->SkipSpace();
  return scan->Peek() == ')' ? SvgFault() : scan->Fault("')' is missing");
}

double Tangent(double degrees) {
  const double c = exact::Cos(Radians(degrees));
  return c == 0 ? 0 : exact::Sin(Radians(degrees)) / c;
}

bool MatrixOf(const std::string& name, const Arguments& arguments, SvgMatrix* matrix) {
  const auto& v = arguments.number;
  const size_t n = arguments.count;
  if (name == "matrix" && n == 6) {
    *matrix = {v[0], v[1], v[2], v[3], v[4], v[5]};
  } else if ((name == "translate" && (n == 1 || n == 2)) || (name == "translatex" && n == 1)) {
    *matrix = Translation({v[0], v[1]});
  } else if (name == "translatey" && n == 1) {
    *matrix = Translation({0, v[0]});
  } else if (name == "scale" && (n == 1 || n == 2)) {
    *matrix = {v[0], 0, 0, n == 1 ? v[0] : v[1], 0, 0};
  } else if (name == "scalex" && n == 1) {
    *matrix = {v[0], 0, 0, 1, 0, 0};
  } else if (name == "scaley" && n == 1) {
    *matrix = {1, 0, 0, v[0], 0, 0};
  } else if (name == "rotate" && (n == 1 || n == 3)) {
    const double s = exact::Sin(Radians(v[0])), c = exact::Cos(Radians(v[0]));
    *matrix = SvgMatrix{1, 0, 0, 1, v[1], v[2]} * SvgMatrix{c, s, -s, c, 0, 0} *
              SvgMatrix{1, 0, 0, 1, -v[1], -v[2]};
  } else if (name == "skewx" && n == 1) {
    *matrix = {1, 0, Tangent(v[0]), 1, 0, 0};
  } else if (name == "skewy" && n == 1) {
    *matrix = {1, Tangent(v[0]), 0, 1, 0, 0};
  } else {
    return false;
  }
  return true;
}

}  // namespace

SvgFault ParseLength(std::string_view text, const SvgViewport& view, SvgAxis axis, double* value) {
  SvgScan scan(text);
  if (SvgFault fault = ReadLength(view, axis, &scan, value); !fault.ok()) return fault;
  scan.SkipSpace();
  return scan.AtEnd() ? SvgFault() : scan.Fault("one length is wanted, and nothing after it");
}

SvgFault ParseTransform(std::string_view text, const SvgViewport& view, SvgMatrix* matrix) {
  SvgScan scan(text);
  *matrix = {};
  for (scan.SkipSpace(); !scan.AtEnd(); scan.SkipSpace()) {
    const std::string name = scan.ReadWord();
    if (name == "none" && scan.AtEnd()) return {};
    scan.SkipSpace();
    if (scan.Peek() != '(') return scan.Fault("a transform is written as name(numbers)");
    scan.Skip();
    Arguments arguments;
    if (SvgFault fault = ReadArguments(name, view, &scan, &arguments); !fault.ok()) return fault;
    SvgMatrix next;
    if (!MatrixOf(name, arguments, &next)) {
      return scan.Fault(text::Quoted(name) + " with " + std::to_string(arguments.count) +
                        " numbers is no transform that is read");
    }
    scan.Skip();
    *matrix = *matrix * next;
  }
  return {};
}

}  // namespace fjord::formats
