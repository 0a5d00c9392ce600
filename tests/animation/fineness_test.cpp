#include "engine/animation/fineness.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "engine/animation/eye_bound.h"

namespace fjord {
namespace {

constexpr uint32_t kHeight = 540;

FinenessDemand Demand(const Vec3& eye, double pixels = 1) {
  v1::Camera camera;
  camera.mutable_eye()->set_x(eye.x);
  camera.mutable_eye()->set_y(eye.y);
  camera.mutable_eye()->set_z(eye.z);
  camera.mutable_up()->set_z(1);
  camera.set_fov(40);
  camera.set_view_height(6);
  camera.set_near(.01);
  FinenessDemand demand{CameraState(camera), ObjectTransform()};
  demand.pixels = pixels;
  return demand;
}

Box UnitBox() {
  Box box;
  box.Add(Vec3(-1));
  box.Add(Vec3(1));
  return box;
}

double EpsilonAt(const v1::FrameFineness& fineness, const Vec3& x) {
  if (fineness.focal() <= 0) return fineness.epsilon();
  const Vec3 eye(fineness.eye(0), fineness.eye(1), fineness.eye(2));
  return fineness.pixels() * std::max(fineness.near(), Length(x - eye) - fineness.eye_radius()) /
         fineness.focal();
}

TEST(FinenessTest, S15_APixelIsAPixelAtEveryDistance) {
  const FinenessDemand demand = Demand({0, -10, 0});
  const v1::FrameFineness fineness = WorkOutFineness({&demand, 1}, UnitBox(), kHeight);
  EXPECT_EQ(fineness.eye_radius(), 0);
  const double slope = std::tan(20 * 3.14159265358979 / 180);
  // a length at distance 9 that covers one of 540 lines
  EXPECT_NEAR(EpsilonAt(fineness, {0, -1, 0}), 9 * 2 * slope / kHeight, 1e-12);
  const FinenessDemand quarter = Demand({0, -10, 0}, .25);
  EXPECT_NEAR(EpsilonAt(WorkOutFineness({&quarter, 1}, UnitBox(), kHeight), {0, -1, 0}),
              .25 * 9 * 2 * slope / kHeight, 1e-12);
}

TEST(FinenessTest, OrthographicPixelsAreALength) {
  FinenessDemand demand = Demand({0, -10, 0});
  demand.camera.orthographic = true;
  const v1::FrameFineness fineness = WorkOutFineness({&demand, 1}, UnitBox(), kHeight);
  EXPECT_EQ(fineness.focal(), 0);
  EXPECT_EQ(fineness.epsilon(), 6. / kHeight);
}

TEST(FinenessTest, ScaledObjectsAreSplitByWhatIsSeen) {
  v1::Transform twice;
  for (auto* v : {twice.mutable_scale()}) {
    v->set_x(2);
    v->set_y(2);
    v->set_z(2);
  }
  FinenessDemand demand = Demand({0, -10, 0});
  demand.transform = ObjectTransform(twice);
  const v1::FrameFineness fineness = WorkOutFineness({&demand, 1}, UnitBox(), kHeight);
  // object point (0,-1,0) stands at y = -2, 8 away; its lengths are seen doubled
  const double slope = std::tan(20 * 3.14159265358979 / 180);
  EXPECT_NEAR(EpsilonAt(fineness, {0, -1, 0}), 8 * 2 * slope / kHeight / 2, 1e-12);
  demand.pixels = 0;
  demand.epsilon = .5;
  EXPECT_EQ(WorkOutFineness({&demand, 1}, UnitBox(), kHeight).epsilon(), .25);
}

TEST(FinenessTest, FramesWithoutSizeDoNotCount) {
  v1::Transform nothing;
  for (int i = 0; i < 1; ++i) {
    nothing.mutable_scale()->set_x(0);
    nothing.mutable_scale()->set_y(0);
    nothing.mutable_scale()->set_z(0);
  }
  std::vector<FinenessDemand> demands = {Demand({0, -1.01, 0}), Demand({0, -10, 0})};
  demands[0].transform = ObjectTransform(nothing);
  const v1::FrameFineness both = WorkOutFineness(demands, UnitBox(), kHeight);
  EXPECT_EQ(both.SerializeAsString(),
            WorkOutFineness({&demands[1], 1}, UnitBox(), kHeight).SerializeAsString());
  nothing.mutable_scale()->set_x(1);  // flattened in y and z: still a length
  demands[0].transform = ObjectTransform(nothing);
  EXPECT_GT(WorkOutFineness(demands, UnitBox(), kHeight).epsilon(), 0);
  v1::Transform gone;
  gone.mutable_scale()->set_x(0);
  gone.mutable_scale()->set_y(0);
  gone.mutable_scale()->set_z(0);
  demands[0].transform = demands[1].transform = ObjectTransform(gone);
  EXPECT_GT(WorkOutFineness(demands, UnitBox(), kHeight).epsilon(), 1e50);
}

TEST(FinenessTest, AFlightAwayKeepsTheNearestEyesFineness) {
  std::vector<FinenessDemand> demands;
  for (int i = 0; i < 40; ++i) demands.push_back(Demand({0, -5. - i, .4 * i}));
  const v1::FrameFineness fineness = WorkOutFineness(demands, UnitBox(), kHeight);
  ASSERT_GT(fineness.focal(), 0);
  EXPECT_LT(fineness.eye_radius(), .8) << "a ball round the whole flight would have 21";
}

TEST(FinenessTest, ATurntableIsNotMadeInfinitelyFine) {
  std::vector<FinenessDemand> demands;
  for (int i = 0; i < 72; ++i) {
    demands.push_back(Demand({6 * std::cos(i * .0872665), 6 * std::sin(i * .0872665), 1}));
  }
  const v1::FrameFineness fineness = WorkOutFineness(demands, UnitBox(), kHeight);
  const double nearest =
      EpsilonAt(WorkOutFineness({&demands[0], 1}, UnitBox(), kHeight), {1, 0, 0});
  EXPECT_GT(EpsilonAt(fineness, {0, 0, 0}), .7 * nearest);
}

TEST(EyeBoundTest, OneEyeStandsForAllUpToTheBoxesEdges) {
  // eyes close to the box, where the bound changes fast within a cell
  const std::vector<EyeBound> eyes = {
      {{1.3, 0, .2}, 0}, {{0, 1.4, 0}, .1}, {{-1.2, -1.3, .1}, 0}, {{1.05, 1.05, 1.05}, .02}};
  const Box box = UnitBox();
  for (const EyeBound& bound : BoundEyes(eyes, box, 8)) {
    double closest = 1e300;
    for (int i = 0; i <= 64; ++i) {
      for (int j = 0; j <= 64; ++j) {
        for (int k = 0; k <= 64; ++k) {
          const Vec3 x = box.low + Vec3(i, j, k) / 64. * box.Size();
          for (const EyeBound& eye : eyes) {
            const double spare =
                Length(x - eye.center) - eye.radius - (Length(x - bound.center) - bound.radius);
            ASSERT_GE(spare, 0) << i << " " << j << " " << k;
            closest = std::min(closest, spare);
          }
        }
      }
    }
    EXPECT_LT(closest, .3) << "and not much more than that";
  }
}

double Number(int low, int high) { return *rc::gen::inRange(low, high) * .1; }

RC_GTEST_PROP(FinenessProperty, Z1_NoFrameIsCoarserThanItAsksForAlone, ()) {
  Box box;
  box.Add({Number(-30, 0), Number(-30, 0), Number(-5, 1)});
  box.Add({Number(0, 30), Number(0, 30), Number(0, 10)});
  const int count = *rc::gen::inRange(1, 12);
  std::vector<FinenessDemand> demands;
  Vec3 eye(Number(-90, 90), Number(-90, 90), Number(1, 60));
  for (int i = 0; i < count; ++i) {
    demands.push_back(Demand(eye, *rc::gen::inRange(1, 8) * .25));
    v1::Transform transform;
    const double scale = *rc::gen::inRange(1, 20) * .1;
    transform.mutable_scale()->set_x(scale);
    transform.mutable_scale()->set_y(scale);
    transform.mutable_scale()->set_z(*rc::gen::arbitrary<bool>() ? scale : .7 * scale);
    transform.mutable_rotate()->set_z(Number(0, 3600));
    transform.mutable_translate()->set_x(Number(-20, 20));
    demands.back().transform = ObjectTransform(transform);
    eye += Vec3(Number(-9, 9), Number(-9, 9), Number(-1, 5));
  }
  const v1::FrameFineness whole = WorkOutFineness(demands, box, kHeight);
  for (int i = 0; i < 60; ++i) {
    const auto share = [] { return *rc::gen::inRange(0, 1001) * .001; };
    const Vec3 x = box.low + Vec3(share(), share(), share()) * box.Size();
    for (const FinenessDemand& demand : demands) {
      // what the frame itself sees: world lengths against world distance
      const double distance = Length(demand.transform.ToWorld(x) - demand.camera.eye);
      const double wanted = demand.pixels * std::max(demand.camera.near, distance) /
                            demand.camera.Focal(kHeight) / demand.transform.largest_scale();
      RC_ASSERT(EpsilonAt(whole, x) <= wanted * (1 + 1e-9));
    }
  }
}

}  // namespace
}  // namespace fjord
