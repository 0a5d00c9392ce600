#include "engine/formats/svg_pen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/base/clamp.h"
#include "engine/base/exact_math.h"
#include "engine/formats/limits.h"

namespace fjord::formats {
namespace {

constexpr int kMostPieces = 4096;
constexpr double kClosing = 1e-12;  // of the drawing: more than rounding of sums
constexpr double kQuarter = exact::kPi / 2;

double Norm(const Vec2& v) { return std::sqrt(v.x * v.x + v.y * v.y); }

}  // namespace

void SvgPen::Start(const SvgMatrix& matrix, bool painted) {
  End(false);
  matrix_ = matrix;
  painted_ = painted;
  here_ = start_ = Vec2(0);
}

Vec2 SvgPen::Mapped(const Vec2& p) {
  const Vec2 q = matrix_(p);
  for (int k = 0; k < 2; ++k) {
    if (!(q[k] >= -limits::kCoordinate && q[k] <= limits::kCoordinate)) beyond_ = true;
  }
  return q;
}

void SvgPen::AddPoint(const Vec2& p) {
  if (full_) return;
  curve_.points.push_back(Mapped(p));
  full_ = ++points_ > limits::kVertices;
}

void SvgPen::MoveTo(const Vec2& to) {
  End(false);
  here_ = start_ = to;
}

// Where a piece is drawn after a curve has ended, the next begins there.
void SvgPen::Begin() {
  if (curve_.points.empty()) AddPoint(here_);
}

void SvgPen::LineTo(const Vec2& to) {
  Begin();
  AddPoint(to);
  here_ = to;
}

void SvgPen::CurveTo(const Vec2& control1, const Vec2& control2, const Vec2& to) {
  Begin();
  AddPoint(to);
  here_ = to;
  if (full_) return;
  curve_.bends.push_back(
      {curve_.points.size() - 1, false, Mapped(control1), Mapped(control2), {}, 0, 0});
}

void SvgPen::ArcTo(const SvgEllipse& ellipse, double from, double turn, const Vec2& to) {
  Begin();
  AddPoint(to);
  here_ = to;
  if (full_) return;
  const SvgEllipse mapped = {Mapped(ellipse.center), matrix_.Direction(ellipse.u),
                             matrix_.Direction(ellipse.v)};
  curve_.bends.push_back({curve_.points.size() - 1, true, {}, {}, mapped, from, turn});
}

// Section B.2.4 of the SVG 2 specification: from end points to the centre.
void SvgPen::ArcTo(const Vec2& radii, double degrees, bool large, bool clockwise, const Vec2& to) {
  const Vec2 from = here_;
  if (from == to) return;
  Vec2 r(radii.x < 0 ? -radii.x : radii.x, radii.y < 0 ? -radii.y : radii.y);
  const double turns = degrees / 360;
  const double angle = (turns - static_cast<double>(FloorToInt64(turns))) * (2 * exact::kPi);
  const double c = exact::Cos(angle), s = exact::Sin(angle);
  const Vec2 half = (from - to) * .5;
  const Vec2 p(c * half.x + s * half.y, c * half.y - s * half.x);  // along the axes
  const Vec2 unit(p.x / r.x, p.y / r.y);
  const double reach = unit.x * unit.x + unit.y * unit.y;
  // Without a radius, or with one that is nothing beside the way to go or endless beside it, the
  // piece is straight.
  if (!(r.x > 0 && r.y > 0 && reach < 1e30) || (reach < 1e-14 && !large)) return LineTo(to);
  double shift = 0;
  if (reach > 1) {
    r *= std::sqrt(reach);
  } else {
    shift = std::sqrt((1 - reach) / reach) * (large == clockwise ? -1 : 1);
  }
  const double size = reach > 1 ? 1 / std::sqrt(reach) : 1;
  const Vec2 middle(shift * unit.y * size, -shift * unit.x * size);  // in radii
  const Vec2 begin = unit * size - middle, end = unit * -size - middle;
  const double first = exact::Atan2(begin.y, begin.x);
  double turn = exact::Atan2(end.y, end.x) - first;
  if (clockwise && turn < 0) turn += 2 * exact::kPi;
  if (!clockwise && turn > 0) turn -= 2 * exact::kPi;
  // The last bits may have it the wrong way round where the piece is nothing or all of the ellipse.
  const double size_of_turn = turn < 0 ? -turn : turn;
  if (large && size_of_turn < 1) turn += clockwise ? 2 * exact::kPi : -2 * exact::kPi;
  if (!large && size_of_turn > 5) turn -= clockwise ? 2 * exact::kPi : -2 * exact::kPi;

  SvgEllipse ellipse;
  ellipse.u = Vec2(c, s) * r.x;
  ellipse.v = Vec2(-s, c) * r.y;
  ellipse.center = (from + to) * .5 + ellipse.u * middle.x + ellipse.v * middle.y;
  const double quarters = (turn < 0 ? -turn : turn) / (kQuarter * (1 + 1e-9));
  const int count = static_cast<int>(std::clamp<int64_t>(FloorToInt64(quarters) + 1, 1, 4));
  for (int i = 1; i <= count && !full_; ++i) {
    const double at = first + turn * i / count;
    const Vec2 end_of_piece =
        ellipse.center + ellipse.u * exact::Cos(at) + ellipse.v * exact::Sin(at);
    ArcTo(ellipse, first + turn * (i - 1) / count, turn / count, i == count ? to : end_of_piece);
  }
}

void SvgPen::End(bool closed, bool summed) {
  curve_.closed = closed;
  curve_.summed = summed;
  curve_.painted = painted_;
  // A single point is nothing to draw.
  if (curve_.points.size() >= 2) curves_.push_back(std::move(curve_));
  curve_ = {};
  here_ = start_;
}

double SvgPen::Size() const {
  bool any = false;
  Vec2 low(0), high(0);
  const auto add = [&](const Vec2& p) {
    for (int k = 0; k < 2; ++k) {
      low[k] = any ? std::min(low[k], p[k]) : p[k];
      high[k] = any ? std::max(high[k], p[k]) : p[k];
    }
    any = true;
  };
  for (const Curve& curve : curves_) {
    for (const Vec2& p : curve.points) add(p);
    for (const Bend& bend : curve.bends) {
      if (bend.arc) continue;
      add(bend.a);
      add(bend.b);
    }
  }
  return std::max(high.x - low.x, high.y - low.y);
}

Vec2 SvgPen::PointOf(const Vec2& from, const Vec2& to, const Bend& bend, double t) {
  if (bend.arc) {
    const double at = bend.from + bend.turn * t;
    return bend.ellipse.center + bend.ellipse.u * exact::Cos(at) + bend.ellipse.v * exact::Sin(at);
  }
  const double u = 1 - t;
  return from * (u * u * u) + bend.a * (3 * u * u * t) + bend.b * (3 * u * t * t) +
         to * (t * t * t);
}

// Of n equal pieces each deviates by at most an eighth of the second derivative over n^2.
int SvgPen::PiecesOf(const Vec2& from, const Vec2& to, const Bend& bend, double tolerance) {
  double deviation = 0;
  if (bend.arc) {
    const Vec2& u = bend.ellipse.u;
    const Vec2& v = bend.ellipse.v;
    deviation = Norm(Vec2(Norm(u), Norm(v))) * bend.turn * bend.turn / 8;
  } else {
    deviation = .75 * std::max(Norm(from - bend.a * 2. + bend.b), Norm(bend.a - bend.b * 2. + to));
  }
  int n = 1;
  while (n < kMostPieces && deviation > tolerance * n * n) n *= 2;
  return n;
}

bool SvgPen::Flatten(const Curve& curve, double size, Polyline* out) {
  out->points.reserve(curve.points.size());
  const auto add = [out](const Vec2& p) { out->points.push_back({p.x, 0 - p.y, 0}); };
  size_t bend = 0;
  for (size_t k = 0; k < curve.points.size(); ++k) {
    if (bend < curve.bends.size() && curve.bends[bend].point == k) {
      const Vec2& from = curve.points[k - 1];
      const int n = PiecesOf(from, curve.points[k], curve.bends[bend], kSvgTolerance * size);
      points_ += static_cast<size_t>(n) - 1;
      if (points_ > limits::kVertices) return false;
      for (int i = 1; i < n; ++i) {
        add(PointOf(from, curve.points[k], curve.bends[bend], static_cast<double>(i) / n));
      }
      ++bend;
    }
    add(curve.points[k]);
  }
  const Vec3 gap = out->points.back() - out->points.front();
  if (curve.closed && out->points.size() > 1 &&
      (gap == Vec3(0) || (curve.summed && Length(gap) <= kClosing * size))) {
    out->points.pop_back();
  }
  out->closed = curve.closed && out->points.size() >= 3;
  return true;
}

bool SvgPen::LeavesOut() const {
  const auto painted = [](const Curve& curve) { return curve.painted; };
  return std::any_of(curves_.begin(), curves_.end(), painted) &&
         !std::all_of(curves_.begin(), curves_.end(), painted);
}

bool SvgPen::Take(std::vector<Polyline>* curves) {
  if (LeavesOut()) std::erase_if(curves_, [](const Curve& curve) { return !curve.painted; });
  const double size = Size();
  for (Curve& curve : curves_) {
    Polyline line;
    if (!Flatten(curve, size, &line)) return false;
    curve = {};
    if (line.points.size() >= 2) curves->push_back(std::move(line));
  }
  curves_.clear();
  return true;
}

}  // namespace fjord::formats
