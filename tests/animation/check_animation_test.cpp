#include "engine/animation/check_animation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/animation/coarse.h"
#include "engine/animation/frame_geometry.h"
#include "engine/fractal/midpoint_knobs.h"
#include "engine/fractal/registry.h"
#include "tests/animation/animate.h"
#include "tests/fractal/choices.h"

namespace fjord {
namespace {

using testing::Animate;
using testing::FrameOf;
using ::testing::HasSubstr;

std::string Hill(double height) {
  return "shape { mesh { point { x: -1 y: -1 } point { x: 1 y: -1 } point { x: 1 y: 1 } point { x: "
         "-1 y: 1 "
         "} point { z: " +
         std::to_string(height) +
         " } face { v: [1,2,5] } face { v: [2,3,5] } face { v: [3,4,5] } face { v: [4,1,5] } } }";
}

std::string Rising(const std::string& fractal) {
  return "output { frames: 12 }\nobjects { name: \"hill\"\nkey { frame: 1 " + Hill(.05) +
         " }\nkey { frame: 12 " + Hill(.8) + " }\nfractal { " + fractal + " } }\n";
}

TEST(CheckAnimationTest, S25_AMovingShapeKeepsItsVerticesAndNothingPops) {
  const auto animation = Animate(Rising("method: \"surface\" epsilon: .05"));
  const Result<AnimationCheck> check = CheckAnimation(*animation);
  ASSERT_TRUE(check.ok()) << check.error().ToString();
  ASSERT_EQ(check->objects.size(), 1u);
  const ObjectCheck& hill = check->objects[0];
  EXPECT_TRUE(check->good) << hill.verdict;
  EXPECT_EQ(hill.identities_change, 0u);
  EXPECT_GT(hill.vertices, 500u);
  EXPECT_GT(hill.largest_step, 0);
  EXPECT_LT(hill.proportion, kStepProportion);
}

// An open, bent line, or the hill's border as an outline.
std::string Bow(double height, bool closed) {
  return "shape { polyline { point { x: -1 y: -1 } point { x: 1 y: -1.2 } point { x: 1.1 y: 1 } "
         "point { x: " +
         std::to_string(-1 + height) + " y: .8 } " + (closed ? "closed: true" : "") + " } }";
}

// Whatever a method offers: the same vertices in every frame, and none out of proportion.
TEST(CheckAnimationTest, S25_NoMethodPops) {
  for (const MethodInfo& method : FractalMethods()) {
    const bool curve = method.takes == Takes::kCurve;
    for (const Law law : test::LawsOf(method)) {
      for (const Direction direction : test::DirectionsOf(method)) {
        for (const Variant variant : test::VariantsOf(method)) {
          const std::string words = "law: " + std::string(LawName(law)) +
                                    " direction: " + std::string(DirectionName(direction)) +
                                    " variant: " + std::string(VariantName(variant));
          const auto shape = [&](double height) {
            return curve ? Bow(height, direction != Direction::kUp) : Hill(height);
          };
          const auto animation =
              Animate("output { frames: 40 }\nobjects { key { frame: 1 " + shape(.05) +
                      " } key { frame: 40 " + shape(.8) + " } fractal { method: \"" +
                      std::string(method.name) + "\" H: .5 epsilon: .05 " + words + " } }\n");
          const Result<AnimationCheck> check = CheckAnimation(*animation);
          ASSERT_TRUE(check.ok()) << check.error().ToString();
          EXPECT_TRUE(check->good)
              << method.name << " " << words << ": " << check->objects[0].verdict << " "
              << check->objects[0].proportion;
        }
      }
    }
  }
}

TEST(CheckAnimationTest, W2_TrackedSettingsAreNotPopping) {
  const auto animation = Animate(
      Rising("method: \"surface\" epsilon: .1") +
      "track { path: \"objects[hill].fractal.amplitude\" key { frame: 1 value: 0 } key { frame: "
      "12 value: 2 } }");
  const Result<AnimationCheck> check = CheckAnimation(*animation);
  ASSERT_TRUE(check.ok());
  EXPECT_TRUE(check->good) << check->objects[0].verdict;
}

TEST(CheckAnimationTest, SplitByLengthIsToldNotBlamed) {
  const auto animation = Animate(Rising("method: \"surface\" epsilon: .2 split: LENGTH"));
  const Result<AnimationCheck> check = CheckAnimation(*animation);
  ASSERT_TRUE(check.ok());
  EXPECT_TRUE(check->objects[0].by_frame);
  EXPECT_GT(check->objects[0].identities_change, 1u);
  EXPECT_THAT(check->objects[0].verdict, HasSubstr("split by frame"));
}

// How a growing triangle is cut to be welded changes at a size where its tree does not.
TEST(CheckAnimationTest, SplitByLengthIsComparedWhileTheTreeIsTheSame) {
  const auto key = [](int frame, const std::string& side) {
    return "key { frame: " + std::to_string(frame) +
           " shape { mesh { point { } point { x: " + side + " } point { y: " + side +
           " } face { v: [1,2,3] } } } }\n";
  };
  const auto animation =
      Animate("output { frames: 6 }\nobjects { name: \"flat\"\n" + key(1, "2.85") + key(6, "2.88") +
                  "fractal { method: \"surface\" split: LENGTH epsilon: .1 } }\n",
              {{"objects[flat].fractal.amplitude", "0"}});
  const Result<AnimationCheck> check = CheckAnimation(*animation);
  ASSERT_TRUE(check.ok()) << check.error().ToString();
  EXPECT_GT(check->objects[0].vertices, 1000u);
  EXPECT_EQ(check->objects[0].identities_change, 0u);
}

TEST(CheckAnimationTest, BigShapesAreCheckedCoarser) {
  const auto animation = Animate(Rising("method: \"surface\" epsilon: .002"));
  AnimationCheckOptions options;
  options.most_points = 3000;
  const Result<AnimationCheck> check = CheckAnimation(*animation, options);
  ASSERT_TRUE(check.ok()) << check.error().ToString();
  EXPECT_GT(check->objects[0].coarser, 1);
  EXPECT_LE(check->objects[0].vertices, 3000u);
}

// Steep, and the faster the finer the frames are cut, but no jump: 8 to 12 times the shape's step.
TEST(CheckAnimationTest, S25_SteepIsNotPopping) {
  const auto animation = Animate(
      Rising("method: \"surface\" epsilon: .05 H: .5 law: SIMILAR direction: UP variant: CURRENT "
             "increments: MIDPOINT"));
  const Result<AnimationCheck> check = CheckAnimation(*animation);
  ASSERT_TRUE(check.ok()) << check.error().ToString();
  EXPECT_TRUE(check->good) << check->objects[0].verdict;
  EXPECT_GT(check->objects[0].proportion, kStepProportion);
  EXPECT_THAT(check->objects[0].verdict, HasSubstr("times as far as the shape"));
}

// An animation whose frames are given, to plant what the engine itself does not do.
class Planted : public Animation {
 public:
  Planted(std::shared_ptr<const Animation> base, uint32_t frame,
          std::function<void(v1::FrameScene*)> fault)
      : base_(std::move(base)), frame_(frame), fault_(std::move(fault)) {}
  const v1::Scene& scene() const override { return base_->scene(); }
  uint32_t first_frame() const override { return base_->first_frame(); }
  uint32_t last_frame() const override { return base_->last_frame(); }
  Result<v1::FrameScene> Inbetween(uint32_t frame, AssetSet* assets) const override {
    Result<v1::FrameScene> scene = base_->Inbetween(frame, assets);
    if (scene && frame >= frame_) fault_(&*scene);
    return scene;
  }

