#include "engine/fractal/curve_additions.h"

#include <cmath>

#include "engine/base/clamp.h"
#include "engine/base/exact_math.h"

namespace fjord {
namespace {

// Levels that are added: lattices down to 2^-24 of an edge, finer than any picture shows.
constexpr int kLevels = 25;

// Cells along an edge at level 0, times 2 a level. Golden, so that cells and dyadic places never
// fall into step: every place meets all phases.
constexpr double kCells = 0x1.9e3779b97f4a8p0;

// E[(B(u+x) - B(u))^2] over a uniformly drawn u.
double Structure(double x) {
  if (x <= 1) {
    return x * x * (2 - x);
  }
  const double left = x < 2 ? 2 - x : 0;
  return 4.0 / 3 - left * left * left / 3;
}

}  // namespace

CurveAdditions::CurveAdditions(const FractalSettings& settings)
    : settings_(settings), decay_(exact::Exp2(-settings.H)) {
  // A small d sees lattices of all sizes: the sum over all whole k of 2^(-2kH) Structure(kCells
  // 2^k).
  double sum = 0;
  for (int k = -40; k <= 40; ++k) {
    sum += exact::Exp2(-2 * settings.H * k) * Structure(kCells * exact::Exp2(k));
  }
  scale_ = 1 / std::sqrt(sum);
}

double CurveAdditions::Noise(const Identity& edge, double t) const {
  const int uniforms = static_cast<int>(settings_.uniforms);
  double sum = 0;
  double amount = 1;
  double cells = kCells;
  for (uint64_t k = 0; k < kLevels; ++k) {
    const uint64_t key = DrawBits(edge.lo, 64 + k);
    const double phase = static_cast<double>(key >> 40) * 0x1p-24;
    const double u = t * cells + phase;
    const int64_t cell = FloorToInt64(u);
    const double part = u - static_cast<double>(cell);
    const uint64_t number = static_cast<uint64_t>(cell);
    const double a = Gaussian(DrawBits(key, number + 1), uniforms);
    const double b = Gaussian(DrawBits(key, number + 2), uniforms);
    sum += amount * (a + (b - a) * part);
    amount *= decay_;
    cells *= 2;
  }
  return sum;
}

double CurveAdditions::Deviation(const LineSegment& edge, double stretch) const {
  return settings_.sigma * settings_.amplitude * scale_ * exact::Pow(edge.rest2, .5 * settings_.H) *
         (settings_.stretch ? stretch : 1);
}

CurveAdditions::Line CurveAdditions::Start(const LineSegment& edge, const LineFrame& frame) const {
  const Identity id = MidpointIdentity(edge.a.id, edge.b.id);
  return {edge, frame, Noise(id, 0), Noise(id, 1)};
}

Vec3 CurveAdditions::Place(const Line& line, uint64_t place, uint32_t level) const {
  const LineVertex& a = line.edge.a;
  const LineVertex& b = line.edge.b;
  const double t = static_cast<double>(place) / static_cast<double>(uint64_t{1} << level);
  const double noise = Noise(MidpointIdentity(a.id, b.id), t);
  const double bridge = noise - (line.first + (line.last - line.first) * t);
  const double stretch = static_cast<double>(a.stretch) +
                         (static_cast<double>(b.stretch) - static_cast<double>(a.stretch)) * t;
  const Vec3 straight = a.position + (b.position - a.position) * t;
  return straight + line.frame.normal * (Deviation(line.edge, stretch) * bridge);
}

// |X| stays below G times the sum of 2^(-kH), and the straight line between two values of X too.
double CurveAdditions::Reach(const LineSegment& edge) const {
  double sum = 0;
  double amount = 1;
  for (int k = 0; k < kLevels; ++k, amount *= decay_) {
    sum += amount;
  }
  const double stretch =
      static_cast<double>(edge.a.stretch > edge.b.stretch ? edge.a.stretch : edge.b.stretch);
  const double reach =
      2 * sum * GaussianBound(static_cast<int>(settings_.uniforms)) * Deviation(edge, stretch);
  return reach * (1 + 1e-9) + 1e-12 * (Length(edge.a.position) + Length(edge.b.position) + reach);
}

}  // namespace fjord
