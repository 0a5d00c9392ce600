// CheckFractal of validate.h.
#include "engine/fractal/registry.h"
#include "engine/scene/validate.h"

namespace fjord {
namespace {

void CheckFineness(const v1::Fractal& fractal, const Route& route, SceneErrors* errors) {
  const int given = (fractal.has_epsilon() ? 1 : 0) + (fractal.has_pixels() ? 1 : 0) +
                    (fractal.has_viewing() ? 1 : 0);
  if (given > 1) errors->Add(route, "give one of epsilon, pixels and viewing, not several");
}

}  // namespace

void CheckFractal(const v1::Scene& scene, int object, const SceneShapes& shapes,
                  SceneErrors* errors) {
  const v1::Object& message = scene.objects(object);
  if (!message.has_fractal()) return;
  const v1::Fractal& fractal = message.fractal();
  const Route route = Route().Then("objects", object).Then("fractal");
  CheckFineness(fractal, route, errors);
  if (fractal.split() == v1::Fractal::ADAPTIVE && message.placements_size() > 0) {
    errors->Add(route.Then("split"),
                "ADAPTIVE looks at one place, and the object has placements; take SHOT");
  }
  // Where the shape could not be read, it is not known which method goes with it.
  if (fractal.method().empty()) return CheckForAnyEntry(fractal, route, errors);
  CheckEntry(fractal, route, errors);
  const MethodInfo* method = FindFractalMethod(fractal.method());
  const Geometry* geometry = shapes.FirstOf(static_cast<size_t>(object));
  if (method == nullptr || geometry == nullptr) return;
  const bool wants_curve = method->takes == Takes::kCurve;
  if (geometry->curve != wants_curve) {
    errors->Add(route.Then("method"),
                "method " + fractal.method() + " works on " + (wants_curve ? "curves" : "meshes") +
                    ", and the shape is a " + (geometry->curve ? "curve" : "mesh"));
  }
}

}  // namespace fjord
