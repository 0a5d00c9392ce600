// The stages of split ADAPTIVE: one tree for all cameras, cut off and faded in by distance alone,
// so that nothing jumps however the camera moves.
//
// With e_k = unit / 2^k, unit a little more than the longest input edge, stage k = 1, 2, ... halves
// the edges whose rest length is e_k or more; all of them are shorter than 2 e_k by then, and the
// templates of S21 cut the triangles. A triangle waits until its own longest edges have had their
// turn. D is the distance from the eye to the middle of an edge in the rest pose.
//
// Invariants
// C1 Which triangles a triangle is cut into, and its vertices' directions, follow from the rest
// pose:
//    the camera only says how far down the tree goes.
// C2 A midpoint's offset is multiplied by a weight that falls evenly with D: 1 up to full e_k, 0
//    from start e_k on.
// C3 An edge of stage k is halved where D < (start + margin) e_k. The middles of a triangle's edges
//    are no further apart than margin e_k: so where any weight is above 0 the whole template is
//    made, and a triangle that is cut in part is flat, whichever way it is cut. The next stage ends
//    well within this one, for start is never below kLeastStart.
//
// Where one length is the fineness of the whole object, D is the same everywhere. Plain values,
// immutable once made.
#pragma once

#include <bit>
#include <cstdint>

namespace fjord {

struct Stages {
  // A stage's longest edges, 2 e_k, have kStartLength times the wanted length where it begins to
  // show.
  static constexpr double kStartLength = 1.4142135623730951;
  static constexpr double kFullShare = .6;  // full / start
  static constexpr double kMargin = 1.01;
  static constexpr double kLeastStart = 3.1;

  double twice_inverse2 = 1;  // 2 / unit^2
  double half_unit2 = 1;      // unit^2 / 2
  double start = 0;
  double full = 0;
  double scale2 = 0;  // (start + margin)^2

  // `ratio`: wanted distance over wanted length; `by_distance`: D differs from place to place.
  void SetFineness(double ratio, bool by_distance) {
    start = kStartLength * ratio;
    if (by_distance && start < kLeastStart) start = kLeastStart;
    full = kFullShare * start;
    const double reach = by_distance ? start + kMargin : start;
    scale2 = reach * reach;
  }
  void SetUnit(double longest2) {
    const double unit2 = longest2 > 1e-300 ? longest2 * (1 + 0x1p-20) : 1;
    twice_inverse2 = 2 / unit2;
    half_unit2 = unit2 * .5;
  }

  // The stage that halves an edge of this squared length; lanes do the same (patch_lanes-inl.h).
  uint32_t StageOf(double length2) const {
    return 512 - static_cast<uint32_t>(std::bit_cast<uint64_t>(length2 * twice_inverse2) >> 53);
  }
  // e_k squared.
  double Length2(uint32_t stage) const {
    return std::bit_cast<double>(uint64_t{1024 - 2 * stage} << 52) * half_unit2;
  }
};

}  // namespace fjord
