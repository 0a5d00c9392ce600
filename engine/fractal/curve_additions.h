// Random additions (S6): a line whose increments are as large in one place as in another. Midpoint
// displacement leaves old points rougher or smoother than new ones; here every level adds its own
// noise to every point, old and new:
//
//   X(t) = sum over levels k of 2^(-kH) B(c 2^k t + phase_k),   t = 0..1 along the input edge,
//
// B independent Gaussians at the whole numbers, joined by straight lines, and phase_k drawn per
// level and edge, so that no place in t is special. The ends are kept: X less the straight line
// from X(0) to X(1) is added along the edge's normal. A point is a function of (edge, t) alone: its
// place changes neither with the fineness nor with what else is made.
//
// [N: with c 1 and phase 0 this is Saupe's "successive random additions", whose increments are less
// stationary than plain halving's (measured 1.8 against 3.3 at H .8); the phases repair that.]
#pragma once

#include "engine/fractal/curve_rules.h"

namespace fjord {

class CurveAdditions {
 public:
  explicit CurveAdditions(const FractalSettings& settings);

  // An input edge and the noise at its ends.
  struct Line {
    LineSegment edge;
    LineFrame frame;
    double first;
    double last;
  };
  Line Start(const LineSegment& edge, const LineFrame& frame) const;

  // The point place / 2^level of the line.
  Vec3 Place(const Line& line, uint64_t place, uint32_t level) const;

  // The furthest that a point of the edge can be from it.
  double Reach(const LineSegment& edge) const;

 private:
  double Noise(const Identity& edge, double t) const;
  double Deviation(const LineSegment& edge, double stretch) const;

  FractalSettings settings_;
  double decay_ = 0;  // 2^-H
  double scale_ = 0;  // makes E[(X(t+d) - X(t))^2] = d^(2H)
};

}  // namespace fjord
