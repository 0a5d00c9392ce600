#include "engine/fractal/curve_rules.h"

#include <cmath>

#include "engine/base/clamp.h"
#include "engine/base/exact_math.h"
#include "engine/fractal/amount.h"

namespace fjord {
namespace {

double Square(double x) { return x * x; }

double Larger(double a, double b) { return a > b ? a : b; }

double Clamped(double x, double limit) { return x > limit ? limit : (x < -limit ? -limit : x); }

// The part of d square to e.
Vec3 SquareTo(const Vec3& d, const Vec3& e) {
  const double length2 = glm::dot(e, e);
  return length2 > 0 ? d - e * (glm::dot(d, e) / length2) : d;
}

}  // namespace

Vec3 Softened(const Vec3& d) {
  const double length = Length(d);
  return d * (1 / Larger(length, kLeastSquare));
}

Vec3 RightNormal(const Vec3& along, const Vec3& plane) {
  const Vec3 right = glm::cross(along, plane);
  const double size = Larger(Length(right), kLeastSquare * Length(along));
  return size > 0 ? right * (1 / size) : Vec3(0);
}

StreamVertex ToStream(const LineVertex& v) {
  return {v.position, v.direction, v.id.lo, v.stretch, ClampToFloat(v.eye_distance2)};
}

float StretchOf(double sum, uint32_t edges) {
  const double mean = edges == 0 ? 1 : sum / edges;
  return static_cast<float>(mean < 1e6 ? mean : 1e6);
}

Result<LineRules> LineRules::Make(const FractalSettings& settings) {
  LineRules rules(settings);
  const int uniforms = static_cast<int>(settings.uniforms);
  rules.bound_ = GaussianBound(uniforms);
  rules.decay_ = exact::Exp2(-settings.H);
  rules.affine_ = settings.sigma * settings.amplitude * AffineConstant(settings.H);
  for (uint32_t i = 0; i < kMaxLineLevel; ++i) {
    rules.shih_[i] = ShihDeviation(settings.sigma, settings.H, static_cast<int>(i)) * settings.move;
  }
  if (settings.law == Law::kSimilar) {
    const Result<double> factor = SimilarFactor(settings.H, uniforms);
    if (!factor.ok()) {
      return factor.error();
    }
    rules.similar_ = *factor;
  }
  return rules;
}

LineRules::Size LineRules::Measure(const LineSegment& s) const {
  if (s.level() >= settings_.max_level) {
    return {0, 0};
  }
  const Fineness& fine = settings_.fineness;
  const Vec3 along = s.b.position - s.a.position;
  const bool rest = settings_.split != Split::kLength;
  const double length2 = rest ? s.rest2 : glm::dot(along, along);
  if (!(fine.focal > 0)) {
    return {length2, Square(fine.epsilon)};
  }
  double distance2 = 0;  // eye to the segment's middle
  if (rest) {
    distance2 = (s.a.eye_distance2 + s.b.eye_distance2) * .5 - s.rest2 * .25;
  } else {
    const Vec3 middle = (s.a.position + s.b.position) * .5 - fine.eye;
    distance2 = glm::dot(middle, middle);
  }
  const double reduced2 = fine.eye_radius > 0
                              ? Square(Larger(std::sqrt(Larger(distance2, 0)) - fine.eye_radius, 0))
                              : distance2;
  return {length2 * Square(fine.focal), Square(fine.pixels) * Larger(Square(fine.near), reduced2)};
}

Vec3 LineRules::Direction(const LineSegment& s, const LineFrame& frame, Identity id) const {
  const Vec3 along = s.b.position - s.a.position;
  const bool fixed = settings_.variant == Variant::kFixed;
  Vec3 direction;
  if (settings_.direction == Direction::kEdge) {
    direction = fixed ? frame.normal : RightNormal(along, frame.plane);
  } else {
    const Vec3 kept = settings_.direction == Direction::kUp ? Vec3(0, 0, 1)
                                                            : (s.a.direction + s.b.direction) * .5;
    direction = Softened(fixed ? kept : SquareTo(kept, along));
  }
  if (settings_.variant == Variant::kPerturbed) {
    // A turn: the length stays.
    const Vec3 tangent = Unit(s.b.id < s.a.id ? s.a.position - s.b.position : along);
    const double u = settings_.perturb * TangentDraw(id.lo);
    direction = (direction + tangent * (u * Length(direction))) / std::sqrt(1 + u * u);
  }
  return direction;
}

double LineRules::Offset(const LineSegment& s, double g, double stretch) const {
  if (settings_.law == Law::kAffine) {
    return affine_ * exact::Pow(s.rest2, .5 * settings_.H) * stretch * g;
  }
  const double length = Length(s.b.position - s.a.position);
  return settings_.law == Law::kSimilar ? Clamped(similar_ * g, kSimilarClamp) * length
                                        : shih_[s.level()] * g * length;
}

LineHalf LineRules::Halve(const LineSegment& s, const LineFrame& frame, const Size& size) const {
  LineHalf half;
  LineVertex& v = half.vertex;
  v.id = MidpointIdentity(s.a.id, s.b.id);
  v.level = s.level() + 1;
  v.place = (s.a.place + s.b.place) * .5;
  const double stretch = (static_cast<double>(s.a.stretch) + static_cast<double>(s.b.stretch)) * .5;
  v.stretch = static_cast<float>(stretch);
  const double distance2 = (s.a.eye_distance2 + s.b.eye_distance2) * .5 - s.rest2 * .25;
  v.eye_distance2 = Larger(distance2, 0);
  v.direction = Direction(s, frame, v.id);
  half.middle = (s.a.position + s.b.position) * .5;
  half.draw = Gaussian(v.id.lo, static_cast<int>(settings_.uniforms));
  half.offset = Offset(s, half.draw, settings_.stretch ? stretch : 1);
  if (settings_.split == Split::kAdaptive && size.threshold2 > 0) {
    // The last level grows in as the camera comes near. A segment's halves are shorter than all
    // that is wanted while it does, so nothing hangs on it yet and nothing pops.
    const double over = std::sqrt(size.length2 / size.threshold2) - 1;
    const double t = over < 1 ? over : 1;
    half.offset *= t * t * (3 - 2 * t);
  }
  v.position = half.middle + v.direction * half.offset;
  return half;
}

LineSegment LineRules::First(const LineSegment& s, const LineVertex& middle) const {
  return {s.a, middle, s.rest2 * .25, s.place * 2};
}

LineSegment LineRules::Second(const LineSegment& s, const LineVertex& middle) const {
  return {middle, s.b, s.rest2 * .25, s.place * 2 + 1};
}

uint32_t LineRules::RemainingLevels(const LineSegment& s) const {
  const Fineness& fine = settings_.fineness;
  const uint32_t level = s.level();
  const uint32_t most = level < settings_.max_level ? settings_.max_level - level : 0;
  if (settings_.split == Split::kLength) {
    return most;
  }
  // The smallest threshold there is: the shot's, or that of the nearest distance that counts.
  const double threshold2 = fine.focal > 0
                                ? Square(fine.pixels * fine.near / fine.focal) * (1 - 1e-9)
                                : Square(fine.epsilon);
  uint32_t levels = 0;
  for (double rest2 = s.rest2; levels < most && rest2 > threshold2; rest2 *= .25) {
    ++levels;
  }
  return levels;
}

// Let S_k be the set of segments k levels below s, l_k the longest of them now, and R_k the
// furthest that a midpoint of S_k moves. A point of a child lies within R_k of its parent, so all
// that s becomes lies within the sum of R_k, k < remaining levels, of s. With G the bound of the
// Gaussian:
//   affine   R_k = sigma A c G stretch (rest length / 2^k)^H, stretch that of the larger end
//   others   R_k = c_k l_k, and l_(k+1)^2 <= l_k^2 (1/4 + c_k^2 + c_k q), q the largest cosine
//   between
//            the direction and the segment: 1e-3 for CURRENT (rounding); u / sqrt(1 + u^2), u =
//            perturb / 2, for PERTURBED; 1 for FIXED, whose direction knows nothing of the segment
double LineRules::Reach(const LineSegment& s) const {
  const uint32_t levels = RemainingLevels(s);
  double sum = 0;
  double length = Length(s.b.position - s.a.position);
  if (settings_.law == Law::kAffine) {
    const double stretch =
        settings_.stretch ? static_cast<double>(Larger(s.a.stretch, s.b.stretch)) : 1;
    double reach =
        levels > 0 ? affine_ * bound_ * stretch * exact::Pow(s.rest2, .5 * settings_.H) : 0;
    for (uint32_t k = 0; k < levels; ++k, reach *= decay_) {
      sum += reach;
    }
  } else {
    const double u = .5 * settings_.perturb;
    const double cosine = settings_.variant == Variant::kCurrent     ? 1e-3
                          : settings_.variant == Variant::kPerturbed ? u / std::sqrt(1 + u * u)
                                                                     : 1;
    const double similar = Clamped(similar_ * bound_, kSimilarClamp);
    for (uint32_t k = 0; k < levels; ++k) {
      const double c = settings_.law == Law::kSimilar ? similar : shih_[s.level() + k] * bound_;
      sum += c * length;
      length *= std::sqrt(.25 + c * c + c * cosine);
    }
  }
  const double size = Length(s.a.position) + Length(s.b.position) + sum;
  return sum * (1 + 1e-9) + 1e-12 * size;
}

}  // namespace fjord
