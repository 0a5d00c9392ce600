// The ways points travel between key pictures (S25): polynomial curves of + - * only.
#pragma once

#include <array>
#include <span>

#include "engine/geometry/vec.h"

namespace fjord {

// Bezier curve of any degree by de Casteljau (G49): starts at the first control point, ends at the
// last, leaves and arrives along the first and last leg. t in 0..1; not empty.
Vec3 Bezier(std::span<const Vec3> control, double t);

// Smooth cubic through all knots, knot i at t = i / (count - 1) bit for bit. Two knots or more; two
// make a straight line.
Vec3 Through(std::span<const Vec3> knots, double t);

// The weights of the four keys around a piece of the cubic through keys at uneven times: keys i-1,
// i, i+1, i+2 at times[0..3], t in 0..1 between the middle two. Where there is no key before or
// after, has_before or has_after is false, its weight 0, and the curve ends without bending.
std::array<double, 4> SplineWeights(const std::array<double, 4>& times, bool has_before,
                                    bool has_after, double t);

}  // namespace fjord
