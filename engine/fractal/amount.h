// How far a midpoint moves: the laws of amount (design 1). Plain numbers worked out once an object.
//
// affine   deviation = sigma A (rest length)^H c(H) stretch      fBm of that H
// similar  offset = r g (current length), |r g| <= kSimilarClamp; r from the dimension D = 2 - H:
//          2 E[(1/4 + min(r |g|, kSimilarClamp)^2)^(D/2)] = 1
// shih     offset = Delta_i g move (current length),
//          Delta_i = sigma 2^(-iH) sqrt(1/2) sqrt(1 - 2^(2H-2))
//          [T: shrinks twice, so it measures as H = 1 whatever H is asked]
#pragma once

#include "engine/base/result.h"

namespace fjord {

// Offsets of the similar law never reach further than this share of the segment, so that a
// segment's children are shorter than .71 of it and everything below it stays within a finite
// reach.
inline constexpr double kSimilarClamp = .49;

// A direction that is made square to a segment is brought to unit length where at least this much
// of it is left, and below that in proportion: a segment that swings past it carries its midpoint
// through its own middle, where unit length alone would make it jump to the other side (S25).
inline constexpr double kLeastSquare = .25;

// 2^-H sqrt(1 - 2^(2H-2)); 0 at H = 1.
double AffineConstant(double H);

// Deviation of level n >= 1 on a unit interval (S6): sigma^2 / 2^(2nH) (1 - 2^(2H-2)), its root.
double LevelDeviation(double sigma, double H, int n);

// Delta_i of S14, i from 0.
double ShihDeviation(double sigma, double H, int i);

// r of the similar law for Gaussians of n uniforms. kInvalid where D = 2 - H cannot be reached with
// the clamp (H below about .06).
Result<double> SimilarFactor(double H, int uniforms);

// The H at which the similar law makes coasts of triangles that measure as `H`, in spite of what is
// held back (coast.h): fitted to rulers for D = 2 - H up to 1.4; beyond, coasts stay smoother.
double HeldBackH(double H);

}  // namespace fjord
