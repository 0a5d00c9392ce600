// The method "curve": lines roughened by halving (S10-S15). Every segment of a polyline is halved
// and its midpoint moved, until nothing is longer than the fineness asks.
//
// Direction rules, for an input edge e of a curve with plane normal N (+z where the curve is flat
// in z; otherwise its mean plane's):
//   EDGE    unit(e x N), the right-hand side, outward of a counter-clockwise outline (S10);
//           CURRENT: the same of the segment being halved (S11); PERTURBED: turned by u t (S12)
//   VERTEX  mean of the end points' normals, kept by the new vertex (S13), variants on top
//   UP      +z, variants on top
// With Increments::kAdditions every point is moved by every level (S6); docs/fractal.md.
//
// A root is an input edge, in order. Prepared objects are immutable and shared freely by threads.
#pragma once

#include <memory>

#include "engine/fractal/method.h"

namespace fjord {

// kInvalid where the shape is no curve or the settings are not the method's.
Result<std::unique_ptr<PreparedFractal>> PrepareCurve(CoarseShape shape,
                                                      const FractalSettings& settings);

}  // namespace fjord
