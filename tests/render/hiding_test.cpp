// What is hidden is not made, and nothing else is left out (S7).
#include <random>

#include "engine/render/screen_bound.h"
#include "tests/render/scenes.h"

namespace fjord {
namespace {

// A rough plate, seen from above; before it, smaller or larger, a smooth one.
v1::FrameScene PlateBefore(double half, double height) {
  v1::FrameScene scene = PerspectiveScene(96, 64, Vec3(0, -.01, 3), Vec3(0, 0, 0));
  v1::FrameObject* rough =
      AddObject(&scene, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2, 3}}, Rgb(1));
  MakeRough(rough, .01, .05);
  if (half > 0) {
    AddObject(&scene,
              {{-half, -half, height},
               {half, -half, height},
               {half, half, height},
               {-half, half, height}},
              {{0, 1, 2, 3}}, Rgb(.5f));
    // Objects are drawn in their order: the plate first.
    scene.mutable_object()->SwapElements(0, 1);
  }
  AddSun(&scene, Vec3(1, 1, 2), Rgb(1));
  return scene;
}

TEST(HidingTest, S7_WhatLiesBehindIsNotMade) {
  const auto made = [](const v1::FrameScene& scene) {
    const Result<RenderedFrame> frame = RenderFrame(scene, {.threads = 1, .patch_size = 256});
    EXPECT_TRUE(frame.ok());
    return frame->stats.triangles;
  };
  const uint64_t alone = made(PlateBefore(0, 0));
  EXPECT_LT(made(PlateBefore(1.2, .5)), alone / 100) << "all of it is hidden";
  EXPECT_LT(made(PlateBefore(.6, .5)), alone * 4 / 5) << "the middle is hidden";
  EXPECT_GE(made(PlateBefore(1.2, -.5)), alone) << "nothing is hidden";
}

TEST(HidingTest, S7_WhatLiesUnderTheSeaIsNotMade) {
  v1::FrameScene scene = PlateBefore(0, 0);
  const Result<RenderedFrame> dry = RenderFrame(scene, {.threads = 1, .patch_size = 256});
  v1::FrameSea* sea = scene.mutable_sea();
  sea->set_level(.5);
  Put(sea->mutable_color(), {.1, .2, .3});
  const Result<RenderedFrame> wet = RenderFrame(scene, {.threads = 1, .patch_size = 256});
  ASSERT_TRUE(dry.ok() && wet.ok());
  EXPECT_LT(wet->stats.triangles, dry->stats.triangles / 100);
}

// Whatever a displaced point does, it stays within its bound.
TEST(HidingTest, S7_PointsStayWithinTheirScreenBound) {
  std::mt19937_64 draw(3);
  const auto number = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(draw() >> 11) * 0x1p-53;
  };
  const auto point = [&](double size) {
    return Vec3(number(-size, size), number(-size, size), number(-size, size));
  };
  int bounded = 0;
  double tightest = 1e9;
  for (int round = 0; round < 4000; ++round) {
    Camera camera;
    camera.eye = point(4);
    camera.look_at = point(1);
    camera.orthographic = round % 3 == 0;
    camera.view_height = 3;
    const View view = MakeView(camera, 640, 480);
    const Projection to = MakeProjection(view, kNoTransform);
    const Vec3 middle = point(1);
    const Vec3 corner[3] = {middle + point(.3), middle + point(.3), middle + point(.3)};
    StreamReach reach(number(0, .1));
    reach.along = number(0, .2);
    for (Vec3& way : reach.way) way = Unit(Vec3(0, 0, 1) + point(.2));
    const std::optional<ScreenBound> bound =
        BoundOnScreen(to, corner[0], corner[1], corner[2], reach);
    if (!bound) continue;
    ++bounded;
    for (int i = 0; i < 20; ++i) {
      // Corners of triangle, cone and ball are where it is closest.
      const Vec3 p = corner[draw() % 3] +
                     reach.way[draw() % 3] * (draw() % 2 == 0 ? reach.along : -reach.along) +
                     Unit(point(1)) * reach.around;
      const ScreenPoint seen = ToScreen(to, ToClip(to, p));
      ASSERT_LE(bound->left, seen.x);
      ASSERT_GE(bound->right, seen.x);
      ASSERT_LE(bound->top, seen.y);
      ASSERT_GE(bound->bottom, seen.y);
      ASSERT_GE(bound->depth, seen.depth);
      tightest = std::min(tightest, (bound->right - seen.x) / (bound->right - bound->left));
    }
  }
  EXPECT_GT(bounded, 2000);
  EXPECT_LT(tightest, .02) << "a bound that is never met would hide nothing";
}

}  // namespace
}  // namespace fjord
