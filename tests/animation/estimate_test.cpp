// What is estimated against what is made.
#include "engine/animation/estimate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/animation/coarse.h"
#include "tests/animation/animate.h"

namespace fjord {
namespace {

using testing::Animate;
using testing::FrameOf;
using ::testing::HasSubstr;

// The estimate is never less than this share of what is made, and at most so many times as much.
constexpr double kLeast = .95;
constexpr double kMost = 3;

class CountingSink : public StreamSink {
 public:
  bool Wants(const Vec3&, const Vec3&, const Vec3&, const StreamReach&) override { return true; }
  void Take(const StreamBatch& batch) override {
    leaves += batch.triangles.size() + batch.segments.size();
  }
  uint64_t leaves = 0;
};

double MadeOf(const v1::FrameObject& object) {
  const auto prepared = PrepareFractal(object);
  EXPECT_TRUE(prepared.ok()) << (prepared.ok() ? "" : prepared.error().message);
  CountingSink sink;
  for (size_t root = 0; prepared.ok() && root < (*prepared)->RootCount(); ++root) {
    (*prepared)->Stream(root, sink, 512);
  }
  return static_cast<double>(sink.leaves);
}

const char kCamera[] = "camera { eye { x: .3 y: -2.5 z: .9 } look_at {} near: .01 }\n";
const char kOutput[] = "output { width: 320 height: 180 }\n";

std::string Object(const std::string& shape, const std::string& fractal) {
  return std::string(kOutput) + kCamera + "objects { name: \"a\" shape { " + shape +
         " } fractal { " + fractal + " } }\n";
}

const char* const kMeshes[] = {
    "primitive { kind: GRID segments: 3 rings: 2 }",
    "primitive { kind: GRID segments: 1 rings: 40 }",
    "primitive { kind: SPHERE }",
    "primitive { kind: TORUS segments: 7 }",
    "primitive { kind: BOX size { x: 2 y: 1 z: .2 } }",
    "mesh { point {} point { x: 1 } point { x: 2 y: .01 } face { v: 1 v: 2 v: 3 } }",
};
const char* const kCurves[] = {
    "polyline { point {} point { x: 1 } point { x: 1 y: 1 } closed: true }",
    "polyline { point { x: -3 } point { x: .02 } point { x: 1 y: 2 z: .4 } }",
};

struct Tally {
  int compared = 0;
  double least = 1e300;
  double most = 0;
};

void Compare(const std::string& text, Tally* tally) {
  const auto animation = Animate(text);
  ASSERT_NE(animation, nullptr);
  AssetSet assets;
  const v1::FrameScene frame = FrameOf(*animation, 1, &assets);
  const auto estimate = EstimateFrame(frame, &assets);
  ASSERT_TRUE(estimate.ok());
  const double made = MadeOf(frame.object(0));
  ASSERT_GT(made, 0);
  const double share = estimate->all.leaves / made;
  EXPECT_GE(share, kLeast) << text << made << " made";
  EXPECT_LE(share, kMost) << text << made << " made";
  EXPECT_LE(estimate->all.in_view, estimate->all.leaves * (1 + 1e-12));
  tally->least = std::min(tally->least, share);
  tally->most = std::max(tally->most, share);
  ++tally->compared;
}

TEST(EstimateTest, LeavesOfMeshesAreEstimatedWithinAFactorOfThree) {
  Tally tally;
  for (const char* const mesh : kMeshes) {
    for (const char* const fineness :
         {"epsilon: .3", "epsilon: .02", "epsilon: .0071", "pixels: 2", "pixels: .7", "viewing: 2",
          "epsilon: .001 max_level: 5", "max_level: 0"}) {
      Compare(Object(mesh, fineness), &tally);
    }
    Compare(Object(mesh, "method: \"coast\" epsilon: .003"), &tally);
    Compare(Object(mesh, "method: \"surface\" coast: true pixels: 1"), &tally);
  }
  EXPECT_EQ(tally.compared, 60);
  std::printf("estimates lie between %.3g and %.3g times what is made\n", tally.least, tally.most);
}

// A median of a triangle without area is never long enough to be done with it.
TEST(EstimateTest, TrianglesWithoutAreaHaveAnEstimateToo) {
  const auto animation = Animate(
      Object("mesh { point {} point { x: 3 } point { x: 1 } point { y: 1 } face { v: [1, 2, 3] } "
             "face { v: [1, 2, 4] } }",
             "method: \"surface\" epsilon: .05"));
  ASSERT_NE(animation, nullptr);
  AssetSet assets;
  const v1::FrameScene frame = FrameOf(*animation, 1, &assets);
  const auto estimate = EstimateFrame(frame, &assets);
  ASSERT_TRUE(estimate.ok());
  const double made = MadeOf(frame.object(0));
  EXPECT_GT(made, 1000);
  EXPECT_GT(estimate->all.leaves, .5 * made);
  EXPECT_LT(estimate->all.leaves, 4 * made);
}

TEST(EstimateTest, SegmentsOfCurvesAreEstimatedWithinAFactorOfThree) {
  Tally tally;
  for (const char* const curve : kCurves) {
    for (const char* const fineness :
         {"epsilon: .3", "epsilon: .0003", "pixels: 1", "viewing: 3", "max_level: 9",
          "epsilon: .003 split: LENGTH", "law: AFFINE H: .4 epsilon: .01 split: LENGTH"}) {
      Compare(Object(curve, fineness), &tally);
    }
  }
  EXPECT_EQ(tally.compared, 14);
}

// Close to a large plain: far parts are coarse, near ones fine, and most of it is behind the
// camera.
TEST(EstimateTest, APlainSeenFromJustAboveItIsEstimatedPieceByPiece) {
  Tally tally;
  for (const char* const eye : {"z: .3", "z: .01", "x: 20 z: 2"}) {
    Compare(std::string(kOutput) + "camera { eye { " + eye +
                " } look_at { y: 30 } near: .01 }\nobjects { name: \"a\" shape { primitive { kind: "
                "GRID size { x: 60 y: 60 } } } fractal { pixels: 3 } }\n",
            &tally);
  }
  EXPECT_EQ(tally.compared, 3);
}

TEST(EstimateTest, WhatThePictureDoesNotShowIsNotCountedAsInView) {
  const auto in_view = [](const std::string& camera) {
    const auto animation = Animate(std::string(kOutput) + camera +
                                   "objects { name: \"a\" shape { primitive { kind: GRID } } "
                                   "fractal { epsilon: 1e-6 amplitude: 1e-4 } }\n");
    return EstimateFrame(FrameOf(*animation, 1), nullptr)->all.in_view;
  };
  const auto window = [&](const std::string& height) {
    return in_view(
        "camera { eye { z: 9 } look_at { x: .011 y: .013 } up { y: 1 } projection: "
        "ORTHOGRAPHIC view_height: " +
        height + " }\n");
  };
  // a window a hundredth as high shows a ten-thousandth, with some more around it
  EXPECT_LT(window(".005"), window(".5") / 500);
  EXPECT_GT(window(".005"), window(".5") / 20'000);
  EXPECT_LT(in_view("camera { eye { z: 9 } look_at { z: 10 } up { y: 1 } near: .01 }\n"), 1)
      << "looking away";
}

struct Held {
  OverBudget over;
  bool ok = false;
};

Held Hold(const std::string& text, double budget, Counted counted = Counted::kInView) {
  Held held;
  const auto animation = Animate(text);
  if (animation == nullptr) return held;
  AssetSet assets;
  const v1::FrameScene frame = FrameOf(*animation, 1, &assets);
  held.ok = HoldAgainstBudget(frame, &assets, animation->scene(), budget, counted,
                              "--budget lifts it", &held.over)
                .ok();
  return held;
}

TEST(BudgetTest, WhatAsksForTooMuchIsToldWhichKnobAndWhatWouldFit) {
  const char kGrid[] = "primitive { kind: GRID }";
  const Held held = Hold(Object(kGrid, "epsilon: 1e-9 max_level: 40"), kFrameBudget);
  EXPECT_TRUE(held.ok);
  EXPECT_EQ(held.over.knob, "epsilon");
  EXPECT_THAT(held.over.message, HasSubstr("epsilon 1e-09 would make about "));
  EXPECT_THAT(held.over.message, HasSubstr(" triangles in a frame; the budget is 2e09; "));
  EXPECT_THAT(held.over.message, HasSubstr(" would fit; --budget lifts it"));
  // and it does
  const size_t at = held.over.message.find("2e09; ") + 6;
  const std::string value = held.over.message.substr(at, held.over.message.find(" would fit") - at);
  EXPECT_EQ(Hold(Object(kGrid, "max_level: 40 epsilon: " + value), kFrameBudget).over.message, "");
  EXPECT_EQ(Hold(Object(kGrid, "epsilon: 1e-9 max_level: 40"), kNoBudget).over.message, "");
  const Held least = Hold(Object(kGrid, "epsilon: 1e-300 max_level: 40"), kFrameBudget);
  EXPECT_EQ(least.over.knob, "epsilon");
}

TEST(BudgetTest, EveryKnobIsNamedWithAValueThatFits) {
  for (const std::string knob : {"epsilon", "pixels", "viewing"}) {
    const auto text = [&](const std::string& value) {
      return Object("polyline { point {} point { x: 1 } point { x: 1 y: 1 } }",
                    knob + ": " + value + " max_level: 40");
    };
    const Held held = Hold(text(knob == "viewing" ? "1e6" : "1e-6"), 10'000, Counted::kWhole);
    EXPECT_EQ(held.over.knob, knob);
    EXPECT_THAT(held.over.message, HasSubstr(" segments in a frame; the budget is 10000; "));
    const size_t at = held.over.message.find("10000; ") + 7;
    const std::string value =
        held.over.message.substr(at, held.over.message.find(" would fit") - at);
    EXPECT_EQ(Hold(text(value), 10'000, Counted::kWhole).over.message, "") << value;
  }
}

TEST(BudgetTest, AShapeThatIsTooLargeAsItIsIsNamed) {
  const Held held = Hold(std::string(kOutput) + kCamera +
                             "objects { name: \"a\" shape { primitive { kind: GRID segments: 100 "
                             "rings: 100 } } }",
                         1'000);
  EXPECT_EQ(held.over.knob, "");
  EXPECT_THAT(held.over.message, HasSubstr("its shape alone has 20000 triangles in a frame"));
}

}  // namespace
}  // namespace fjord
