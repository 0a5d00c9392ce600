#include "engine/animation/coarse.h"

#include <string>
#include <utility>

#include "engine/fractal/registry.h"
#include "engine/geometry/triangulate.h"

namespace fjord {
namespace {

using Doubles = google::protobuf::RepeatedField<double>;

std::vector<Vec3> Vectors(const Doubles& values) {
  std::vector<Vec3> vectors(static_cast<size_t>(values.size()) / 3);
  for (size_t i = 0; i < vectors.size(); ++i) {
    const int at = static_cast<int>(3 * i);
    vectors[i] = {values[at], values[at + 1], values[at + 2]};
  }
  return vectors;
}

Vec3 VectorOr(const Doubles& values, const Vec3& otherwise) {
  return values.size() == 3 ? Vec3(values[0], values[1], values[2]) : otherwise;
}

}  // namespace

Result<CoarseShape> CoarseShapeOf(const v1::FrameObject& object) {
  const auto count = static_cast<size_t>(object.point_size()) / 3;
  if (object.point_size() % 3 != 0 ||
      (object.rest_size() != 0 && object.rest_size() != object.point_size()) ||
      (object.color_size() != 0 && object.color_size() != object.point_size())) {
    return Invalid("frame scene: an object's points, rest pose and colours differ in number");
  }
  CoarseShape shape;
  shape.now = Vectors(object.point());
  shape.rest = object.rest_size() > 0 ? Vectors(object.rest()) : shape.now;
  shape.curve = object.curve();
  shape.closed = object.closed();
  for (const Vec3& color : Vectors(object.color())) shape.colors.emplace_back(color);
  if (shape.curve) return shape;

  uint64_t corners = 0;
  for (const uint32_t size : object.face_size()) corners += size;
  if (corners != static_cast<uint64_t>(object.face_vertex_size())) {
    return Invalid("frame scene: an object's face sizes do not add up to its face vertices");
  }
  for (const uint32_t vertex : object.face_vertex()) {
    if (vertex >= count) {
      return Invalid("frame scene: a face names vertex " + std::to_string(vertex + 1) + " of " +
                     std::to_string(count));
    }
  }
  shape.triangles = Triangulate(
      shape.rest, {object.face_size().data(), static_cast<size_t>(object.face_size_size())},
      {object.face_vertex().data(), static_cast<size_t>(object.face_vertex_size())});
  return shape;
}

FractalSettings FractalSettingsOf(const v1::FrameFractal& fractal) {
  FractalSettings settings;
  settings.method = fractal.method();
  settings.seed = fractal.seed();
  settings.H = fractal.h();
  settings.sigma = fractal.sigma();
  settings.amplitude = fractal.amplitude();
  settings.law = static_cast<Law>(fractal.law());
  settings.direction = static_cast<Direction>(fractal.direction());
  settings.variant = static_cast<Variant>(fractal.variant());
  settings.split = static_cast<Split>(fractal.split());
  settings.max_level = fractal.max_level();
  settings.uniforms = fractal.uniforms();
  settings.move = fractal.move();
  settings.perturb = fractal.perturb();
  settings.stretch = fractal.stretch();
  settings.increments = static_cast<Increments>(fractal.increments());
  settings.coast = fractal.coast();
  settings.coast_H = fractal.coast_h();
  const v1::FrameFineness& fineness = fractal.fineness();
  settings.fineness.epsilon = fineness.epsilon();
  settings.fineness.pixels = fineness.pixels();
  settings.fineness.focal = fineness.focal();
  settings.fineness.near = fineness.near();
  settings.fineness.eye = VectorOr(fineness.eye(), Vec3(0));
  settings.fineness.eye_radius = fineness.eye_radius();
  return settings;
}

Result<std::unique_ptr<PreparedFractal>> PrepareFractal(const v1::FrameObject& object,
                                                        const AdaptiveView* view) {
  const MethodInfo* method = FindFractalMethod(object.fractal().method());
  if (method == nullptr) {
    return Invalid("frame scene: there is no fractal method \"" + object.fractal().method() + "\"");
  }
  Result<CoarseShape> shape = CoarseShapeOf(object);
  if (!shape) return shape.error();
  const FractalSettings settings = FractalSettingsOf(object.fractal());
  const Errors defects = CheckSettings(*method, settings);
  if (!defects.empty()) return defects.front();
  return method->prepare(std::move(*shape), settings, view);
}

}  // namespace fjord
