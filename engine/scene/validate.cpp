#include "engine/scene/validate.h"

#include <map>

#include "engine/base/printable.h"
#include "engine/scene/field_path.h"
#include "engine/scene/limits.h"
#include "engine/scene/ranges.h"

namespace fjord {
namespace {

bool IsNumber(const std::string& name) {
  return name.find_first_not_of("0123456789") == std::string::npos;
}

Vec3 ToVec3(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

// Names of a list's entries: well formed, each once.
class NameChecker {
 public:
  NameChecker(std::string what, SceneErrors* errors) : what_(std::move(what)), errors_(errors) {}

  void Check(const std::string& name, const Route& route) {
    if (!IsSceneName(name) || IsNumber(name)) {
      errors_->Add(route.Then("name"),
                   "\"" + name + "\" cannot be a name: letters, digits, - and _, at most " +
                       std::to_string(limits::kNameBytes) + ", not digits alone");
      return;
    }
    const auto [entry, fresh] = names_.emplace(name, route.steps.back().index + 1);
    if (!fresh) {
      errors_->Add(route.Then("name"),
                   what_ + " " + std::to_string(entry->second) + " is named \"" + name + "\" too");
    }
  }

 private:
  std::string what_;
  SceneErrors* errors_;
  std::map<std::string, int> names_;
};

void CheckOutput(const v1::Output& output, SceneErrors* errors) {
  const Route route = Route().Then("output");
  if (output.samples() != 1 && output.samples() != 4 && output.samples() != 16) {
    errors->Add(route.Then("samples"), std::to_string(output.samples()) + " is not 1, 4 or 16");
  }
  const bool exr =
      output.format() == v1::Output::EXR_HALF || output.format() == v1::Output::EXR_FLOAT;
  for (int i = 0; i < output.layers_size() && !exr; ++i) {
    if (output.layers(i) == v1::Output::COLOR) continue;
    errors->Add(route.Then("layers", i), "only EXR pictures have layers; set format: EXR_HALF");
  }
}

void CheckCamera(const v1::Camera& camera, SceneErrors* errors) {
  const Route route = Route().Then("camera");
  if (camera.has_up() && Length(ToVec3(camera.up())) == 0) {
    errors->Add(route.Then("up"), "up has no direction");
  }
  if (!camera.has_eye() || !camera.has_look_at()) return;
  if (errors->Refused(route.Then("eye")) || errors->Refused(route.Then("look_at"))) return;
  const Vec3 view = ToVec3(camera.look_at()) - ToVec3(camera.eye());
  if (!(Length(ToVec3(camera.eye())) <= limits::kFarthest)) {
    errors->Add(route.Then("eye"),
                "to have everything in view the eye would stand beyond 1e15; mend the transforms, "
                "or give eye and look_at");
  } else if (Length(view) == 0) {
    errors->Add(route.Then("eye"), "eye and look_at are at one place; move one of them");
  } else if (camera.has_up() && Length(ToVec3(camera.up())) > 0 &&
             Length(glm::cross(Unit(view), Unit(ToVec3(camera.up())))) < 1e-9) {
    errors->Add(route.Then("up"), "up runs along the view; turn it");
  }
}

void CheckLights(const v1::Scene& scene, SceneErrors* errors) {
  NameChecker names("light", errors);
  for (int i = 0; i < scene.lights_size(); ++i) {
    const v1::Light& light = scene.lights(i);
    const Route route = Route().Then("lights", i);
    names.Check(light.name(), route);
    if (light.kind() == v1::Light::LOCAL && !light.has_position()) {
      errors->Add(route, "a LOCAL light needs a position");
    }
    if (light.kind() == v1::Light::LOCAL && light.shadow()) {
      errors->Add(route.Then("shadow"), "only DIRECTIONAL lights are kept off; leave shadow out");
    }
    if (light.kind() == v1::Light::DIRECTIONAL && Length(ToVec3(light.direction())) == 0) {
      errors->Add(route, "a DIRECTIONAL light needs a direction, from the scene towards the light");
    }
  }
}

}  // namespace

void CheckObject(const v1::Scene& scene, int index, const SceneShapes& shapes,
                 SceneErrors* errors) {
  const v1::Object& object = scene.objects(index);
  const Route route = Route().Then("objects", index);
  if (object.has_shape() && object.key_size() > 0) {
    errors->Add(route.Then("shape"), "give shape or keys, not both");
  } else if (!object.has_shape() && object.key_size() == 0) {
    errors->Add(route, "the object has no shape; add shape { ... } or key { ... }");
  }
  CheckKeys(scene, index, shapes, errors);
  CheckFractal(scene, index, shapes, errors);
  for (int i = 0; i < object.material().stage_size(); ++i)
    CheckEntry(object.material().stage(i), route.Then("material").Then("stage", i), errors);

  const v1::Material& material = object.material();
  const Route place = route.Then("material");
  for (int i = 1; i < material.ramp_size(); ++i) {
    if (material.ramp(i).height() > material.ramp(i - 1).height()) continue;
    if (errors->Refused(place.Then("ramp", i - 1).Then("height"))) continue;
    errors->Add(place.Then("ramp", i).Then("height"),
                NumberText(material.ramp(i).height()) + " comes after " +
                    NumberText(material.ramp(i - 1).height()) + "; heights ascend");
  }
  const Geometry* geometry = shapes.FirstOf(static_cast<size_t>(index));
  if (geometry == nullptr) return;
  if (material.vertex_color() && geometry->colors.empty()) {
    errors->Add(place.Then("vertex_color"), "the shape has no colours of its own");
  }
  if (material.fill() && !(geometry->curve && geometry->closed)) {
    errors->Add(place.Then("fill"), "only closed curves can be filled");
  }
}

void CheckScene(v1::Scene* scene, const SceneShapes& shapes, SceneErrors* errors) {
  if (!IsPictureStem(scene->name())) {
    std::string what = "\"";
    what += Printable(scene->name());
    what +=
        "\" cannot be a scene's name, with which its pictures' begin: characters of any script, "
        "no /, no control characters, not beginning with a dot, at most " +
        std::to_string(limits::kNameBytes) + " bytes";
    errors->Add(Route().Then("name"), what);
  }
  if (scene->objects_size() == 0) {
    errors->Add({}, "the scene has no objects; add objects { shape { ... } }");
  }
  CheckOutput(scene->output(), errors);
  CheckCamera(scene->camera(), errors);
  CheckLights(*scene, errors);
  NameChecker names("object", errors);
  for (int i = 0; i < scene->objects_size() && !errors->Full(); ++i) {
    names.Check(scene->objects(i).name(), Route().Then("objects", i));
    CheckObject(*scene, i, shapes, errors);
  }
  CheckTracks(scene, errors);
}

}  // namespace fjord