 private:
  std::shared_ptr<const Animation> base_;
  uint32_t frame_;
  std::function<void(v1::FrameScene*)> fault_;
};

TEST(CheckAnimationTest, S25_VerticesThatComeOrGoAreFound) {
  const Planted planted(
      Animate(Rising("method: \"surface\" epsilon: .1")), 7, [](v1::FrameScene* scene) {
        scene->mutable_object(0)->mutable_fractal()->mutable_fineness()->set_epsilon(.05);
      });
  const Result<AnimationCheck> check = CheckAnimation(planted);
  ASSERT_TRUE(check.ok());
  EXPECT_FALSE(check->good);
  EXPECT_EQ(check->objects[0].verdict, "vertices come or go at frame 7");
}

TEST(CheckAnimationTest, S25_DetailThatJumpsIsFound) {
  // stretch wakes up with a rest pose that suddenly says the shape is far larger than at rest
  const Planted planted(
      Animate(Rising("method: \"surface\" split: LENGTH epsilon: .3 max_level: 2 amplitude: 1")), 7,
      [](v1::FrameScene* scene) {
        v1::FrameObject* object = scene->mutable_object(0);
        if (object->rest_size() == 0) *object->mutable_rest() = object->point();
        for (double& value : *object->mutable_rest()) value *= 1e-4;
      });
  const Result<AnimationCheck> check = CheckAnimation(planted);
  ASSERT_TRUE(check.ok()) << check.error().ToString();
  EXPECT_FALSE(check->good) << check->objects[0].proportion;
  EXPECT_THAT(check->objects[0].verdict, HasSubstr("a vertex pops between frames 6 and 7"));
}

TEST(CheckAnimationTest, CancelsBetweenFrames) {
  AnimationCheckOptions options;
  options.progress = [](uint32_t frame) { return frame < 3; };
  const auto animation = Animate(Rising("method: \"surface\" epsilon: .5"));
  EXPECT_EQ(CheckAnimation(*animation, options).error().code, ErrorCode::kCancelled);
}

TEST(CoarseTest, FacesAreCutByTheRestPose) {
  v1::FrameObject object;
  for (const double value : {0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.})
    object.add_point(value);
  object.add_face_size(4);
  for (const uint32_t vertex : {0u, 1u, 2u, 3u}) object.add_face_vertex(vertex);
  const Result<CoarseShape> shape = CoarseShapeOf(object, nullptr);
  ASSERT_TRUE(shape.ok());
  EXPECT_EQ(shape->triangles.size(), 2u);
  EXPECT_EQ(shape->rest, shape->now);
  object.set_face_vertex(3, 4);
  EXPECT_FALSE(CoarseShapeOf(object, nullptr).ok());
  object.set_face_vertex(3, 3);
  object.set_face_size(0, 3);
  EXPECT_FALSE(CoarseShapeOf(object, nullptr).ok());
  object.set_face_size(0, 4);
  object.add_rest(1);
  EXPECT_FALSE(CoarseShapeOf(object, nullptr).ok());
}

TEST(CoarseTest, C47_SettingsArriveAsTheSceneGivesThem) {
  const auto settings_of = [](const std::string& fractal) {
    const auto animation = Animate(Rising(fractal));
    auto settings = MethodSettingsOf(FrameOf(*animation, 3).object(0).fractal());
    EXPECT_TRUE(settings.ok());
    return JoinMidpoint(*settings, settings->own);
  };
  const FractalSettings settings = settings_of(
      "method: \"surface\" seed: 77 H: .31 sigma: 1.5 law: SIMILAR direction: EDGE variant: "
      "PERTURBED epsilon: .25 max_level: 9 uniforms: 5 perturb: .4 coast: true coast_H: .8");
  EXPECT_EQ(settings.method, "surface");
  EXPECT_EQ(settings.seed, 77u);
  EXPECT_EQ(settings.H, .31);
  EXPECT_EQ(settings.sigma, 1.5);
  EXPECT_EQ(settings.law, Law::kSimilar);
  EXPECT_EQ(settings.direction, Direction::kEdge);
  EXPECT_EQ(settings.variant, Variant::kPerturbed);
  EXPECT_EQ(settings.split, Split::kShot);
  EXPECT_EQ(settings.fineness.epsilon, .25);
  EXPECT_EQ(settings.max_level, 9u);
  EXPECT_EQ(settings.uniforms, 5u);
  EXPECT_EQ(settings.perturb, .4);
  EXPECT_TRUE(settings.coast);
  EXPECT_EQ(settings.coast_H, .8);
  EXPECT_EQ(settings_of("law: SHIH move: .3").move, .3);
  EXPECT_EQ(settings_of("amplitude: .2").amplitude, .2);
  EXPECT_FALSE(settings_of("stretch: false").stretch);
}

}  // namespace
}  // namespace fjord
