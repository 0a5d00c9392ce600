#include "engine/scene/defaults.h"

#include <gtest/gtest.h>

#include "engine/scene/load.h"
#include "engine/scene/transform.h"
#include "engine/scene/write_json.h"
#include "tests/scene/entry_values.h"
#include "tests/scene/load_text.h"

namespace fjord {
namespace {

using testing::ErrorsOf;
using testing::Load;

v1::Scene Loaded(const std::string& text) {
  LoadResult result = Load(text);
  EXPECT_TRUE(result.ok()) << ErrorsOf(result);
  return result.loaded.scene;
}

const std::string kRelief =
    "objects { name: \"island\" shape { mesh {\n"
    "  point { x: -2 y: -1 } point { x: 2 y: -1 } point { x: 2 y: 1 } point { x: -2 y: 1 }\n"
    "  point { z: 1 }\n"
    "  face { v: 1 v: 2 v: 5 } face { v: 2 v: 3 v: 5 } face { v: 3 v: 4 v: 5 } face { v: 4 v: 1 v: "
    "5 }\n"
    "} } fractal {} }\n";

// Where a point is in the picture, 0 the middle, 1 the edge of the shorter side up.
Vec2 Projected(const v1::Camera& camera, const Vec3& point, double* distance) {
  const Vec3 eye(camera.eye().x(), camera.eye().y(), camera.eye().z());
  const Vec3 look(camera.look_at().x(), camera.look_at().y(), camera.look_at().z());
  const Vec3 up(camera.up().x(), camera.up().y(), camera.up().z());
  const Vec3 back = Unit(eye - look), right = Unit(glm::cross(up, back));
  const Vec3 upright = glm::cross(back, right), from = point - eye;
  *distance = -glm::dot(from, back);
  const double slope = std::tan(camera.fov() * 3.14159265358979 / 360);
  return {glm::dot(from, right) / *distance / slope, glm::dot(from, upright) / *distance / slope};
}

void ExpectInView(const v1::Scene& scene, const Vec3& point) {
  double distance = 0;
  const Vec2 place = Projected(scene.camera(), point, &distance);
  const double aspect = static_cast<double>(scene.output().width()) / scene.output().height();
  EXPECT_GT(distance, scene.camera().near());
  EXPECT_LT(std::abs(place.y), 1) << point.x << " " << point.y << " " << point.z;
  EXPECT_LT(std::abs(place.x), aspect) << point.x << " " << point.y << " " << point.z;
}

TEST(DefaultsTest, C36_WritingTheDefaultsOutChangesNothing) {
  for (const std::string& text :
       {kRelief, std::string("sea {}\n") + kRelief,
        std::string("objects { shape { primitive { kind: TORUS } } fractal {} }"),
        std::string(
            "objects { shape { polyline { closed: true point {} point { x: 1 } point { y: 1 } "
            "} } fractal {} }"),
        std::string("lights { kind: LOCAL position { z: 4 } }\n") + kRelief +
            "track { path: \"camera.eye.z\" key { frame: 1 value: 3 } key { frame: 9 value: 5 } "
            "}"}) {
    const v1::Scene implicit = Loaded(text);
    const std::string written = SceneJson(implicit);
    const v1::Scene explicit_scene = Loaded(written);
    EXPECT_EQ(SerializeScene(implicit), SerializeScene(explicit_scene)) << written;
  }
}

TEST(DefaultsTest, C35_EveryFieldHasAValueOrAMeaningWhenAbsent) {
  const v1::Scene scene = Loaded(kRelief);
  EXPECT_EQ(scene.output().width(), 960u);
  EXPECT_EQ(scene.output().height(), 540u);
  EXPECT_EQ(scene.output().frames(), 1u);
  EXPECT_EQ(scene.output().samples(), 4u);
  EXPECT_TRUE(scene.output().dither());
  EXPECT_EQ(scene.lights(0).name(), "sun");
  EXPECT_FALSE(scene.has_sea());
  const v1::Fractal& fractal = scene.objects(0).fractal();
  EXPECT_EQ(fractal.method(), "surface");
  EXPECT_EQ(fractal.pixels(), 1);
  EXPECT_EQ(fractal.split(), v1::Fractal::SHOT);
  EXPECT_EQ(testing::ValueIn(fractal, "law"), "AFFINE");
  EXPECT_EQ(testing::ValueIn(fractal, "H"), "0.7");
  EXPECT_EQ(testing::ValueIn(fractal, "perturb"), "");  // has no effect with FIXED
  EXPECT_TRUE(fractal.has_seed() && fractal.has_max_level());
}

// `color {}` is given: black, not the default.
TEST(DefaultsTest, AnEmptyColourIsBlack) {
  const v1::Scene scene = Loaded(
      "background { top {} bottom {} } sea { color {} } lights { direction { z: 1 } color {} }\n"
      "objects { shape { primitive { kind: SPHERE } } material { color {} } }\n"
      "objects { shape { primitive { kind: SPHERE } } material { color { g: .5 } } }");
  for (const v1::Color* color :
       {&scene.background().top(), &scene.background().bottom(), &scene.sea().color(),
        &scene.lights(0).color(), &scene.objects(0).material().color()}) {
    EXPECT_EQ(color->r() + color->g() + color->b(), 0);
    EXPECT_TRUE(color->has_r() && color->has_g() && color->has_b());
  }
  EXPECT_EQ(scene.objects(1).material().color().r(), 0);
  EXPECT_EQ(scene.objects(1).material().color().g(), .5);
  EXPECT_GT(scene.ambient().r(), 0);
}

TEST(DefaultsTest, MethodByShape) {
  const std::string triangle = "point { x: 0 } point { x: 1 } point { y: 1 }";
  const auto method = [](const std::string& shape) {
    return Loaded("objects { shape { " + shape + " } fractal {} }").objects(0).fractal().method();
  };
  EXPECT_EQ(method("polyline { " + triangle + " }"), "curve");
  EXPECT_EQ(method("mesh { " + triangle + " face { v: 1 v: 2 v: 3 } }"), "coast");
  EXPECT_EQ(method("primitive { kind: GRID }"), "surface");
  EXPECT_EQ(method("primitive { kind: SPHERE }"), "surface");
}

TEST(DefaultsTest, FramesReachTheLastKey) {
  EXPECT_EQ(Loaded(kRelief + "track { path: \"camera.fov\" key { frame: 1 value: 30 } key { frame: "
                             "47.2 value: 40 } }")
                .output()
                .frames(),
            48u);
}

TEST(DefaultsTest, ReliefIsSeenFromTheSouthThirtyDegreesUp) {
  const v1::Scene scene = Loaded("sea { level: -1 }\n" + kRelief);
  const v1::Camera& camera = scene.camera();
  const double dx = camera.eye().x() - camera.look_at().x();
  const double dy = camera.eye().y() - camera.look_at().y();
  const double dz = camera.eye().z() - camera.look_at().z();
  EXPECT_LT(dy, 0);
  EXPECT_NEAR(std::atan2(dz, std::hypot(dx, dy)) * 180 / 3.14159265358979, 30, 1);
  for (const double x : {-2., 2.}) {
    for (const double y : {-1., 1.}) {
      for (const double z : {-1., 1.}) ExpectInView(scene, {x, y, z});
    }
  }
  EXPECT_GT(scene.objects(0).material().ramp_size(), 3);
}

TEST(DefaultsTest, FlatOutlinesAreSeenFromAbove) {
  const v1::Scene scene = Loaded(
      "objects { shape { polyline { closed: true point {} point { x: 3 } point { x: 3 y: 1 } } } "
      "}");
  EXPECT_EQ(scene.camera().eye().x(), scene.camera().look_at().x());
  EXPECT_EQ(scene.camera().eye().y(), scene.camera().look_at().y());
  EXPECT_GT(scene.camera().eye().z(), 0);
  EXPECT_EQ(scene.camera().up().y(), 1);
  ExpectInView(scene, {0, 0, 0});
  ExpectInView(scene, {3, 1, 0});
}

TEST(DefaultsTest, TheCameraSeesTheWholeShot) {
  const v1::Scene scene =
      Loaded(kRelief +
             "track { path: \"objects[island].transform.translate.x\" key { frame: 1 value: -9 } "
             "key { frame: 20 value: 14 } }");
  for (const double x : {-11., 16.}) {
    for (const double y : {-1., 1.}) ExpectInView(scene, {x, y, 0});
  }
}

TEST(DefaultsTest, NearLeavesRoomForTheNearestFrame) {
  const v1::Scene scene = Loaded(
      kRelief +
      "camera { look_at {} }\ntrack { path: \"camera.eye\" key { frame: 1 value: [0, -20, 5] "
      "} key { frame: 20 value: [0, -2, 0] } }");
  EXPECT_LE(scene.camera().near(), .02 * (1 + 1e-12));
}

TEST(TransformTest, ScaledThenTurnedThenMoved) {
  v1::Transform message;
  message.mutable_scale()->set_x(2);
  message.mutable_rotate()->set_z(90);
  message.mutable_translate()->set_y(5);
  const ObjectTransform transform(message);
  EXPECT_EQ(transform.ToWorld({1, 0, 0}), Vec3(0, 7, 0));
  EXPECT_EQ(transform.ToObject({0, 7, 0}), Vec3(1, 0, 0));
  message.mutable_rotate()->set_x(90);  // x before z: y goes up, then stays
  EXPECT_EQ(ObjectTransform(message).ToWorld({0, 1, 0}), Vec3(0, 5, 1));
  message.mutable_rotate()->set_y(33.5);
  const Vec3 point(.3, -2, 7);
  const ObjectTransform bent(message);
  EXPECT_NEAR(Length(bent.ToObject(bent.ToWorld(point)) - point), 0, 1e-12);
  EXPECT_TRUE(ObjectTransform().IsIdentity());
  EXPECT_FALSE(bent.IsIdentity());
  message.mutable_rotate()->set_x(450);
  v1::Transform quarter = message;
  quarter.mutable_rotate()->set_x(90);
  EXPECT_EQ(ObjectTransform(message).Rows(), ObjectTransform(quarter).Rows());
}

}  // namespace
}  // namespace fjord
