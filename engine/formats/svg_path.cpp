#include "engine/formats/svg_path.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/exact_math.h"
#include "engine/formats/limits.h"
#include "engine/formats/svg_scan.h"
#include "engine/formats/text.h"

namespace fjord::formats {
namespace {

constexpr double kDeviation = 1e-4;  // of the length of the control polygon
constexpr int kMostPieces = 128;     // enough for kDeviation

double Distance(const Vec2& a, const Vec2& b) { return Length(Vec3(b - a, 0)); }

// Segments for a cubic: its deviation over n pieces is at most (1/8) |B''|max / n^2.
int PiecesOf(const Vec2& p0, const Vec2& p1, const Vec2& p2, const Vec2& p3) {
  const double length = Distance(p0, p1) + Distance(p1, p2) + Distance(p2, p3);
  const double bend = std::max(Distance(p1 * 2., p0 + p2), Distance(p2 * 2., p1 + p3));
  int n = 1;
  while (n < kMostPieces && .75 * bend > kDeviation * length * n * n) ++n;
  return n;
}

class PathParser {
 public:
  PathParser(std::string_view data, size_t most, std::vector<SvgCurve>* curves)
      : scan_(data), most_(most), curves_(curves) {}

  SvgFault Run() {
    for (scan_.SkipSpace(); !scan_.AtEnd(); scan_.SkipSpace()) {
      const SvgFault fault = Command();
      if (!fault.ok()) return fault;
      if (points_ > most_) return scan_.Fault("more than 16,000,000 points");
    }
    EndCurve(false);
    return {};
  }

 private:
  SvgFault Command() {
    const char letter = scan_.Peek();
    const bool relative = letter >= 'a' && letter <= 'z';
    const char upper = relative ? static_cast<char>(letter - 'a' + 'A') : letter;
    if (upper == 'A') return scan_.Fault("arcs (A) are not read; turn objects into Bezier paths");
    if (std::string_view("MLHVCSQTZ").find(upper) == std::string_view::npos) {
      return scan_.Fault(text::Quoted(std::string(1, letter)) +
                         " is no path command; M L H V C S Q T Z and small letters are read");
    }
    if (!started_ && upper != 'M') return scan_.Fault("a path starts with M");
    scan_.Skip();
    if (upper == 'Z') {
      EndCurve(true);
      return {};
    }
    if (!scan_.AtNumber()) return scan_.Fault("a number is missing");
    char command = upper;
    while (scan_.AtNumber()) {
      if (!Piece(command, relative ? here_ : Vec2(0))) return scan_.fault();
      if (points_ > most_) return {};
      if (command == 'M') command = 'L';
    }
    return {};
  }

  // One set of numbers of a command; `origin` is what they are relative to.
  bool Piece(char command, const Vec2& origin) {
    Vec2 p[3];
    const int count = command == 'C' ? 3 : command == 'S' || command == 'Q' ? 2 : 1;
    if (command == 'H' || command == 'V') {
      double value = 0;
      if (!scan_.ReadNumber(&value)) return false;
      const int axis = command == 'H' ? 0 : 1;
      Vec2 to = here_;
      to[axis] = origin[axis] + value;
      LineTo(to);
      return true;
    }
    for (int i = 0; i < count; ++i) {
      if (!scan_.ReadNumber(&p[i].x) || !scan_.ReadNumber(&p[i].y)) return false;
      p[i] += origin;
    }
    const Vec2 mirrored = here_ * 2. - control_;
    switch (command) {
      case 'M':
        EndCurve(false);
        started_ = true;
        here_ = start_ = control_ = p[0];
        break;
      case 'L':
        LineTo(p[0]);
        break;
      case 'C':
        CurveTo(p[0], p[1], p[2]);
        last_ = 'C';
        return true;
      case 'S':
        CurveTo(last_ == 'C' ? mirrored : here_, p[0], p[1]);
        last_ = 'C';
        return true;
      case 'Q':
        QuadraticTo(p[0], p[1]);
        return true;
      default:  // 'T'
        QuadraticTo(last_ == 'Q' ? mirrored : here_, p[0]);
        return true;
    }
    last_ = command;
    return true;
  }

  void Begin() {
    if (!curve_.points.empty()) return;
    curve_.points.push_back(here_);
    ++points_;
  }

  void LineTo(const Vec2& to) {
    Begin();
    curve_.points.push_back(to);
    ++points_;
    here_ = control_ = to;
    last_ = 'L';
  }

  void CurveTo(const Vec2& p1, const Vec2& p2, const Vec2& p3) {
    Begin();
    const Vec2 p0 = here_;
    const int n = PiecesOf(p0, p1, p2, p3);
    for (int i = 1; i < n; ++i) {
      const double t = static_cast<double>(i) / n, u = 1 - t;
      curve_.points.push_back(p0 * (u * u * u) + p1 * (3 * u * u * t) + p2 * (3 * u * t * t) +
                              p3 * (t * t * t));
    }
    curve_.points.push_back(p3);
    points_ += static_cast<size_t>(n);
    here_ = p3;
    control_ = p2;
  }

  void QuadraticTo(const Vec2& q, const Vec2& to) {
    const Vec2 from = here_;
    CurveTo(from + (q - from) * (2 / 3.), to + (q - to) * (2 / 3.), to);
    control_ = q;
    last_ = 'Q';
  }

