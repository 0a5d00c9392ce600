// Small random scenes of every kind of element, for properties of whole pictures. EXR_FLOAT.
#pragma once

#include <gtest/gtest.h>
// after gtest.h
#include <rapidcheck/gtest.h>

#include <initializer_list>
#include <vector>

#include "engine/geometry/primitives.h"
#include "tests/render/scenes.h"

namespace fjord {

inline double Between(double least, double most) {
  return least + (most - least) * (*rc::gen::inRange(0, 4097)) / 4096;
}

// One of a few: small numbers shrink towards the first.
template <typename T>
T OneOf(std::initializer_list<T> choices) {
  return *rc::gen::elementOf(std::vector<T>(choices));
}

inline Vec3 Somewhere(double size) {
  const double x = Between(-size, size), y = Between(-size, size);
  return {x, y, Between(-.5 * size, .5 * size)};
}

inline Rgb SomeColor() { return Rgb(Vec3(Between(.1, 1), Between(.1, 1), Between(.1, 1))); }

inline void AddRandomCurve(v1::FrameScene* scene) {
  const int count = *rc::gen::inRange(2, 7);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.push_back(Somewhere(2));
  v1::FrameObject* line = AddObject(scene, points, {}, SomeColor());
  line->set_curve(true);
  line->mutable_material()->set_line_width(OneOf({1., 0., .3, .8, 2.5, 9., 40., 90.}));
  line->mutable_material()->set_fading(*rc::gen::arbitrary<bool>() ? 1 : 0);
  if (count > 2 && *rc::gen::arbitrary<bool>()) {
    line->set_closed(true);
    line->mutable_material()->set_fill(true);
  }
  if (*rc::gen::arbitrary<bool>()) {
    MakeRoughLine(line, OneOf({.2, .05, .02}));
  }
}

inline void AddRandomMesh(v1::FrameScene* scene) {
  v1::FrameObject* object = nullptr;
  const int kind = *rc::gen::inRange(0, 3);
  if (kind == 0) {  // loose triangles, small to huge
    const double size = OneOf({1., .1, 5., 400.});
    std::vector<Vec3> points;
    std::vector<std::vector<uint32_t>> faces;
    const auto count = static_cast<uint32_t>(*rc::gen::inRange(1, 5));
    for (uint32_t i = 0; i < count; ++i) {
      const Vec3 middle = Somewhere(1);
      for (int k = 0; k < 3; ++k) points.push_back(middle + Somewhere(size));
      faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    object = AddObject(scene, points, faces, SomeColor());
  } else if (kind == 1) {
    const Result<Mesh> ball = MakeEllipsoid(Vec3(Between(.2, .8)), 20, 10);
    object = AddMesh(scene, *ball, SomeColor());
    object->mutable_material()->set_smooth(true);
  } else {
    const Result<Mesh> grid = MakeGrid(Vec3(Between(.5, 4), Between(.5, 4), 0), 2, 2);
    object = AddMesh(scene, *grid, SomeColor());
    MakeRough(object, OneOf({.1, .03}), Between(0, .4));
  }
  object->mutable_material()->set_diffuse(.8);
}

inline v1::FrameScene RandomScene() {
  const auto width = static_cast<uint32_t>(*rc::gen::inRange(1, 200));
  const auto height = static_cast<uint32_t>(*rc::gen::inRange(1, 90));
  v1::FrameScene scene =
      PerspectiveScene(width, height, Somewhere(3), Somewhere(1), Between(15, 100));
  v1::FrameCamera* camera = scene.mutable_camera();
  camera->set_near(OneOf({.01, .3, 1.}));
  if (*rc::gen::arbitrary<bool>()) {
    camera->set_orthographic(true);
    camera->set_view_height(Between(.5, 5));
  }
  const Vec3 up = Somewhere(1);
  Put(camera->mutable_up(), {up.x, up.y, up.z});
  scene.mutable_output()->set_samples(OneOf({4u, 1u, 16u}));
  Put(scene.mutable_ambient(), {.2, .2, .2});
  Put(scene.mutable_background(), {.1, .2, .5, .7, .7, .6});
  AddSun(&scene, {1, -.5, 1}, {1, .9f, .8f});
  if (*rc::gen::arbitrary<bool>()) {
    scene.mutable_sea()->set_level(Between(-.5, .5));
    Put(scene.mutable_sea()->mutable_color(), {.02, .06, .1});
  }
  const int objects = *rc::gen::inRange(1, 6);
  for (int i = 0; i < objects; ++i) {
    *rc::gen::arbitrary<bool>() ? AddRandomCurve(&scene) : AddRandomMesh(&scene);
  }
  return scene;
}

}  // namespace fjord
