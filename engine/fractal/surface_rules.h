// The surface method's settings worked out once an object: plain numbers that the kernels read, and
// the bounds that follow from them (S7). Immutable after MakeSurfaceRules.
#pragma once

#include <array>
#include <cstdint>

#include "engine/base/result.h"
#include "engine/fractal/method.h"
#include "engine/fractal/stages.h"

namespace fjord {

inline constexpr uint32_t kMaxSurfaceLevel = 60;

// What an input edge, or the inside of an input face, gives to all edges made on it.
struct EdgeSite {
  Vec3 direction{0};  // S18, S19: read where the rule is not VERTEX
  double coast = 0;   // 1: the edge moves level (S22)
};

struct SurfaceRules {
  Direction direction = Direction::kVertex;
  Variant variant = Variant::kFixed;
  Law law = Law::kAffine;
  Split split = Split::kShot;
  uint32_t max_level = 0;
  bool coast = false;
  bool sites = false;     // edges must know their EdgeSite
  bool even = false;      // edges know their triangles' shares (shares.h)
  bool by_place = false;  // coarse identities come from rest places, not numbers

  // Offsets.
  double affine_scale = 0;  // sigma A c(H)
  double half_H = 0;
  double similar = 0;  // r
  double coast_similar = 0;
  std::array<double, kMaxSurfaceLevel> shih{};  // Delta_i move, i = level of the edge
  uint32_t uniforms = 4;
  double gaussian_scale = 0;
  double gaussian_middle = 0;  // uniforms * 65535
  double perturb = 0;

  // An edge is long where length2 * length_scale > max(floor, slope * d2) or, with a ball of eyes,
  // slope * max(near, distance - eye_radius)^2: the two sides of frame.proto's FrameFineness
  // squared. Under ADAPTIVE e_k^2 of its stage stands for length2, and length_scale holds the
  // stages' reach.
  double length_scale = 1;
  double floor = 0;
  double slope = 0;
  double near = 0;
  double eye_radius = 0;
  Vec3 eye{0};
  Stages stages;

  // Does the split rule read the frame's own lengths instead of the rest pose's?
  bool current() const { return split == Split::kLength; }
  // Is the tree cut off and faded in by stages?
  bool staged() const { return split == Split::kAdaptive; }
};

// kInvalid for settings that are not the surface's, or a fineness that would never end.
// Of `stages` the unit is left to be set.
Result<SurfaceRules> MakeSurfaceRules(const FractalSettings& settings);

// What SurfaceReach reads of a triangle.
struct ReachInput {
  double longest_rest2 = 0;   // squared length of its longest edge in the rest pose
  double longest_now2 = 0;    // now
  double longest_coast2 = 0;  // of its longest coast edge, now
  double stretch = 1;         // largest
  double farthest2 = 0;       // largest squared eye distance of its corners
  uint32_t level = 0;
};

// How far from the triangle anything made of it can lie: the sum over the remaining levels of the
// largest offset, for a vertex's displacement is at most the mean of its ends' plus its own.
//
// affine   Lambda_k = longest rest edge at level k, e and f the largest and smallest length that is
//          short anywhere in the triangle. A long edge halves; a three-split's inner edges are half
//          an outer one; the median to the longer of two long edges has at most
//          (Lambda^2 + 2 e^2) / 4, the median to a single long one (4 e^2 - f^2) / 4. So
//          the sum of Lambda_k^H over the levels until Lambda_k <= f is taken term by term. EVEN's
//          medians of a three-split have at most kMostRight Lambda^2 / 4 (shares.h). Where
//          the split rule reads other lengths, Lambda_k = Lambda.
//          ADAPTIVE: the longest edges of stage k, shorter than 2 e_k, then what is left of them:
//          medians to the longer of two, of at most ((2 e_k)^2 + 2 e_k^2) / 4.
// similar, shih   offsets are c_k times current lengths, which grow to at most
//          max(1 + c_k, 1/2 + 2 c_k) Lambda_k.
// coasts   offsets of at most .49 of the edge, whose halves have at most .7001 of it.
//
// A slack covers rounding. +infinity where the bound overflows.
class SurfaceReach {
 public:
  struct Parts {
    double offsets = 0;  // along the directions of the rule
    double coasts = 0;   // level, any way
  };

  explicit SurfaceReach(const SurfaceRules& rules);
  Parts operator()(const ReachInput& input) const;

 private:
  double Affine(const ReachInput& input, uint32_t levels) const;
  double StagedPowers(double longest2, double nearest) const;
  double LongestShort2(double distance2) const;

  const SurfaceRules* rules_;
  double spread_;  // largest offset of one unit of amount
};

}  // namespace fjord
