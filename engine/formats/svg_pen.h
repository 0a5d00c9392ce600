// Draws the pieces of a .svg file (straight, Bezier, elliptical) into curves. Curved pieces are
// kept as they are until all is drawn, since how finely they are cut follows from the size of the
// whole drawing.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/formats/svg_matrix.h"
#include "engine/geometry/mesh.h"
#include "engine/geometry/vec.h"

namespace fjord::formats {

// A curved piece deviates from its chain by at most this part of the drawing: of the longer side of
// the box around its points, control points, and the ends of the quarters that arcs are cut into.
inline constexpr double kSvgTolerance = 1e-4;

// The two half axes of an ellipse: a point of it is centre + u cos t + v sin t.
struct SvgEllipse {
  Vec2 center{0}, u{0}, v{0};
};

class SvgPen {
 public:
  // What is drawn next is in coordinates that `matrix` maps to the drawing's, and `painted`, or
  // nothing of it is seen. Ends the curve.
  void Start(const SvgMatrix& matrix, bool painted);

  void MoveTo(const Vec2& to);
  void LineTo(const Vec2& to);
  void CurveTo(const Vec2& control1, const Vec2& control2, const Vec2& to);
  // The piece of `ellipse` from t = `from` on by `turn`, at most a quarter, in radians.
  void ArcTo(const SvgEllipse& ellipse, double from, double turn, const Vec2& to);
  // The A of paths: radii, the turn of the first in degrees, and two flags.
  void ArcTo(const Vec2& radii, double degrees, bool large, bool clockwise, const Vec2& to);
  // Of a `closed` curve the last point is left out where it is the first; where sums of relative
  // coordinates led there (`summed`) also where it is so but for their rounding.
  void End(bool closed, bool summed = false);

  const Vec2& here() const { return here_; }
  const Vec2& start() const { return start_; }  // of the curve

  // More points than a file may hold: nothing is drawn any more.
  bool full() const { return full_; }
  // A point that has no number or is beyond 1e15.
  bool beyond() const { return beyond_; }

  // How many curves have been drawn.
  size_t size() const { return curves_.size(); }
  // Curves of both kinds have been drawn: those that are not painted will be left out.
  bool LeavesOut() const;

  // All curves of two points or more, y turned up; where there are painted ones, only these. False
  // where they have more points than a file may hold.
  bool Take(std::vector<Polyline>* curves);

 private:
  struct Bend {
    size_t point;  // of the curve, where the piece ends
    bool arc;
    Vec2 a, b;  // Bezier: control points
    SvgEllipse ellipse;
    double from, turn;
  };
  struct Curve {
    std::vector<Vec2> points;
    std::vector<Bend> bends;
    bool closed = false, summed = false, painted = true;
  };

  void Begin();
  void AddPoint(const Vec2& p);
  Vec2 Mapped(const Vec2& p);
  double Size() const;  // of the drawing
  bool Flatten(const Curve& curve, double size, Polyline* out);
  static int PiecesOf(const Vec2& from, const Vec2& to, const Bend& bend, double tolerance);
  static Vec2 PointOf(const Vec2& from, const Vec2& to, const Bend& bend, double t);

  SvgMatrix matrix_;
  bool painted_ = true;
  Vec2 here_{0}, start_{0};  // not mapped
  Curve curve_;
  std::vector<Curve> curves_;
  size_t points_ = 0;
  bool full_ = false, beyond_ = false;
};

}  // namespace fjord::formats
