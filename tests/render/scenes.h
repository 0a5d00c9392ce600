// Small frame scenes for the render tests, made in code; pictures of floats, so that light can be
// compared with numbers.
#pragma once

#include <cstring>
#include <initializer_list>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/base/exact_math.h"
#include "engine/geometry/mesh.h"
#include "engine/render/frame_renderer.h"
#include "fjord/v1/frame.pb.h"
#include "gtest/gtest.h"

namespace fjord {

inline void Put(google::protobuf::RepeatedField<double>* field, std::initializer_list<double> v) {
  field->Clear();
  for (const double x : v) field->Add(x);
}

// Looks down -z onto the x-y plane, one unit to `pixels_per_unit` pixels, the origin in the middle;
// +x to the right, +y up.
inline v1::FrameScene FlatScene(uint32_t width, uint32_t height, double pixels_per_unit = 1) {
  v1::FrameScene scene;
  scene.mutable_output()->set_width(width);
  scene.mutable_output()->set_height(height);
  scene.mutable_output()->set_format(3);
  scene.mutable_output()->set_samples(1);
  v1::FrameCamera* camera = scene.mutable_camera();
  Put(camera->mutable_eye(), {0, 0, 100});
  Put(camera->mutable_look_at(), {0, 0, 0});
  Put(camera->mutable_up(), {0, 1, 0});
  camera->set_orthographic(true);
  camera->set_view_height(height / pixels_per_unit);
  camera->set_near(1);
  Put(scene.mutable_background(), {0, 0, 0, 0, 0, 0});
  Put(scene.mutable_ambient(), {1, 1, 1});
  return scene;
}

inline v1::FrameScene PerspectiveScene(uint32_t width, uint32_t height, const Vec3& eye,
                                       const Vec3& look_at, double fov = 45) {
  v1::FrameScene scene = FlatScene(width, height);
  v1::FrameCamera* camera = scene.mutable_camera();
  camera->Clear();
  Put(camera->mutable_eye(), {eye.x, eye.y, eye.z});
  Put(camera->mutable_look_at(), {look_at.x, look_at.y, look_at.z});
  Put(camera->mutable_up(), {0, 0, 1});
  camera->set_fov(fov);
  camera->set_near(.01);
  return scene;
}

inline v1::FrameMaterial* Plain(v1::FrameObject* object, const Rgb& color) {
  v1::FrameMaterial* material = object->mutable_material();
  Put(material->mutable_color(), {color.r, color.g, color.b});
  material->set_ambient(1);
  material->set_line_width(1);
  return material;
}

inline v1::FrameObject* AddObject(v1::FrameScene* scene, const std::vector<Vec3>& points,
                                  const std::vector<std::vector<uint32_t>>& faces,
                                  const Rgb& color) {
  v1::FrameObject* object = scene->add_object();
  for (const Vec3& p : points) {
    object->add_point(p.x);
    object->add_point(p.y);
    object->add_point(p.z);
  }
  for (const auto& face : faces) {
    object->add_face_size(static_cast<uint32_t>(face.size()));
    for (const uint32_t v : face) object->add_face_vertex(v);
  }
  Plain(object, color);
  return object;
}

inline v1::FrameObject* AddMesh(v1::FrameScene* scene, const Mesh& mesh, const Rgb& color) {
  v1::FrameObject* object = AddObject(scene, mesh.points, {}, color);
  for (const uint32_t size : mesh.face_size) object->add_face_size(size);
  for (const uint32_t v : mesh.face_vertex) object->add_face_vertex(v);
  return object;
}

inline void AddSun(v1::FrameScene* scene, const Vec3& towards, const Rgb& color) {
  v1::FrameLight* light = scene->add_light();
  Put(light->mutable_place(), {towards.x, towards.y, towards.z});
  Put(light->mutable_color(), {color.r, color.g, color.b});
}

// Choices of the object's method, in place of all values that it had.
inline void SetWords(v1::FrameFractal* fractal,
                     std::initializer_list<std::pair<const char*, const char*>> words) {
  fractal->clear_parameter();
  for (const auto& [name, word] : words) {
    v1::Parameter* parameter = fractal->add_parameter();
    parameter->set_name(name);
    parameter->add_text(word);
  }
}

inline v1::FrameFractal* MakeRough(v1::FrameObject* object, double epsilon, double amplitude = .2,
                                   double h = .7) {
  v1::FrameFractal* fractal = object->mutable_fractal();
  fractal->set_method("surface");
  fractal->set_seed(7);
  // as the tables give them: sorted, and what is at its default left out
  for (const auto& [name, value, otherwise] :
       {std::tuple("H", h, .7), std::tuple("amplitude", amplitude, .15)}) {
    if (value == otherwise) continue;
    v1::Parameter* parameter = fractal->add_parameter();
    parameter->set_name(name);
    parameter->add_number(value);
  }
  fractal->set_split(1);
  fractal->set_max_level(24);
  fractal->mutable_fineness()->set_epsilon(epsilon);
  return fractal;
}

// A curve with offsets square to its segments.
inline v1::FrameFractal* MakeRoughLine(v1::FrameObject* line, double epsilon) {
  v1::FrameFractal* fractal = MakeRough(line, epsilon);
  fractal->set_method("curve");
  SetWords(fractal, {{"direction", "EDGE"}, {"variant", "CURRENT"}});
  return fractal;
}

inline Picture Draw(const v1::FrameScene& scene, const RenderOptions& options = {.threads = 1}) {
  Result<RenderedFrame> rendered = RenderFrame(scene, options);
  EXPECT_TRUE(rendered.ok()) << (rendered.ok() ? "" : rendered.error().message);
  return rendered.ok() ? rendered->picture : Picture{};
}

inline Rgb At(const Picture& picture, uint32_t x, uint32_t y) {
  Rgb color;
  std::memcpy(&color, &picture.bytes[(size_t{y} * picture.width + x) * 12], 12);
  return color;
}

inline std::string DigestOf(const v1::FrameScene& scene,
                            const RenderOptions& options = {.threads = 1}) {
  return PixelDigest(Draw(scene, options)).Hex();
}

}  // namespace fjord
