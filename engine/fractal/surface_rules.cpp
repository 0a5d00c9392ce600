#include "engine/fractal/surface_rules.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "engine/base/exact_math.h"
#include "engine/base/random.h"
#include "engine/fractal/amount.h"
#include "engine/fractal/shares.h"

namespace fjord {
namespace {

constexpr double kSlack = 1 + 1e-9;
// Squared eye distances are kept as floats, rounded once a level: an error of at most
// kMaxSurfaceLevel 2^-24 of the farthest, which (x + kDistanceSlack)^2 - x^2 exceeds for every x >=
// 0.
constexpr double kDistanceSlack = 2e-3;

bool Finite(double x) { return x - x == 0; }

Result<Ok> SetFineness(const FractalSettings& settings, SurfaceRules* rules) {
  const Fineness& fine = settings.fineness;
  rules->eye = fine.eye;
  if (fine.focal > 0) {
    if (!(fine.pixels > 0) || !(fine.near >= 0) || !(fine.eye_radius >= 0) ||
        !Finite(fine.focal * fine.pixels * fine.near * fine.eye_radius)) {
      return Invalid("a fineness in pixels needs pixels above 0 and near and eye_radius from 0");
    }
    rules->length_scale = fine.focal * fine.focal;
    rules->slope = fine.pixels * fine.pixels;
    rules->near = fine.near;
    rules->eye_radius = fine.eye_radius;
    rules->floor = rules->slope * (fine.near * fine.near);
  } else {
    if (!(fine.epsilon > 0) || !Finite(fine.epsilon)) {
      return Invalid("epsilon must be above 0");
    }
    rules->floor = fine.epsilon * fine.epsilon;
  }
  if (rules->staged()) {
    const bool by_distance = fine.focal > 0;
    rules->stages.SetFineness(by_distance ? fine.focal / fine.pixels : 1, by_distance);
    rules->length_scale = rules->stages.scale2;
    if (by_distance) {
      rules->slope = 1;
      rules->floor = fine.near * fine.near;
    }
  }
  return Ok{};
}

}  // namespace

Result<SurfaceRules> MakeSurfaceRules(const FractalSettings& settings) {
  SurfaceRules rules;
  rules.direction = settings.direction;
  rules.variant = settings.variant;
  rules.law = settings.law;
  rules.split = settings.split;
  rules.max_level = std::min(settings.max_level, kMaxSurfaceLevel);
  rules.coast = settings.coast;
  rules.sites = settings.coast || settings.direction == Direction::kEdge ||
                settings.direction == Direction::kFace;
  rules.by_place = settings.by_place;
  rules.even = settings.increments == Increments::kEven;
  rules.affine_scale = settings.sigma * settings.amplitude * AffineConstant(settings.H);
  rules.half_H = settings.H * .5;
  rules.uniforms = settings.uniforms;
  const int n = static_cast<int>(settings.uniforms);
  rules.gaussian_scale = GaussianScale(n);
  rules.gaussian_middle = n * 65535.0;
  rules.perturb = settings.variant == Variant::kPerturbed ? settings.perturb : 0;
  if (settings.law == Law::kSimilar) {
    const Result<double> factor = SimilarFactor(settings.H, n);
    if (!factor.ok()) return factor.error();
    rules.similar = *factor * settings.sigma;
  }
  if (settings.coast) {
    const Result<double> factor = SimilarFactor(settings.coast_H, n);
    if (!factor.ok()) return factor.error();
    rules.coast_similar = *factor;
  }
  for (uint32_t i = 0; i < kMaxSurfaceLevel; ++i) {
    rules.shih[i] = ShihDeviation(settings.sigma, settings.H, static_cast<int>(i)) * settings.move;
  }
  if (const Result<Ok> fine = SetFineness(settings, &rules); !fine.ok()) return fine.error();
  return rules;
}

SurfaceReach::SurfaceReach(const SurfaceRules& rules) : rules_(&rules) {
  const double sideways = rules.perturb * .5;
  spread_ = std::sqrt(1 + sideways * sideways) * kSlack;
}

// The longest length, squared, that is short at this distance.
double SurfaceReach::LongestShort2(double distance2) const {
  double side = rules_->floor;
  if (rules_->slope > 0) {
    const double distance =
        std::max(rules_->near, std::sqrt(std::max(distance2, 0.0)) - rules_->eye_radius);
    side = rules_->slope * (distance * distance);
  }
  return side / rules_->length_scale;
}

// Sum of the longest rest lengths of all midpoints' edges to the power of H, a stage after the
// other, as far as weights can be above 0.
double SurfaceReach::StagedPowers(double longest2, double nearest) const {
  const SurfaceRules& rules = *rules_;
  const Stages& stages = rules.stages;
  const double from =
      rules.slope > 0 ? std::max(rules.near, nearest - rules.eye_radius) : std::sqrt(rules.floor);
  double sum = 0;
  double now2 = longest2;
  if (!(longest2 > 0)) return 0;
  for (uint32_t stage = stages.StageOf(longest2); stage <= rules.max_level; ++stage) {
    const double length2 = stages.Length2(stage);
    const double start = stages.start * kSlack;
    if (start * start * length2 < from * from) break;
    sum += exact::Pow(now2, rules.half_H) + exact::Pow((now2 + 2 * length2) * .25, rules.half_H);
    now2 = length2;
  }
  return sum * kSlack;
}

double SurfaceReach::Affine(const ReachInput& input, uint32_t levels) const {
  const SurfaceRules& rules = *rules_;
  const double longest2 = input.longest_rest2 * kSlack;
  const double amount =
      rules.affine_scale * GaussianBound(static_cast<int>(rules.uniforms)) * input.stretch;
  if (rules.current()) return amount * exact::Pow(longest2, rules.half_H) * levels;
  const double far = std::sqrt(input.farthest2);
  const double nearest = far * (1 - kDistanceSlack) - std::sqrt(longest2);
  if (rules.staged()) {
    return amount * StagedPowers(input.longest_rest2, nearest > 0 ? nearest : 0) * kSlack;
  }
  const double farthest = far * (1 + 1e-5);
  const double e2 = LongestShort2(farthest * farthest) * kSlack;
  const double f2 = LongestShort2(nearest > 0 ? nearest * nearest : 0);
  const double three = rules.even ? kMostRight : 1;
  double sum = 0;
  double now2 = longest2;
  for (uint32_t k = 0; now2 > f2 && k < levels; ++k) {
    sum += exact::Pow(now2, rules.half_H) * kSlack;
    const double median2 = std::max((now2 + 2 * e2) * .25, e2 - f2 * .25);
    now2 = std::min(now2, std::max(median2, now2 * three * .25)) * kSlack;
  }
  return amount * sum;
}

SurfaceReach::Parts SurfaceReach::operator()(const ReachInput& input) const {
  const SurfaceRules& rules = *rules_;
  const uint32_t levels = rules.max_level > input.level ? rules.max_level - input.level : 0;
  if (levels == 0) return {};
  const double coast = kSimilarClamp * std::sqrt(input.longest_coast2);
  double reach = 0;
  if (rules.law == Law::kAffine) {
    reach = Affine(input, levels) * spread_;
  } else {
    const double bound = GaussianBound(static_cast<int>(rules.uniforms));
    double longest = std::sqrt(input.longest_now2) * kSlack;
    double level_coast = coast;
    // A stage makes midpoints of midpoints once more.
    const uint32_t generations = rules.staged() ? 2 : 1;
    for (uint32_t i = 0; i < generations * levels; ++i) {
      const uint32_t level = input.level + i / generations;
      const double share = rules.law == Law::kShih ? rules.shih[level] * bound
                                                   : std::min(rules.similar * bound, kSimilarClamp);
      const double moved = share * spread_ * longest;
      const double offset = moved + level_coast;
      reach += moved;
      longest = std::max(longest + offset, longest * .5 + 2 * offset) * kSlack;
      level_coast *= .7002;
    }
  }
  reach = reach * kSlack * kSlack;
  return {reach == reach ? reach : std::numeric_limits<double>::infinity(),
          coast / (1 - .7002) * kSlack};
}

}  // namespace fjord
