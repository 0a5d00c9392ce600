// The registry's entry of the method coast; its kernel is engine/fractal/coast.cpp.
#include "engine/fractal/coast.h"

#include <utility>

#include "engine/fractal/midpoint_knobs.h"

namespace fjord {
namespace {

constexpr KnobWord kDirections[] = {
    {"EDGE", 1, "outward normal, in the triangle's plane"},
    {"VERTEX", 3, "mean of the ends' normals, kept by the new vertex: no kink"}};

FractalSettings Defaults() {
  FractalSettings settings;
  settings.H = .75;
  settings.law = Law::kSimilar;
  settings.direction = Direction::kEdge;
  settings.variant = Variant::kPerturbed;
  return settings;
}

}  // namespace

MethodInfo CoastMethod() {
  return {{.name = "coast",
           .version = 3,
           .summary = "meshes whose border becomes a coastline, cut into triangles inside it",
           .knobs = MidpointKnobs({.defaults = Defaults(), .directions = kDirections})},
          Takes::kTriangles,
          [](CoarseShape shape, const FractalCommon& common, const std::any& own) {
            return PrepareCoast(std::move(shape), JoinMidpoint(common, own));
          },
          /*borders_only=*/true,
          JoinMidpoint};
}

}  // namespace fjord
