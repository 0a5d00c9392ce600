#include "engine/animation/inbetween.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "engine/animation/travel.h"
#include "tests/animation/animate.h"

namespace fjord {
namespace {

using testing::Animate;
using testing::FrameOf;
using ::testing::HasSubstr;
using testing::KeyOf;
using testing::PointOf;

// A triangle that travels from frame 1 to frame 11, with numbers that have no short binary form.
std::string Triangle(double shift) {
  const std::string x = std::to_string(shift);
  return "shape { mesh { point { x: " + x + " z: .1 } point { x: 1.3 y: " + x +
         " } point { y: 1.7 z: -0.0 } face { v: 1 v: 2 v: 3 } } }";
}
std::string Moving(const std::string& more, const std::string& ease = "LINEAR") {
  return "output { frames: 21 }\nobjects { name: \"a\"\nkey { frame: 1 ease: " + ease + " " +
         Triangle(.1) + " }\nkey { frame: 11 " + Triangle(.7) + " }\n" + more + " }\n";
}
const std::string kStill = "output { frames: 21 }\nobjects { name: \"a\" " + Triangle(.1) +
                           " fractal { method: \"surface\" } }\n";

std::string Bits(const v1::FrameScene& frame) {
  std::string bits;
  for (const double value : frame.object(0).point()) {
    bits.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  return bits;
}

std::string KeyBits(const v1::Scene& scene, int key) {
  std::string bits;
  for (const v1::Vec3& point : scene.objects(0).key(key).shape().mesh().point()) {
    for (const double value : {point.x(), point.y(), point.z()}) {
      bits.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
  }
  return bits;
}

// The dither is in the key, by its version, where it is in the picture.
TEST(InbetweenTest, W39_OnlyEightBitPicturesAreDithered) {
  const auto dither = [](const std::string& output) {
    const auto animation = Animate(kStill, {{"output.dither", "true"}, {"output.format", output}});
    return FrameOf(*animation, 1).output().dither();
  };
  EXPECT_EQ(FrameOf(*Animate(kStill), 1).output().dither(), kDitherVersion);
  EXPECT_EQ(dither("PNG8"), kDitherVersion);
  EXPECT_EQ(dither("PNG16"), 0u);
  EXPECT_EQ(dither("EXR_HALF"), 0u);
  const auto plain = Animate(kStill, {{"output.dither", "false"}});
  EXPECT_EQ(FrameOf(*plain, 1).output().dither(), 0u);
  EXPECT_NE(KeyOf(*plain, 1), KeyOf(*Animate(kStill), 1));
}

TEST(InbetweenTest, S25_AtAKeyThePointsAreTheKeysBitForBit) {
  for (const std::string ease : {"LINEAR", "SMOOTH", "IN", "OUT", "HOLD"}) {
    for (const std::string path : {"", "path { kind: STEER control { z: .3 } }",
                                   "path { kind: THROUGH control { z: .3 } control { x: .1 } }"}) {
      const auto animation = Animate(Moving(path, ease));
      EXPECT_EQ(Bits(FrameOf(*animation, 1)), KeyBits(animation->scene(), 0)) << ease << path;
      EXPECT_EQ(Bits(FrameOf(*animation, 11)), KeyBits(animation->scene(), 1)) << ease << path;
      EXPECT_EQ(Bits(FrameOf(*animation, 21)), KeyBits(animation->scene(), 1)) << "after the last";
    }
  }
}

TEST(InbetweenTest, S25_StraightPathsMoveEvenlyAndEveryFrameDiffers) {
  const auto animation = Animate(Moving(""));
  EXPECT_NEAR(PointOf(FrameOf(*animation, 6), 1, 1).x, .4, 1e-15);
  std::set<std::string> keys;
  for (uint32_t frame = 1; frame <= 11; ++frame) keys.insert(KeyOf(*animation, frame));
  EXPECT_EQ(keys.size(), 11u);
}

TEST(InbetweenTest, S25_ThroughPathsPassTheirPoints) {
  // two control points divide the ten frames in thirds: with 31 frames, frames 11 and 21
  const std::string text =
      "output { frames: 31 }\nobjects { name: \"a\"\nkey { frame: 1 " + Triangle(.1) +
      " }\nkey { frame: 31 " + Triangle(.7) + " }\n" +
      "point_path { vertex: 2 path { kind: THROUGH control { x: 2 y: 3 z: .25 } control { x: -1.1 "
      "y: .2 z: 4 } } }\n}";
  const auto animation = Animate(text);
  EXPECT_EQ(PointOf(FrameOf(*animation, 11), 1, 2), Vec3(2, 3, .25));
  EXPECT_NEAR(Length(PointOf(FrameOf(*animation, 21), 1, 2) - Vec3(-1.1, .2, 4)), 0, 1e-14);
  // the others go straight
  EXPECT_NEAR(PointOf(FrameOf(*animation, 16), 1, 1).x, .4, 1e-15);
  // for all points: control points are offsets from the straight way
  const auto all = Animate(Moving("path { kind: THROUGH control { z: 2 } }"));
  EXPECT_EQ(PointOf(FrameOf(*all, 6), 1, 3), Vec3(0, 1.7, 2));
}

TEST(InbetweenTest, S25_SteerPathsAreBentAndLeaveTowardsTheirPoints) {
  const std::string steer =
      "point_path { vertex: 1 path { kind: STEER control { x: .1 z: 3 } control { x: .7 z: 3 } } }";
  const auto animation = Animate(Moving(steer));
  const Vec3 middle = PointOf(FrameOf(*animation, 6), 1, 1);
  // cubic Bezier at 1/2: (P1 + 3 P2 + 3 P3 + P4) / 8
  EXPECT_NEAR(middle.z, (.1 + 9 + 9 + .1) / 8, 1e-14);
  EXPECT_NEAR(middle.x, .4, 1e-14);
  EXPECT_LT(middle.z, 3) << "bent by the points, not through them";
}

TEST(InbetweenTest, S25_SplinesRunSmoothlyThroughUnevenKeys) {
  const std::string text =
      "output { frames: 61 }\nobjects { name: \"a\" path { kind: SPLINE }\n"
      "key { frame: 1 " +
      Triangle(0) + " }\nkey { frame: 11 " + Triangle(1) + " }\nkey { frame: 41 " + Triangle(.5) +
      " }\nkey { frame: 61 " + Triangle(2) + " } }";
  const auto animation = Animate(text);
  const auto x = [&](uint32_t frame) { return PointOf(FrameOf(*animation, frame), 1, 1).x; };
  EXPECT_EQ(x(1), 0);
  EXPECT_EQ(x(11), 1);
  EXPECT_EQ(x(41), .5);
  EXPECT_EQ(x(61), 2);
  for (const uint32_t key : {11u, 41u}) {  // the speed does not jump at a key
    EXPECT_NEAR(x(key + 1) - x(key), x(key) - x(key - 1), .03);
  }
}

TEST(InbetweenTest, S25_RestPoseAndFinenessAreOneForTheShot) {
  const auto animation = Animate(Moving("rest_frame: 1 fractal { method: \"surface\" }") +
                                 "track { path: \"camera.eye.x\" key { frame: 1 value: -3 } key { "
                                 "frame: 21 value: 3 } }");
  const v1::FrameScene at_rest = FrameOf(*animation, 1), later = FrameOf(*animation, 14);
  EXPECT_EQ(at_rest.object(0).rest_size(), 0) << "the rest pose itself is written once";
  EXPECT_EQ(later.object(0).rest_size(), 9);
  EXPECT_EQ(Bits(at_rest), std::string(reinterpret_cast<const char*>(later.object(0).rest().data()),
                                       9 * sizeof(double)));
  EXPECT_EQ(at_rest.object(0).fractal().fineness().SerializeAsString(),
            later.object(0).fractal().fineness().SerializeAsString());
  EXPECT_GT(later.object(0).fractal().fineness().focal(), 0);
}

TEST(InbetweenTest, S15_DoublingTheEyeDistanceDoublesEpsilon) {
  const auto epsilon = [](double distance) {
    const auto animation =
        Animate("camera { eye { y: -" + std::to_string(distance) + " } look_at {} }\nobjects { " +
                Triangle(.1) + " fractal { method: \"surface\" viewing: 2 } }");
    return FrameOf(*animation, 1).object(0).fractal().fineness().epsilon();
  };
  EXPECT_EQ(epsilon(8), 2 * epsilon(4));
  EXPECT_EQ(epsilon(8), .01 * 8 / 2);
}

TEST(InbetweenTest, S15_TheFinestFrameCountsForTheShot) {
  const auto animation = Animate(
      kStill +
          "track { path: \"camera.eye\" key { frame: 1 value: [0, -9, 2] } key { frame: 21 value: "
          "[0, -3, 1] } }",
      {{"camera.look_at", "0 0 0"}, {"objects[a].fractal.viewing", "1"}});
  const double nearest = std::sqrt(9 + 1);
  EXPECT_NEAR(FrameOf(*animation, 4).object(0).fractal().fineness().epsilon(), .01 * nearest,
              1e-15);
}

// Everything of the object but where it is placed.
std::string WithoutPlace(v1::FrameScene frame) {
  frame.mutable_object(0)->clear_transform();
  return frame.object(0).SerializeAsString();
}

TEST(InbetweenTest, S3_C16a_MovingAndTurningAnObjectChangesItsTransformAlone) {
  const auto animation = Animate(
      kStill +
      "track { path: \"objects[a].transform.translate\" key { frame: 1 value: [0,0,0] } key { "
      "frame: 21 value: [5,-2,1] } }\ntrack { path: \"objects[a].transform.rotate.z\" key { "
      "frame: 1 value: 0 } key { frame: 21 value: 300 } }");
  const v1::FrameScene first = FrameOf(*animation, 1);
  EXPECT_EQ(first.object(0).transform_size(), 0) << "as it is";
  for (const uint32_t frame : {2u, 9u, 21u}) {
    const v1::FrameScene now = FrameOf(*animation, frame);
    EXPECT_EQ(now.object(0).transform_size(), 12);
    EXPECT_EQ(WithoutPlace(now), WithoutPlace(first)) << frame;
  }
}

TEST(InbetweenTest, G44_AMovingCameraLeavesTheTerrainAlone) {
  const auto animation =
      Animate(kStill +
              "track { path: \"camera.eye\" key { frame: 1 value: [-5,-9,2] } key { frame: 21 "
              "value: [5,-9,1] } }");
  const std::string object = FrameOf(*animation, 1).object(0).SerializeAsString();
  for (const uint32_t frame : {2u, 11u, 21u}) {
    EXPECT_EQ(FrameOf(*animation, frame).object(0).SerializeAsString(), object) << frame;
    EXPECT_NE(KeyOf(*animation, frame), KeyOf(*animation, 1));
  }
}

struct Tracked {
  const char* path;
  double from, to, middle;
};

class TrackedNumberTest : public ::testing::TestWithParam<Tracked> {};

// frames 1 to 5: frame 3 is half way
TEST_P(TrackedNumberTest, W2_MidKeyEqualsTheStaticSceneWithThatValue) {
  const Tracked& track = GetParam();
  const std::string scene =
      "output { frames: 5 }\nsea {}\nlights { name: \"sun\" direction { z: "
      "1 } "
      "}\nlights { name: \"lamp\" kind: LOCAL position { z: 3 } range: 9 }\nobjects { name: "
      "\"a\" " +
      Triangle(.1) +
      " fractal { method: \"surface\" epsilon: .01 variant: PERTURBED coast: true } material { "
      "ramp { height: -1 } ramp { height: "
      "1 } } "
      "transform {} }\n"
      "objects { name: \"ball\" shape { primitive { kind: TORUS radius: 2 tube: .5 } } }\n"
      "objects { name: \"line\" shape { polyline { point {} point { x: 1 } } } }\n"
      "objects { name: \"old\" shape { primitive { kind: GRID } } fractal { law: SHIH epsilon: 1 } "
      "}\n";
  const auto moving =
      Animate("camera { near: .001 up { z: 1 } eye { x: 1 y: -6 z: 3 } look_at { z: .1 } }\n" +
                  scene + "track { path: \"" + track.path +
                  "\" key { frame: 1 value: " + std::to_string(track.from) +
                  " } key { frame: 5 value: " + std::to_string(track.to) + " } }",
              {});
  ASSERT_NE(moving, nullptr);
  const auto still = Animate(
      "camera { near: .001 up { z: 1 } eye { x: 1 y: -6 z: 3 } look_at { z: .1 } }\n" + scene,
      {{track.path, std::to_string(track.middle)}});
  ASSERT_NE(still, nullptr);
  v1::FrameScene now = FrameOf(*moving, 3), alone = FrameOf(*still, 1);
  // an object whose shape changes rests as it is at the end of the shot
  for (v1::FrameScene* frame : {&now, &alone}) {
    for (v1::FrameObject& object : *frame->mutable_object()) object.clear_rest();
  }
  EXPECT_EQ(FrameKey(now)->Hex(), FrameKey(alone)->Hex()) << now.ShortDebugString() << "\n"
                                                          << alone.ShortDebugString();
  EXPECT_NE(KeyOf(*moving, 1), KeyOf(*moving, 3));
}

INSTANTIATE_TEST_SUITE_P(
    All, TrackedNumberTest,
    ::testing::Values(Tracked{"objects[a].fractal.H", .25, .75, .5},
                      Tracked{"objects[a].fractal.sigma", 1, 2, 1.5},
                      Tracked{"objects[a].fractal.amplitude", .25, .5, .375},
                      Tracked{"objects[old].fractal.move", .25, .5, .375},
                      Tracked{"objects[a].fractal.perturb", 0, 1, .5},
                      Tracked{"objects[a].fractal.coast_H", .5, 1, .75},
                      Tracked{"objects[a].transform.translate.z", 0, 4, 2},
                      Tracked{"objects[a].transform.rotate.x", 0, 60, 30},
                      Tracked{"objects[a].material.ramp[2].height", 2, 4, 3},
                      Tracked{"objects[a].material.ramp[1].color.g", 0, 1, .5},
                      Tracked{"objects[a].material.specular", 0, 1, .5},
                      Tracked{"objects[a].material.shininess", 10, 30, 20},
                      Tracked{"objects[a].shape.mesh.point[1].z", 0, .5, .25},
                      Tracked{"objects[ball].shape.primitive.radius", 2, 3, 2.5},
                      Tracked{"objects[line].material.line_width", 2, 4, 3},
                      Tracked{"camera.fov", 20, 60, 40}, Tracked{"camera.eye.x", 1, 3, 2},
                      Tracked{"camera.up.x", 0, .5, .25},
                      Tracked{"lights[sun].direction.x", 0, 1, .5},
                      Tracked{"lights[lamp].range", 4, 8, 6},
                      Tracked{"lights[lamp].intensity", 1, 2, 1.5},
                      Tracked{"background.top.r", 0, 1, .5}, Tracked{"ambient.b", 0, 1, .5},
                      Tracked{"sea.level", -1, 0, -.5}, Tracked{"sea.specular", 0, 1, .5}));

TEST(InbetweenTest, W2_FinenessIsTheFinestOverTheShot) {
  const auto moving = Animate(kStill +
                                  "track { path: \"objects[a].fractal.epsilon\" key { frame: 1 "
                                  "value: .5 } key { frame: 21 value: .125 } }",
                              {{"objects[a].fractal.epsilon", "1"}});
  const auto epsilon = [](const Animation& animation, uint32_t frame) {
    return FrameOf(animation, frame).object(0).fractal().fineness().epsilon();
  };
  EXPECT_EQ(epsilon(*moving, 1), .125);
  EXPECT_EQ(epsilon(*moving, 21), .125);
  const auto by_frame =
      Animate(kStill +
                  "track { path: \"objects[a].fractal.epsilon\" key { frame: 1 "
                  "value: .5 } key { frame: 21 value: .125 } }",
              {{"objects[a].fractal.epsilon", "1"}, {"objects[a].fractal.split", "LENGTH"}});
  EXPECT_EQ(epsilon(*by_frame, 1), .5);
}

TEST(InbetweenTest, C36_LeavingDefaultsOutGivesTheSameFrameKey) {
  const auto implicit = Animate("objects { " + Triangle(.1) + " fractal {} }");
  const auto explicit_scene = Animate(
      "output { width: 960 height: 540 frames: 1 rate: 24 format: PNG8 samples: 4 }\n"
      "lights { name: \"sun\" kind: DIRECTIONAL direction { x: -.55 y: -.4 z: .6 } color { r: 1 g: "
      ".92 "
      "b: .78 } intensity: 1.1 }\n"
      "objects { name: \"other\" " +
      Triangle(.1) +
      " fractal { method: \"surface\" seed: 1 pixels: 1 split: SHOT stretch: true uniforms: 4 "
      "max_level: 24 } material { ambient: 1 diffuse: 1 specular: 0 shininess: 20 line_width: 2 } "
      "}");
  EXPECT_EQ(KeyOf(*implicit, 1), KeyOf(*explicit_scene, 1));
}

TEST(InbetweenTest, C47_TheSameSceneGivesTheSameKeysFromTextAndFromTheWire) {
  LoadResult loaded = testing::Load(Moving("fractal {}"));
  ASSERT_TRUE(loaded.ok());
  LoadResult wire =
      LoadSceneBinary(SerializeScene(loaded.loaded.scene), "job",
                      [](const v1::File&) -> Result<std::string> { return Invalid("-"); });
  ASSERT_TRUE(wire.ok());
  const auto here = *Animation::Make(std::move(loaded.loaded));
  const auto there = *Animation::Make(std::move(wire.loaded));
  for (const uint32_t frame : {1u, 7u, 11u, 20u})
    EXPECT_EQ(KeyOf(*here, frame), KeyOf(*there, frame));
}

TEST(InbetweenTest, TheFrameNumberIsNotInTheKey) {
  const auto animation = Animate(kStill);
  EXPECT_EQ(KeyOf(*animation, 1), KeyOf(*animation, 21));
  const auto moving = Animate(Moving(""));
  EXPECT_EQ(KeyOf(*moving, 11), KeyOf(*moving, 15)) << "nothing moves after the last key";
}

TEST(InbetweenTest, FramesOutsideTheAnimationAreRefused) {
  const auto animation = Animate(kStill);
  for (const uint32_t frame : {0u, 22u, 4294967295u}) {
    const Result<v1::FrameScene> scene = animation->Inbetween(frame, nullptr);
    ASSERT_FALSE(scene.ok());
    EXPECT_THAT(scene.error().message, HasSubstr("is outside the animation, frames 1 to 21"));
  }
}

TEST(InbetweenTest, ACameraThatTracksBlindIsRefusedWithItsFrame) {
  LoadResult loaded = testing::Load(
      kStill +
      "camera { eye { y: -4 } look_at {} }\ntrack { path: \"camera.eye\" key { frame: 1 value: "
      "[0,-4,0] } key { frame: 21 value: [0,4,0] } }");
  ASSERT_TRUE(loaded.ok());
  const auto animation = Animation::Make(std::move(loaded.loaded));
  ASSERT_FALSE(animation.ok());
  EXPECT_EQ(animation.error().message, "frame 11: the camera's eye and look_at are at one place");
}

TEST(InbetweenTest, ColoursTravelWithTheirPoints) {
  const auto key = [](int frame, double red) {
    return "key { frame: " + std::to_string(frame) +
           " shape { mesh { point {} point { x: 1 } point { y: 1 } face { v: [1,2,3] } color { "
           "r: " +
           std::to_string(red) + " } color {} color {} } } }\n";
  };
  const auto animation = Animate("output { frames: 3 }\nobjects { " + key(1, 0) + key(3, 1) +
                                 "material { vertex_color: true } }");
  EXPECT_EQ(FrameOf(*animation, 2).object(0).color(0), .5);
  EXPECT_EQ(FrameOf(*animation, 2).object(0).color_size(), 9);
}

TEST(TravelTest, G49_BezierLeavesAlongItsFirstLegAndArrivesAlongItsLast) {
  const std::vector<Vec3> control = {{0, 0, 0}, {1, 2, 0}, {4, 1, 1}, {5, 0, 3}};
  EXPECT_EQ(Bezier(control, 0), control[0]);
  EXPECT_EQ(Bezier(control, 1), control[3]);
  const double h = 1e-6;
  const Vec3 start = (Bezier(control, h) - control[0]) / h;
  const Vec3 end = (control[3] - Bezier(control, 1 - h)) / h;
  EXPECT_LT(Length(start - 3. * (control[1] - control[0])), 1e-4);
  EXPECT_LT(Length(end - 3. * (control[3] - control[2])), 1e-4);
}

TEST(TravelTest, S25_SplineWeightsReproduceLinesAndParabolas) {
  for (const bool before : {false, true}) {
    for (const bool after : {false, true}) {
      for (const double t : {0., .25, .5, .9, 1.}) {
        const std::array<double, 4> times = {-3, 1, 2.5, 7};
        const auto w = SplineWeights(times, before, after, t);
        EXPECT_NEAR(w[0] + w[1] + w[2] + w[3], 1, 1e-14);
        const double time = 1 + 1.5 * t;
        EXPECT_NEAR(w[0] * times[0] + w[1] * times[1] + w[2] * times[2] + w[3] * times[3], time,
                    1e-13);
        if (before && after) {
          double square = 0;
          for (size_t i = 0; i < 4; ++i) square += w[i] * times[i] * times[i];
          EXPECT_NEAR(square, time * time, 1e-12);
        }
        if (!before) {
          EXPECT_EQ(w[0], 0);
        }
        if (!after) {
          EXPECT_EQ(w[3], 0);
        }
      }
    }
  }
}

// A still shot is one picture, whatever stages it has, unless one of them reads the time.
TEST(InbetweenTest, TimeAndUvReachAFrameOnlyWhereAStageReadsThem) {
  const auto shot = [](const std::string& stage) {
    return Animate(
        "output { frames: 9 } objects { shape { primitive { kind: SPHERE radius: 2 } } "
        "material { " +
        stage + " } }");
  };
  const auto plain = shot("");
  const auto checker = shot("stage { kind: \"checker\" across: 6 }");
  const auto noise = shot("stage { kind: \"noise\" }");
  const auto drifting = shot("stage { kind: \"noise\" drift { x: .1 } }");
  EXPECT_EQ(FrameOf(*plain, 3).object(0).uv(), 0u);
  EXPECT_EQ(FrameOf(*noise, 3).object(0).uv(), 0u);
  EXPECT_EQ(FrameOf(*checker, 3).object(0).uv(), 2u);
  EXPECT_EQ(FrameOf(*checker, 3).object(0).uv_size(0), 2);
  EXPECT_EQ(KeyOf(*checker, 1), KeyOf(*checker, 9));
  EXPECT_EQ(KeyOf(*noise, 1), KeyOf(*noise, 9));
  EXPECT_NE(KeyOf(*drifting, 1), KeyOf(*drifting, 9));
  EXPECT_EQ(FrameOf(*drifting, 9).instant(), 9);
}

// Only strokes below a pixel carry the version of how they fade, so all other keys stay.
TEST(InbetweenTest, ThinStrokesFadeAndOthersKeepTheirKeys) {
  const std::string line =
      "shape { polyline { point {} point { x: 1 } point { y: 1 } closed: true } }";
  const auto fading = [&](const std::string& object, uint32_t height) {
    const auto animation =
        Animate("output { height: " + std::to_string(height) + " } objects { " + object + " }");
    return FrameOf(*animation, 1).object(0).material().fading();
  };
  EXPECT_EQ(fading(line, 1080), 0u);
  EXPECT_EQ(fading(line, 540), 0u) << "a whole pixel";
  EXPECT_EQ(fading(line, 539), kFadingVersion);
  EXPECT_EQ(fading(line + " material { line_width: 1 }", 1080), 0u);
  EXPECT_EQ(fading(line + " material { line_width: 0.9 }", 1080), kFadingVersion);
  EXPECT_EQ(fading(line + " material { fill: true }", 100), 0u) << "what is filled is seen";
  EXPECT_EQ(fading("shape { primitive { kind: SPHERE } }", 100), 0u) << "no strokes";
}

TEST(InbetweenTest, AlphaIsInTheKeyOnlyWhereItIsAskedFor) {
  const std::string object = "objects { shape { primitive { kind: SPHERE } } }";
  const auto key = [&](const std::string& output) {
    return KeyOf(*Animate("output { " + output + " } " + object), 1);
  };
  EXPECT_EQ(key("alpha: false"), key(""));
  EXPECT_NE(key("alpha: true"), key(""));
}

}  // namespace
}  // namespace fjord