  // A piece of a single point is nothing to draw.
  void EndCurve(bool closed) {
    if (closed && curve_.points.size() > 1 && curve_.points.front() == curve_.points.back()) {
      curve_.points.pop_back();
    }
    curve_.closed = closed && curve_.points.size() >= 3;
    if (curve_.points.size() >= 2) curves_->push_back(std::move(curve_));
    curve_ = {};
    here_ = control_ = start_;
    last_ = 'Z';
  }

  SvgScan scan_;
  const size_t most_;
  std::vector<SvgCurve>* curves_;
  SvgCurve curve_;
  Vec2 here_{0}, start_{0}, control_{0};
  char last_ = 'Z';
  bool started_ = false;
  size_t points_ = 0;
};

double Radians(double degrees) { return degrees * (exact::kPi / 180); }

}  // namespace

SvgMatrix operator*(const SvgMatrix& o, const SvgMatrix& i) {
  return {o.a * i.a + o.c * i.b, o.b * i.a + o.d * i.b,       o.a * i.c + o.c * i.d,
          o.b * i.c + o.d * i.d, o.a * i.e + o.c * i.f + o.e, o.b * i.e + o.d * i.f + o.f};
}

SvgFault ParsePath(std::string_view data, size_t most_points, std::vector<SvgCurve>* curves) {
  return PathParser(data, most_points, curves).Run();
}

SvgFault ParsePoints(std::string_view list, size_t most_points, std::vector<Vec2>* points) {
  SvgScan scan(list);
  for (scan.SkipSpace(); !scan.AtEnd(); scan.SkipSpace()) {
    Vec2 p(0);
    if (!scan.ReadNumber(&p.x) || !scan.ReadNumber(&p.y)) return scan.fault();
    if (points->size() >= most_points) return scan.Fault("more than 16,000,000 points");
    points->push_back(p);
  }
  return {};
}

SvgFault ParseTransform(std::string_view text, SvgMatrix* matrix) {
  SvgScan scan(text);
  *matrix = {};
  for (scan.SkipSpace(); !scan.AtEnd(); scan.SkipSpace()) {
    const std::string_view word = scan.ReadWord();
    scan.SkipSpace();
    if (scan.Peek() != '(') return scan.Fault("a transform is written as name(numbers)");
    scan.Skip();
    double v[6] = {};
    int n = 0;
    while (n < 6 && scan.AtNumber()) {
      if (!scan.ReadNumber(&v[n++])) return scan.fault();
    }
    scan.SkipSpace();
    if (scan.Peek() != ')') return scan.Fault("')' is missing");
    SvgMatrix next;
    if (word == "matrix" && n == 6) {
      next = {v[0], v[1], v[2], v[3], v[4], v[5]};
    } else if (word == "translate" && (n == 1 || n == 2)) {
      next = {1, 0, 0, 1, v[0], v[1]};
    } else if (word == "scale" && (n == 1 || n == 2)) {
      next = {v[0], 0, 0, n == 1 ? v[0] : v[1], 0, 0};
    } else if (word == "rotate" && (n == 1 || n == 3)) {
      const double s = exact::Sin(Radians(v[0])), c = exact::Cos(Radians(v[0]));
      next = SvgMatrix{1, 0, 0, 1, v[1], v[2]} * SvgMatrix{c, s, -s, c, 0, 0} *
             SvgMatrix{1, 0, 0, 1, -v[1], -v[2]};
    } else if ((word == "skewX" || word == "skewY") && n == 1) {
      const double c = exact::Cos(Radians(v[0]));
      const double t = c == 0 ? 0 : exact::Sin(Radians(v[0])) / c;
      next = word == "skewX" ? SvgMatrix{1, 0, t, 1, 0, 0} : SvgMatrix{1, t, 0, 1, 0, 0};
    } else {
      return scan.Fault(text::Quoted(word) + " with " + std::to_string(n) +
                        " numbers is no transform that is read");
    }
    const bool turns = word == "rotate" || word == "skewX" || word == "skewY";
    if (turns && (v[0] > 36000 || v[0] < -36000))
      return scan.Fault("an angle beyond 36000 degrees");
    scan.Skip();
    *matrix = *matrix * next;
  }
  return {};
}

SvgFault ParseLength(std::string_view text, double* value) {
  struct Unit {
    std::string_view name;
    double pixels;
  };
  constexpr std::array<Unit, 8> kUnits = {{{"", 1},
                                           {"px", 1},
                                           {"in", 96},
                                           {"cm", 96 / 2.54},
                                           {"mm", 96 / 25.4},
                                           {"q", 96 / 101.6},
                                           {"pt", 96 / 72.},
                                           {"pc", 16}}};
  SvgScan scan(text);
  if (!scan.ReadNumber(value)) return scan.fault();
  const SvgFault unknown =
      scan.Fault("a length is in px, in, cm, mm, Q, pt or pc; others are not read");
  std::string word(scan.ReadWord());
  for (char& c : word) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  scan.SkipSpace();
  if (!scan.AtEnd()) return unknown;
  for (const Unit& unit : kUnits) {
    if (unit.name != word) continue;
    *value *= unit.pixels;
    return {};
  }
  return unknown;
}

}  // namespace fjord::formats
