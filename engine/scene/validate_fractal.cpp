// CheckFractal of validate.h: what the method registry says about an object's settings.
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <map>

#include "engine/fractal/registry.h"
#include "engine/scene/limits.h"
#include "engine/scene/nearest.h"
#include "engine/scene/validate.h"

namespace fjord {
namespace {

bool Knows(const MethodInfo& method, std::string_view knob) {
  return std::find(method.knobs.begin(), method.knobs.end(), knob) != method.knobs.end();
}

FractalSettings SettingsOf(const MethodInfo& method, const v1::Fractal& fractal) {
  FractalSettings settings = method.defaults;
  const auto* reflection = fractal.GetReflection();
  for (const Knob& knob : AllKnobs()) {
    const auto* field = v1::Fractal::descriptor()->FindFieldByName(std::string(knob.name));
    if (reflection->HasField(fractal, field)) {
      settings.*knob.value = reflection->GetDouble(fractal, field);
    }
  }
  settings.law = static_cast<Law>(fractal.law());
  settings.direction = static_cast<Direction>(fractal.direction());
  settings.variant = static_cast<Variant>(fractal.variant());
  settings.split = static_cast<Split>(fractal.split());
  if (fractal.has_max_level()) settings.max_level = fractal.max_level();
  if (fractal.has_uniforms()) settings.uniforms = fractal.uniforms();
  settings.increments = static_cast<Increments>(fractal.increments());
  return settings;
}

// Knobs that this method would not look at are refused: a user who turns one expects to see it.
void CheckKnown(const MethodInfo& method, const v1::Fractal& fractal, const Route& route,
                SceneErrors* errors) {
  std::vector<std::string> knobs;
  for (const std::string_view knob : method.knobs) knobs.emplace_back(knob);
  for (const Knob& knob : AllKnobs()) {
    const auto* field = v1::Fractal::descriptor()->FindFieldByName(std::string(knob.name));
    if (!fractal.GetReflection()->HasField(fractal, field) || Knows(method, knob.name)) continue;
    std::string list;
    for (const std::string& name : knobs) list += (list.empty() ? "" : ", ") + name;
    errors->Add(route.Then(knob.name),
                "method " + std::string(method.name) + " has no such knob; it has " + list);
  }
  if (fractal.coast() && !Knows(method, "coast_H")) {
    errors->Add(route.Then("coast"),
                "only method surface has it; method " + std::string(method.name) + " does not");
  }
}

void CheckFineness(const v1::Fractal& fractal, const Route& route, SceneErrors* errors) {
  const int given = (fractal.has_epsilon() ? 1 : 0) + (fractal.has_pixels() ? 1 : 0) +
                    (fractal.has_viewing() ? 1 : 0);
  if (given > 1) errors->Add(route, "give one of epsilon, pixels and viewing, not several");
}

void AddDefect(const SettingDefect& defect, const Route& route, SceneErrors* errors) {
  // the path in front says which field it is
  std::string text = defect.message;
  for (const std::string& start :
       {std::string(defect.field) + " is ", std::string(defect.field) + " "}) {
    if (text.compare(0, start.size(), start) == 0) text.erase(0, start.size());
  }
  errors->Add(route.Then(defect.field), text);
}

// Where the shape could not be read, the method that goes with it is not known: what no method
// takes is wrong all the same.
void CheckForAnyMethod(const v1::Fractal& fractal, const Route& route, SceneErrors* errors) {
  std::map<std::string_view, std::vector<SettingDefect>> by_field;
  for (const MethodInfo& method : FractalMethods()) {
    for (SettingDefect& defect : FindSettingDefects(method, SettingsOf(method, fractal)))
      by_field[defect.field].push_back(std::move(defect));
  }
  for (const auto& [field, defects] : by_field) {
    if (defects.size() == FractalMethods().size()) AddDefect(defects[0], route, errors);
  }
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
  if (fractal.method().empty()) {
    CheckForAnyMethod(fractal, route, errors);
    return;
  }
  const MethodInfo* method = FindFractalMethod(fractal.method());
  if (method == nullptr) {
    std::vector<std::string> names;
    for (const MethodInfo& known : FractalMethods()) names.emplace_back(known.name);
    errors->Add(route.Then("method"), "there is no method \"" + fractal.method() + "\"" +
                                          SuggestNames(fractal.method(), names));
    return;
  }
  const Geometry* geometry = shapes.FirstOf(static_cast<size_t>(object));
  const bool wants_curve = method->takes == Takes::kCurve;
  if (geometry != nullptr && geometry->curve != wants_curve) {
    errors->Add(route.Then("method"),
                "method " + fractal.method() + " works on " + (wants_curve ? "curves" : "meshes") +
                    ", and the shape is a " + (geometry->curve ? "curve" : "mesh"));
  }
  CheckKnown(*method, fractal, route, errors);
  for (const SettingDefect& defect : FindSettingDefects(*method, SettingsOf(*method, fractal)))
    AddDefect(defect, route, errors);
}

}  // namespace fjord
