#include "engine/animation/assemble.h"

#include "engine/animation/frame_key.h"
#include "engine/fractal/registry.h"
#include "engine/scene/transform.h"

namespace fjord {
namespace {

using Doubles = google::protobuf::RepeatedField<double>;

void Append(const v1::Vec3& v, Doubles* values) {
  for (const double x : {v.x(), v.y(), v.z()}) values->Add(x);
}

void Append(const v1::Color& color, double factor, Doubles* values) {
  for (const double x : {color.r(), color.g(), color.b()}) values->Add(factor * x);
}

void AssembleMaterial(const v1::Material& now, uint32_t picture_height,
                      v1::FrameMaterial* material) {
  Append(now.color(), 1, material->mutable_color());
  material->set_ambient(now.ambient());
  material->set_diffuse(now.diffuse());
  material->set_specular(now.specular());
  material->set_shininess(now.shininess());
  material->set_smooth(now.shading() == v1::Material::SMOOTH);
  for (const v1::RampStop& stop : now.ramp()) {
    material->add_ramp(stop.height());
    Append(stop.color(), 1, material->mutable_ramp());
  }
  material->set_vertex_color(now.vertex_color());
  material->set_line_width(now.line_width() * picture_height / 1080);
  material->set_fill(now.fill());
}

}  // namespace

void AssembleSurroundings(const v1::Scene& now, v1::FrameScene* frame) {
  v1::FrameOutput* output = frame->mutable_output();
  output->set_width(now.output().width());
  output->set_height(now.output().height());
  output->set_format(static_cast<uint32_t>(now.output().format()));
  output->set_samples(now.output().samples());
  if (now.output().dither() && now.output().format() == v1::Output::PNG8) {
    output->set_dither(kDitherVersion);
  }

  v1::FrameCamera* camera = frame->mutable_camera();
  Append(now.camera().eye(), camera->mutable_eye());
  Append(now.camera().look_at(), camera->mutable_look_at());
  Append(now.camera().up(), camera->mutable_up());
  camera->set_near(now.camera().near());
  // the size of the window that is not in use has no part in the picture
  if (now.camera().projection() == v1::Camera::ORTHOGRAPHIC) {
    camera->set_orthographic(true);
    camera->set_view_height(now.camera().view_height());
  } else {
    camera->set_fov(now.camera().fov());
  }

  Append(now.background().top(), 1, frame->mutable_background());
  Append(now.background().bottom(), 1, frame->mutable_background());
  Append(now.ambient(), 1, frame->mutable_ambient());
  for (const v1::Light& light : now.lights()) {
    v1::FrameLight* out = frame->add_light();
    const bool local = light.kind() == v1::Light::LOCAL;
    out->set_local(local);
    Append(local ? light.position() : light.direction(), out->mutable_place());
    if (local) out->set_range(light.range());
    Append(light.color(), light.intensity(), out->mutable_color());
  }
  if (now.has_sea()) {
    v1::FrameSea* sea = frame->mutable_sea();
    sea->set_level(now.sea().level());
    Append(now.sea().color(), 1, sea->mutable_color());
    sea->set_specular(now.sea().specular());
    sea->set_shininess(now.sea().shininess());
  }
}

void AssembleObject(const v1::Object& now, uint32_t picture_height, v1::FrameObject* object) {
  const ObjectTransform transform(now.transform());
  if (!transform.IsIdentity()) {
    for (const double entry : transform.Rows()) object->add_transform(entry);
  }
  AssembleMaterial(now.material(), picture_height, object->mutable_material());
}

void AssembleFractal(const v1::Fractal& now, v1::FrameFractal* fractal) {
  const MethodInfo* method = FindFractalMethod(now.method());
  FJORD_CHECK(method != nullptr, now.method());
  // knobs that the method has not are absent in the scene; its defaults stand for them
  const FractalSettings& defaults = method->defaults;
  fractal->set_method(now.method());
  fractal->set_seed(now.seed());
  fractal->set_h(now.has_h() ? now.h() : defaults.H);
  fractal->set_sigma(now.has_sigma() ? now.sigma() : defaults.sigma);
  fractal->set_amplitude(now.has_amplitude() ? now.amplitude() : defaults.amplitude);
  fractal->set_law(static_cast<uint32_t>(now.law()));
  fractal->set_direction(static_cast<uint32_t>(now.direction()));
  fractal->set_variant(static_cast<uint32_t>(now.variant()));
  fractal->set_split(static_cast<uint32_t>(now.split()));
  fractal->set_max_level(now.max_level());
  fractal->set_uniforms(now.uniforms());
  fractal->set_move(now.has_move() ? now.move() : defaults.move);
  fractal->set_perturb(now.has_perturb() ? now.perturb() : defaults.perturb);
  fractal->set_stretch(now.stretch());
  fractal->set_increments(static_cast<uint32_t>(now.increments()));
  fractal->set_coast(now.coast());
  fractal->set_coast_h(now.has_coast_h() ? now.coast_h() : defaults.coast_H);
}

}  // namespace fjord
