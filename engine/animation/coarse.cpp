#include "engine/animation/coarse.h"

#include <utility>

#include "engine/animation/frame_geometry.h"
#include "engine/fractal/registry.h"

namespace fjord {
namespace {

using Doubles = google::protobuf::RepeatedField<double>;

Vec3 VectorOr(const Doubles& values, const Vec3& otherwise) {
  return values.size() == 3 ? Vec3(values[0], values[1], values[2]) : otherwise;
}

}  // namespace

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
  Result<CoarseShape> shape = CoarseShapeOf(object, nullptr);
  if (!shape) return shape.error();
  const FractalSettings settings = FractalSettingsOf(object.fractal());
  const Errors defects = CheckSettings(*method, settings);
  if (!defects.empty()) return defects.front();
  return method->prepare(std::move(*shape), settings, view);
}

}  // namespace fjord
