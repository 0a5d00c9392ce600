#include "engine/animation/assemble.h"

#include "engine/animation/frame_key.h"
#include "engine/scene/parameters.h"
#include "engine/scene/transform.h"
#include "engine/texture/registry.h"
#include "engine/texture/uv_map.h"

namespace fjord {
namespace {

using Doubles = google::protobuf::RepeatedField<double>;

void Append(const v1::Vec3& v, Doubles* values) {
  for (const double x : {v.x(), v.y(), v.z()}) values->Add(x);
}

void Append(const v1::Color& color, double factor, Doubles* values) {
  for (const double x : {color.r(), color.g(), color.b()}) values->Add(factor * x);
}

// The values that differ from the entry's defaults and have an effect, sorted by name.
Result<> AssembleEntry(const google::protobuf::Message& now, google::protobuf::Message* out) {
  const EntryKind& kind = *KindOf(now.GetDescriptor());
  const EntryInfo* info = kind.Find(EntryName(kind, now));
  FJORD_CHECK(info != nullptr, EntryName(kind, now));
  std::vector<KnobDefect> defects;
  const std::any settings = info->knobs.Read(ValuesOf(ParametersOf(now)), info->name, &defects);
  // single values were checked with the scene; several tracks together may break a rule
  if (!defects.empty()) {
    return Invalid("tracks take " + defects.front().knob + " of " + std::string(info->name) +
                   " out of bounds: " + defects.front().message);
  }
  SetParameters(info->knobs.Changed(settings), MutableParametersOf(out));
  return {};
}

Result<> AssembleMaterial(const v1::Material& now, uint32_t picture_height,
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
  for (const v1::Stage& stage : now.stage()) {
    v1::FrameStage* out = material->add_stage();
    out->set_kind(stage.kind());
    if (Result<> done = AssembleEntry(stage, out); !done) return done;
  }
  return {};
}

Vec3 ToVec3(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

// Defaults are filled in.
UvMap UvOf(const v1::Primitive& primitive) {
  switch (primitive.kind()) {
    case v1::Primitive::SPHERE:
      return {UvKind::kSphere, Vec3(primitive.radius())};
    case v1::Primitive::ELLIPSOID:
      return {UvKind::kSphere, ToVec3(primitive.radii())};
    case v1::Primitive::TORUS:
      return {UvKind::kTorus, Vec3(primitive.radius(), primitive.tube(), 0)};
    case v1::Primitive::BOX:
      return {UvKind::kBox, ToVec3(primitive.size())};
    case v1::Primitive::GRID:
      return {UvKind::kPlane, ToVec3(primitive.size())};
    default:
      return {};
  }
}

}  // namespace

void AssembleSurroundings(const v1::Scene& now, v1::FrameScene* frame) {
  v1::FrameOutput* output = frame->mutable_output();
  output->set_width(now.output().width());
  output->set_height(now.output().height());
  output->set_format(static_cast<uint32_t>(now.output().format()));
  output->set_samples(now.output().samples());
  const auto& layers = now.output().layers();
  if (std::find(layers.begin(), layers.end(), v1::Output::DEPTH) != layers.end()) {
    output->add_layer(v1::Output::DEPTH);
  }
  if (now.output().dither() && now.output().format() == v1::Output::PNG8) {
    output->set_dither(kDitherVersion);
  }
  output->set_alpha(now.output().alpha());

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
  frame->set_sky(static_cast<uint32_t>(now.background().kind()));
  Append(now.ambient(), 1, frame->mutable_ambient());
  if (now.has_haze() && now.haze().density() > 0) {
    Append(now.haze().color(), 1, frame->mutable_haze()->mutable_color());
    frame->mutable_haze()->set_density(now.haze().density());
  }
  for (const v1::Light& light : now.lights()) {
    v1::FrameLight* out = frame->add_light();
    const bool local = light.kind() == v1::Light::LOCAL;
    out->set_local(local);
    Append(local ? light.position() : light.direction(), out->mutable_place());
    if (local) out->set_range(light.range());
    Append(light.color(), light.intensity(), out->mutable_color());
    if (light.shadow()) out->set_shadow(light.shadow_detail());
  }
  if (now.has_sea()) {
    v1::FrameSea* sea = frame->mutable_sea();
    sea->set_level(now.sea().level());
    Append(now.sea().color(), 1, sea->mutable_color());
    sea->set_specular(now.sea().specular());
    sea->set_shininess(now.sea().shininess());
  }
}

Result<> AssembleObject(const v1::Object& now, bool curve, uint32_t picture_height,
                        v1::FrameObject* object) {
  const ObjectTransform transform(now.transform());
  if (!transform.IsIdentity()) {
    for (const double entry : transform.Rows()) object->add_transform(entry);
  }
  v1::FrameMaterial* material = object->mutable_material();
  if (Result<> done = AssembleMaterial(now.material(), picture_height, material); !done)
    return done;
  // the border of what is filled needs no help to be seen
  if (curve && !material->fill() && material->line_width() < 1) {
    material->set_fading(kFadingVersion);
  }
  return {};
}

void AssembleReads(const v1::Object& whole, uint32_t number, v1::FrameObject* object,
                   v1::FrameScene* frame) {
  StageReads reads;
  for (const v1::FrameStage& stage : object->material().stage()) {
    const StageInfo* info = FindTextureStage(stage.kind());
    if (info == nullptr || info->reads == nullptr) continue;
    std::vector<KnobDefect> defects;
    const StageReads own =
        info->reads(info->knobs.Read(ValuesOf(stage.parameter()), info->name, &defects));
    reads.uv |= own.uv;
    reads.time |= own.time;
  }
  if (reads.time) frame->set_instant(number);
  const v1::Shape* shape = &whole.shape();
  for (const v1::Key& key : whole.key()) {
    if (key.frame() == whole.rest_frame()) shape = &key.shape();
  }
  if (!reads.uv || !shape->has_primitive()) return;
  const UvMap map = UvOf(shape->primitive());
  object->set_uv(static_cast<uint32_t>(map.kind));
  for (int i = 0; i < 3; ++i) object->add_uv_size(map.size[i]);
}

Result<> AssembleFractal(const v1::Fractal& now, v1::FrameFractal* fractal) {
  fractal->set_method(now.method());
  fractal->set_seed(now.seed());
  fractal->set_split(static_cast<uint32_t>(now.split()));
  fractal->set_max_level(now.max_level());
  return AssembleEntry(now, fractal);
}

}  // namespace fjord
