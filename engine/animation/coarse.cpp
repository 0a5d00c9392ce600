#include "engine/animation/coarse.h"

#include <utility>

#include "engine/animation/frame_geometry.h"
#include "engine/fractal/registry.h"
#include "engine/scene/parameters.h"

namespace fjord {
namespace {

using Doubles = google::protobuf::RepeatedField<double>;

Vec3 VectorOr(const Doubles& values, const Vec3& otherwise) {
  return values.size() == 3 ? Vec3(values[0], values[1], values[2]) : otherwise;
}

}  // namespace

Fineness FinenessOf(const v1::FrameFineness& from) {
  Fineness fineness;
  fineness.epsilon = from.epsilon();
  fineness.pixels = from.pixels();
  fineness.focal = from.focal();
  fineness.near = from.near();
  fineness.eye = VectorOr(from.eye(), Vec3(0));
  fineness.eye_radius = from.eye_radius();
  return fineness;
}

Result<MethodSettings> MethodSettingsOf(const v1::FrameFractal& fractal) {
  const MethodInfo* method = FindFractalMethod(fractal.method());
  if (method == nullptr)
    return Invalid("frame scene: there is no fractal method \"" + fractal.method() + "\"");
  MethodSettings settings;
  settings.method = fractal.method();
  settings.seed = fractal.seed();
  settings.split = static_cast<Split>(fractal.split());
  settings.max_level = fractal.max_level();
  settings.fineness = FinenessOf(fractal.fineness());
  std::vector<KnobDefect> defects;
  settings.own = method->knobs.Read(ValuesOf(fractal.parameter()), method->name, &defects);
  if (!defects.empty()) {
    return Invalid("frame scene: fractal." + defects.front().knob + ": " + defects.front().message);
  }
  return settings;
}

Result<std::unique_ptr<PreparedFractal>> PrepareFractal(const v1::FrameObject& object) {
  Result<MethodSettings> settings = MethodSettingsOf(object.fractal());
  if (!settings) return settings.error();
  Result<CoarseShape> shape = CoarseShapeOf(object, nullptr);
  if (!shape) return shape.error();
  return PrepareMethod(std::move(*shape), *settings);
}

}  // namespace fjord
