// The registry's entry of the method surface; its kernel is engine/fractal/surface.cpp.
#include "engine/fractal/surface.h"

#include <utility>

#include "engine/fractal/midpoint_knobs.h"

namespace fjord {
namespace {

constexpr KnobWord kDirections[] = {
    {"EDGE", 1, "mean of the two faces' normals"},
    {"FACE", 2, "the face's own normal; opens gaps, kept to show them"},
    {"VERTEX", 3, "mean of the ends' normals, kept by the new vertex: no kink"},
    {"UP", 4, "+z"}};

constexpr KnobWord kIncrements[] = {
    {"MIDPOINT", 0, "plain halving, as in 1989: diagonals and the lines of the coarse shape show"},
    {"EVEN", 2, "neighbouring midpoints share half of their numbers, and diagonals alternate"}};

FractalSettings Defaults() {
  FractalSettings settings;
  settings.H = .7;
  settings.law = Law::kAffine;
  settings.direction = Direction::kVertex;
  settings.variant = Variant::kFixed;
  settings.increments = Increments::kEven;
  return settings;
}

}  // namespace

MethodInfo SurfaceMethod() {
  return {
      {.name = "surface",
       .version = 4,
       .summary = "triangle meshes roughened by midpoint displacement: terrain, planets, any solid",
       .knobs = MidpointKnobs({.defaults = Defaults(),
                               .directions = kDirections,
                               .similar_reads_sigma = true,
                               .has_border = true,
                               .increments = kIncrements})},
      Takes::kTriangles,
      [](CoarseShape shape, const FractalCommon& common, const std::any& own) {
        return PrepareSurface(std::move(shape), JoinMidpoint(common, own));
      },
      /*borders_only=*/false,
      JoinMidpoint};
}

}  // namespace fjord
