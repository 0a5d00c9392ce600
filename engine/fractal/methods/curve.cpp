// The registry's entry of the method curve; its kernel is engine/fractal/curve.cpp.
#include "engine/fractal/curve.h"

#include <utility>

#include "engine/fractal/midpoint_knobs.h"

namespace fjord {
namespace {

constexpr KnobWord kDirections[] = {
    {"EDGE", 1, "right-hand normal of the input edge, in the curve's plane"},
    {"VERTEX", 3, "mean of the ends' normals, kept by the new vertex: no kink"},
    {"UP", 4, "+z"}};

constexpr KnobWord kIncrements[] = {
    {"MIDPOINT", 0, "plain halving"},
    {"ADDITIONS", 1, "successive random additions; with AFFINE, EDGE and FIXED only"}};

FractalSettings Defaults() {
  FractalSettings settings;
  settings.H = .75;
  settings.law = Law::kSimilar;
  settings.direction = Direction::kVertex;
  settings.variant = Variant::kPerturbed;
  return settings;
}

}  // namespace

MethodInfo CurveMethod() {
  return {
      {.name = "curve",
       .version = 3,
       .summary = "lines roughened by midpoint displacement: coastlines, ridges, charts, cracks",
       .knobs = MidpointKnobs(
           {.defaults = Defaults(), .directions = kDirections, .increments = kIncrements})},
      Takes::kCurve,
      [](CoarseShape shape, const FractalCommon& common, const std::any& own) {
        return PrepareCurve(std::move(shape), JoinMidpoint(common, own));
      },
      /*borders_only=*/false,
      JoinMidpoint};
}

}  // namespace fjord
