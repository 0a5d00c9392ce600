#include "engine/scene/defaults.h"

#include <algorithm>

#include "engine/base/clamp.h"
#include "engine/fractal/registry.h"
#include "engine/scene/field_path.h"
#include "engine/scene/limits.h"
#include "engine/scene/parameters.h"
#include "engine/texture/registry.h"

namespace fjord {
namespace {

void Fill(v1::Vec3* v, double x, double y, double z) {
  if (!v->has_x()) v->set_x(x);
  if (!v->has_y()) v->set_y(y);
  if (!v->has_z()) v->set_z(z);
}

// A colour that is not given at all gets the default; one that is given, were it `color {}`, is 0
// where it leaves a number out.
template <typename Owner>
void Fill(Owner* owner, bool (Owner::*has)() const, v1::Color* (Owner::*get)(), double r, double g,
          double b) {
  const bool given = (owner->*has)();
  v1::Color* color = (owner->*get)();
  if (!color->has_r()) color->set_r(given ? 0 : r);
  if (!color->has_g()) color->set_g(given ? 0 : g);
  if (!color->has_b()) color->set_b(given ? 0 : b);
}

void FillOutput(v1::Scene* scene) {
  v1::Output* output = scene->mutable_output();
  if (!output->has_width()) output->set_width(960);
  if (!output->has_height()) output->set_height(540);
  if (!output->has_rate()) output->set_rate(24);
  if (!output->has_samples()) output->set_samples(4);
  if (!output->has_dither()) output->set_dither(true);
  if (output->has_frames()) return;
  double last = 1;
  for (const v1::Object& object : scene->objects()) {
    for (const v1::Key& key : object.key()) last = std::max<double>(last, key.frame());
  }
  for (const v1::Track& track : scene->track()) {
    for (const v1::TrackKey& key : track.key()) last = std::max(last, key.frame());
  }
  const int64_t whole = -FloorToInt64(-last);
  output->set_frames(static_cast<uint32_t>(std::clamp<int64_t>(whole, 1, limits::kFrames)));
}

void FillLight(v1::Light* light) {
  if (light->kind() == v1::Light::DIRECTIONAL) {
    Fill(light->mutable_direction(), 0, 0, 0);
  } else if (light->has_position()) {
    Fill(light->mutable_position(), 0, 0, 0);
  }
  Fill(light, &v1::Light::has_color, &v1::Light::mutable_color, 1, 1, 1);
  if (!light->has_intensity()) light->set_intensity(1);
}

bool IsFlat(const Box& box) {
  const Vec3 size = box.Size();
  return size.z <= 1e-9 * std::max({size.x, size.y, size.z});
}

bool IsOpen(const Geometry& geometry) {
  // the vector area of a closed mesh is zero
  Vec3 area(0);
  Box box;
  size_t corner = 0;
  for (const uint32_t size : geometry.face_size) {
    const Vec3& first = geometry.points[geometry.face_vertex[corner]];
    for (uint32_t i = 1; i + 1 < size; ++i) {
      area += glm::cross(geometry.points[geometry.face_vertex[corner + i]] - first,
                         geometry.points[geometry.face_vertex[corner + i + 1]] - first);
    }
    corner += size;
  }
  for (const Vec3& point : geometry.points) box.Add(point);
  const Vec3 size = box.Size();
  return Length(area) > 1e-6 * glm::dot(size, size);
}

bool IsGrid(const v1::Object& object) {
  const v1::Shape& shape = object.has_shape() ? object.shape() : object.key(0).shape();
  return shape.has_primitive() && shape.primitive().kind() == v1::Primitive::GRID;
}

void FillFractal(v1::Object* object, const Geometry* geometry, const Box& box) {
  v1::Fractal* fractal = object->mutable_fractal();
  if (fractal->method().empty()) {
    if (geometry == nullptr) return;
    const bool flat = IsFlat(box) && !IsGrid(*object);
    fractal->set_method(geometry->curve ? "curve" : flat ? "coast" : "surface");
  }
  const MethodInfo* method = FindFractalMethod(fractal->method());
  if (method == nullptr) return;
  CompleteEntry(*method, fractal);
  const FractalCommon defaults;
  if (!fractal->has_seed()) fractal->set_seed(defaults.seed);
  if (!fractal->has_max_level()) fractal->set_max_level(defaults.max_level);
  if (fractal->split() == 0) fractal->set_split(v1::Fractal::SHOT);
  if (!fractal->has_epsilon() && !fractal->has_pixels() && !fractal->has_viewing())
    fractal->set_pixels(1);
}

struct Stop {
  double share;
  double r, g, b;
};

// From the shore to the snow, linear light.
constexpr Stop kLand[] = {{0, .60, .52, .34},   {.03, .42, .40, .20}, {.08, .10, .20, .05},
                          {.35, .06, .14, .04}, {.60, .20, .17, .13}, {.80, .33, .30, .28},
                          {.90, .85, .88, .92}, {1, .95, .97, 1}};
constexpr Stop kSeabed = {0, .22, .20, .14};

void FillRamp(v1::Material* material, const Box& box, double shore) {
  const auto add = [&](double height, const Stop& stop) {
    v1::RampStop* entry = material->add_ramp();
    entry->set_height(height);
    Fill(entry, &v1::RampStop::has_color, &v1::RampStop::mutable_color, stop.r, stop.g, stop.b);
  };
  const double top = box.high.z;
  if (shore > box.low.z) add(shore - .05 * (top - shore), kSeabed);
  for (const Stop& stop : kLand) add(shore + stop.share * (top - shore), stop);
}

void FillMaterial(const v1::Scene& scene, v1::Object* object, const Geometry* geometry,
                  const Box& box) {
  v1::Material* material = object->mutable_material();
  if (!material->has_ambient()) material->set_ambient(1);
  if (!material->has_diffuse()) material->set_diffuse(1);
  if (!material->has_specular()) material->set_specular(0);
  if (!material->has_shininess()) material->set_shininess(20);
  if (!material->has_line_width()) material->set_line_width(2);
  const bool chosen =
      material->has_color() || material->ramp_size() > 0 || material->vertex_color();
  const bool curve = geometry != nullptr && geometry->curve;
  if (!chosen && geometry != nullptr && !geometry->colors.empty()) material->set_vertex_color(true);
  if (!chosen && geometry != nullptr && geometry->colors.empty() && !curve && !IsFlat(box) &&
      IsOpen(*geometry)) {
    const bool plain = !object->has_transform();
    const double sea = scene.has_sea() && plain ? scene.sea().level() : box.low.z;
    FillRamp(material, box, sea > box.low.z && sea < box.high.z ? sea : box.low.z);
  }
  if (curve && !material->fill()) {
    Fill(material, &v1::Material::has_color, &v1::Material::mutable_color, .02, .02, .03);
  } else if (IsFlat(box)) {
    Fill(material, &v1::Material::has_color, &v1::Material::mutable_color, .16, .26, .09);
  } else {
    Fill(material, &v1::Material::has_color, &v1::Material::mutable_color, .52, .47, .42);
  }
  for (v1::RampStop& stop : *material->mutable_ramp())
    Fill(&stop, &v1::RampStop::has_color, &v1::RampStop::mutable_color, 0, 0, 0);
  for (v1::Stage& stage : *material->mutable_stage()) {
    const StageInfo* info = FindTextureStage(stage.kind());
    if (info != nullptr) CompleteEntry(*info, &stage);
  }
}

std::string StemOf(const std::string& file_name) {
  const size_t slash = file_name.find_last_of('/');
  std::string stem = slash == std::string::npos ? file_name : file_name.substr(slash + 1);
  const size_t dot = stem.find_last_of('.');
  if (dot != std::string::npos && dot > 0) stem.resize(dot);
  return stem.empty() ? "scene" : stem;
}

void FillPrimitive(v1::Primitive* primitive) {
  const bool ball =
      primitive->kind() == v1::Primitive::SPHERE || primitive->kind() == v1::Primitive::ELLIPSOID;
  if (ball && !primitive->has_base()) {
    const bool by_latitude = primitive->has_segments() || primitive->has_rings();
    primitive->set_base(by_latitude ? v1::Primitive::LATITUDE : v1::Primitive::EVEN);
  }
  const bool flat_sided =
      primitive->kind() == v1::Primitive::BOX || primitive->kind() == v1::Primitive::GRID;
  const uint32_t along = primitive->kind() == v1::Primitive::BOX ? 1 : 8;
  if (!primitive->has_segments()) primitive->set_segments(flat_sided ? along : 24);
  if (!primitive->has_rings()) primitive->set_rings(flat_sided ? along : 12);
  if (flat_sided) Fill(primitive->mutable_size(), 1, 1, 1);
  if (primitive->kind() == v1::Primitive::ELLIPSOID) Fill(primitive->mutable_radii(), 1, 1, 1);
  if (primitive->kind() == v1::Primitive::SPHERE || primitive->kind() == v1::Primitive::TORUS) {
    if (!primitive->has_radius()) primitive->set_radius(1);
  }
  if (primitive->kind() == v1::Primitive::TORUS && !primitive->has_tube()) {
    primitive->set_tube(.35 * primitive->radius());
  }
}

}  // namespace

void FillSurroundings(v1::Scene* scene, const std::string& file_name) {
  Fill(scene->mutable_background(), &v1::Background::has_top, &v1::Background::mutable_top, .12,
       .28, .58);
  Fill(scene->mutable_background(), &v1::Background::has_bottom, &v1::Background::mutable_bottom,
       .62, .74, .86);
  Fill(scene, &v1::Scene::has_ambient, &v1::Scene::mutable_ambient, .22, .26, .33);
  if (scene->has_haze()) {
    const v1::Color& horizon = scene->background().bottom();
    Fill(scene->mutable_haze(), &v1::Haze::has_color, &v1::Haze::mutable_color, horizon.r(),
         horizon.g(), horizon.b());
  }
  if (scene->name().empty()) scene->set_name(StemOf(file_name));
  if (scene->lights_size() == 0) {
    v1::Light* sun = scene->add_lights();
    sun->set_name("sun");
    Fill(sun->mutable_direction(), -.55, -.40, .60);
    Fill(sun, &v1::Light::has_color, &v1::Light::mutable_color, 1, .92, .78);
    sun->set_intensity(1.1);
  }
  for (int i = 0; i < scene->objects_size(); ++i) {
    v1::Object* object = scene->mutable_objects(i);
    if (object->name().empty()) object->set_name("object-" + std::to_string(i + 1));
  }
  for (int i = 0; i < scene->lights_size(); ++i) {
    v1::Light* light = scene->mutable_lights(i);
    if (light->name().empty()) light->set_name("light-" + std::to_string(i + 1));
  }
}

void FillShapeNumbers(v1::Scene* scene) {
  for (int i = 0; i < scene->objects_size(); ++i) {
    for (const ShapeEntry& entry : ShapesOf(scene, i)) {
      if (entry.shape->has_primitive()) FillPrimitive(entry.shape->mutable_primitive());
      if (entry.shape->has_heights()) {
        v1::Heights* heights = entry.shape->mutable_heights();
        Fill(heights->mutable_size(), 1, 1, 1);
        if (!heights->has_pixels() && !heights->has_epsilon()) heights->set_pixels(1);
      }
    }
  }
}

namespace {

void FillTransform(v1::Transform* transform) {
  Fill(transform->mutable_translate(), 0, 0, 0);
  Fill(transform->mutable_rotate(), 0, 0, 0);
  Fill(transform->mutable_scale(), 1, 1, 1);
}

}  // namespace

void FillPlainDefaults(v1::Scene* scene, const SceneShapes& shapes) {
  FillOutput(scene);
  for (v1::Light& light : *scene->mutable_lights()) FillLight(&light);
  if (scene->has_sea()) {
    v1::Sea* sea = scene->mutable_sea();
    if (!sea->has_level()) sea->set_level(0);
    Fill(sea, &v1::Sea::has_color, &v1::Sea::mutable_color, .015, .07, .13);
    if (!sea->has_specular()) sea->set_specular(.35);
    if (!sea->has_shininess()) sea->set_shininess(60);
  }
  for (int i = 0; i < scene->objects_size(); ++i) {
    v1::Object* object = scene->mutable_objects(i);
    const auto index = static_cast<size_t>(i);
    const Geometry* geometry = shapes.FirstOf(index);
    const Box box = shapes.BoundsOf(index);
    if (object->has_transform()) FillTransform(object->mutable_transform());
    for (v1::Transform& placement : *object->mutable_placements()) FillTransform(&placement);
    if (object->key_size() > 0 && !object->has_rest_frame()) {
      object->set_rest_frame(object->key(object->key_size() - 1).frame());
    }
    for (v1::PointPath& path : *object->mutable_point_path()) {
      if (!path.has_key()) path.set_key(1);
    }
    if (object->has_fractal()) FillFractal(object, geometry, box);
    FillMaterial(*scene, object, geometry, box);
  }
}

}  // namespace fjord
