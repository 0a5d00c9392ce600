#include "engine/scene/field_path.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "engine/scene/route.h"
#include "tests/scene/entry_values.h"

namespace fjord {
namespace {

TEST(FieldPathTest, ReadsNamesAndSelectors) {
  const Result<FieldPath> path = ParseFieldPath("objects[coast].key[2].frame");
  ASSERT_TRUE(path.ok());
  const FieldPath expected{{{"objects", "coast"}, {"key", "2"}, {"frame", ""}}};
  EXPECT_EQ(*path, expected);
}

TEST(FieldPathTest, ErrorsNameTheCharacter) {
  const auto message = [](const char* text) { return ParseFieldPath(text).error().message; };
  EXPECT_NE(message("").find("field name is missing at character 1"), std::string::npos);
  EXPECT_NE(message("a.").find("field name is missing at character 3"), std::string::npos);
  EXPECT_NE(message("a[").find("name or number is missing at character 3"), std::string::npos);
  EXPECT_NE(message("a[1.b").find("] is missing at character 4"), std::string::npos);
  EXPECT_NE(message("a[1]b").find(". is missing at character 5"), std::string::npos);
  EXPECT_NE(message("a b").find(". is missing at character 2"), std::string::npos);
  EXPECT_FALSE(ParseFieldPath(std::string(100000, 'a')).ok());
}

rc::Gen<std::string> Name() {
  return rc::gen::nonEmpty(
      rc::gen::container<std::string>(rc::gen::elementOf(std::string("abcXYZ019_-"))));
}

RC_GTEST_PROP(FieldPathProperty, PrintedPathsReadBack, ()) {
  FieldPath path;
  const auto count = *rc::gen::inRange(1, 6);
  for (int i = 0; i < count; ++i) {
    path.pieces.push_back({*Name(), *rc::gen::arbitrary<bool>() ? *Name() : std::string()});
  }
  const Result<FieldPath> read = ParseFieldPath(PrintFieldPath(path));
  if (PrintFieldPath(path).size() > 2000) return;
  RC_ASSERT(read.ok());
  RC_ASSERT(*read == path);
}

RC_GTEST_PROP(FieldPathProperty, WhatReadsPrintsTheSame, (const std::string& text)) {
  const Result<FieldPath> read = ParseFieldPath(text);
  if (read.ok()) RC_ASSERT(PrintFieldPath(*read) == text);
}

v1::Scene SmallScene() {
  v1::Scene scene;
  scene.add_objects()->set_name("coast");
  scene.add_objects()->set_name("2x");
  scene.mutable_objects(0)->mutable_shape()->mutable_mesh()->add_point()->set_x(4);
  scene.mutable_objects(1)->mutable_fractal();
  return scene;
}

Result<Route> Find(const v1::Scene& scene, const std::string& path) {
  return FindRoute(scene, *ParseFieldPath(path));
}

TEST(RouteTest, EntriesByNameOrNumberFromOne) {
  const v1::Scene scene = SmallScene();
  EXPECT_EQ(*Find(scene, "objects[coast].fractal.H"), *Find(scene, "objects[1].fractal.H"));
  EXPECT_EQ(*Find(scene, "objects[2x].fractal.H"), *Find(scene, "objects[2].fractal.H"));
  EXPECT_EQ(PrintRoute(scene, *Find(scene, "objects[1].shape.mesh.point[1].x")),
            "objects[coast].shape.mesh.point[1].x");
}

TEST(RouteTest, ErrorsNameTheBadPieceAndTheNearest) {
  const v1::Scene scene = SmallScene();
  const auto message = [&](const char* path) { return Find(scene, path).error().message; };
  EXPECT_EQ(message("objects[cost].fractal.H"),
            "objects has no entry named \"cost\"; did you mean coast?");
  EXPECT_EQ(message("objects[3].fractal"), "objects has 2 entries, counted from 1; there is no 3");
  EXPECT_EQ(message("objects[0].fractal"), "objects has 2 entries, counted from 1; there is no 0");
  EXPECT_EQ(message("objects[1].fractal.sigm"),
            "objects[1].fractal has no field \"sigm\"; did you mean sigma?");
  EXPECT_EQ(message("objects.fractal"),
            "objects is a list; say which entry, by name or number from 1: objects[1]");
  EXPECT_EQ(message("camera[1].fov"), "camera is not a list; leave out [1]");
  EXPECT_EQ(message("camera.fov.x"), "camera.fov is a plain value; it has no field \"x\"");
  EXPECT_EQ(message("objects[coast].shape.primitive.radius"),
            "objects[coast].shape is a mesh, not a primitive");
}

TEST(RouteTest, SetsEveryKindOfField) {
  v1::Scene scene = SmallScene();
  const auto set = [&](const char* path, const char* value) {
    const Result<Route> route = Find(scene, path);
    return route.ok() && SetFromText(&scene, *route, value).ok();
  };
  EXPECT_TRUE(set("objects[2x].fractal.H", ".25"));
  EXPECT_TRUE(set("objects[2x].fractal.seed", "18446744073709551615"));
  EXPECT_TRUE(set("objects[2x].fractal.law", "SIMILAR"));
  EXPECT_TRUE(set("objects[2x].fractal.stretch", "false"));
  EXPECT_TRUE(set("output.width", "12"));
  EXPECT_TRUE(set("name", "other"));
  EXPECT_TRUE(set("camera.eye", "1, 2 3"));
  EXPECT_TRUE(set("camera.up", "z: 1"));
  EXPECT_TRUE(set("objects[coast].shape.mesh.point[1].x", "5"));
  EXPECT_EQ(testing::ValueIn(scene.objects(1).fractal(), "H"), "0.25");
  EXPECT_EQ(scene.objects(1).fractal().seed(), UINT64_MAX);
  EXPECT_EQ(testing::ValueIn(scene.objects(1).fractal(), "law"), "SIMILAR");
  EXPECT_EQ(testing::ValueIn(scene.objects(1).fractal(), "stretch"), "false");
  EXPECT_EQ(scene.output().width(), 12u);
  EXPECT_EQ(scene.name(), "other");
  EXPECT_EQ(scene.camera().eye().y(), 2);
  EXPECT_EQ(scene.camera().up().z(), 1);
  EXPECT_EQ(scene.objects(0).shape().mesh().point(0).x(), 5);

  EXPECT_FALSE(set("output.width", "-1"));
  EXPECT_FALSE(set("output.width", "4294967296"));
  EXPECT_FALSE(set("camera.fov", "4x"));
  EXPECT_FALSE(set("camera.fov", ""));
  EXPECT_FALSE(set("camera.eye", "1 2"));
  EXPECT_FALSE(set("objects[2x].fractal.stretch", "yes"));
  EXPECT_FALSE(set("objects[2x].fractal.law", "similar_"));
}

}  // namespace
}  // namespace fjord
