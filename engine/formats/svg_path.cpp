#include "engine/formats/svg_path.h"

#include <string>

#include "engine/formats/text.h"

namespace fjord::formats {
namespace {

class PathParser {
 public:
  PathParser(std::string_view data, SvgPen* pen) : scan_(data), pen_(*pen) {}

  SvgFault Run() {
    for (scan_.SkipSpace(); !scan_.AtEnd(); scan_.SkipSpace()) {
      const SvgFault fault = Command();
      if (!fault.ok()) return fault;
      if (pen_.full()) break;
    }
    pen_.End(false);
    return {};
  }

 private:
  SvgFault Command() {
    const char letter = scan_.Peek();
    const bool relative = letter >= 'a' && letter <= 'z';
    const char upper = relative ? static_cast<char>(letter - 'a' + 'A') : letter;
    if (std::string_view("MLHVCSQTAZ").find(upper) == std::string_view::npos) {
      return scan_.Fault(text::Quoted(std::string(1, letter)) +
                         " is no path command; M L H V C S Q T A Z and small letters are");
    }
    if (!started_ && upper != 'M') return scan_.Fault("a path starts with M");
    scan_.Skip();
    if (upper == 'Z') {
      pen_.End(true, summed_);
      last_ = 'Z';
      return {};
    }
    if (!scan_.AtNumber()) return scan_.Fault("a number is missing");
    char command = upper;
    while (scan_.AtNumber()) {
      if (!Piece(command, relative ? pen_.here() : Vec2(0))) return scan_.fault();
      if (pen_.full()) return {};
      summed_ = relative;
      last_ = command;
      if (command == 'M') command = 'L';
    }
    return {};
  }

  bool ReadPoint(const Vec2& origin, Vec2* p) {
    if (!scan_.ReadNumber(&p->x) || !scan_.ReadNumber(&p->y)) return false;
    *p += origin;
    return true;
  }

  // One set of numbers of a command; `origin` is what they are relative to.
  bool Piece(char command, const Vec2& origin) {
    if (command == 'H' || command == 'V') return Along(command == 'H' ? 0 : 1, origin);
    if (command == 'A') return Arc(origin);
    Vec2 p[3];
    const int count = command == 'C' ? 3 : command == 'S' || command == 'Q' ? 2 : 1;
    for (int i = 0; i < count; ++i) {
      if (!ReadPoint(origin, &p[i])) return false;
    }
    const bool cubic = last_ == 'C' || last_ == 'S', quadratic = last_ == 'Q' || last_ == 'T';
    const Vec2 here = pen_.here(), mirrored = here * 2. - control_;
    switch (command) {
      case 'M':
        started_ = true;
        pen_.MoveTo(p[0]);
        break;
      case 'L':
        pen_.LineTo(p[0]);
        break;
      case 'C':
        control_ = p[1];
        pen_.CurveTo(p[0], p[1], p[2]);
        break;
      case 'S':
        control_ = p[0];
        pen_.CurveTo(cubic ? mirrored : here, p[0], p[1]);
        break;
      case 'Q':
        Quadratic(p[0], p[1]);
        break;
      default:  // 'T'
        Quadratic(quadratic ? mirrored : here, p[0]);
        break;
    }
    return true;
  }

  bool Along(int axis, const Vec2& origin) {
    double value = 0;
    if (!scan_.ReadNumber(&value)) return false;
    Vec2 to = pen_.here();
    to[axis] = origin[axis] + value;
    pen_.LineTo(to);
    return true;
  }

  bool Arc(const Vec2& origin) {
    Vec2 radii(0), to(0);
    double degrees = 0;
    bool large = false, clockwise = false;
    if (!ReadPoint(Vec2(0), &radii) || !scan_.ReadNumber(&degrees) || !scan_.ReadFlag(&large) ||
        !scan_.ReadFlag(&clockwise) || !ReadPoint(origin, &to)) {
      return false;
    }
    pen_.ArcTo(radii, degrees, large, clockwise, to);
    return true;
  }

  void Quadratic(const Vec2& control, const Vec2& to) {
    const Vec2 from = pen_.here();
    control_ = control;
    pen_.CurveTo(from + (control - from) * (2 / 3.), to + (control - to) * (2 / 3.), to);
  }

  SvgScan scan_;
  SvgPen& pen_;
  Vec2 control_{0};
  char last_ = 'Z';
  bool started_ = false, summed_ = false;
};

}  // namespace

SvgFault DrawPath(std::string_view data, SvgPen* pen) { return PathParser(data, pen).Run(); }

SvgFault DrawPoints(std::string_view list, bool closed, SvgPen* pen) {
  SvgScan scan(list);
  bool first = true;
  for (scan.SkipSpace(); !scan.AtEnd() && !pen->full(); scan.SkipSpace()) {
    Vec2 p(0);
    if (!scan.ReadNumber(&p.x) || !scan.ReadNumber(&p.y)) return scan.fault();
    if (first) {
      pen->MoveTo(p);
    } else {
      pen->LineTo(p);
    }
    first = false;
  }
  pen->End(closed);
  return {};
}

}  // namespace fjord::formats
