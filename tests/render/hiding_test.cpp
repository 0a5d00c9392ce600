// What is hidden is not made, and nothing else is left out (S7).
#include <algorithm>
#include <random>

#include "engine/render/screen_bound.h"
#include "engine/render/tile_buffer.h"
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

// An upright stroke of 41 points, `x` pixels right of the middle.
v1::FrameObject* AddStroke(v1::FrameScene* scene, double x, double top, double width) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 40; ++i) points.emplace_back(x, top - i * top / 20, 0);
  v1::FrameObject* line = AddObject(scene, points, {}, Rgb(1, 0, 0));
  line->set_curve(true);
  line->mutable_material()->set_line_width(width);
  return line;
}

// A stroke reaches beyond the tile in which its line lies: there it is not hidden, whoever asks.
TEST(HidingTest, D4_StrokesReachIntoTheNextTile) {
  v1::FrameScene scene = FlatScene(1920, 48);
  AddStroke(&scene, -710, 20, 40);
  for (const int threads : {1, 2, 3, 8}) {
    const Picture picture = Draw(scene, {.threads = threads});
    for (uint32_t x = 220; x < 280; ++x) {
      const float wanted = x >= 230 && x < 270 ? 1 : 0;
      ASSERT_EQ(At(picture, x, 24).r, wanted) << "pixel " << x << ", threads " << threads;
    }
  }
}

// A line behind a narrow plate: its stroke shows on both sides.
TEST(HidingTest, S7_WideStrokesShowBesideWhatHidesTheirLine) {
  v1::FrameScene scene = FlatScene(256, 64);
  AddObject(&scene, {{-30, -50, 10}, {30, -50, 10}, {30, 50, 10}, {-30, 50, 10}}, {{0, 1, 2, 3}},
            Rgb(0, 1, 0));
  AddStroke(&scene, 25, 25, 80);
  const Picture picture = Draw(scene, {.threads = 1});
  for (uint32_t x = 0; x < 256; ++x) {
    const bool plate = x >= 98 && x < 158, stroke = x >= 113 && x < 193;
    const Rgb wanted = plate ? Rgb(0, 1, 0) : stroke ? Rgb(1, 0, 0) : Rgb(0);
    ASSERT_EQ(At(picture, x, 32), wanted) << "pixel " << x;
  }
}

// Of what lies outside a tile nothing is known.
TEST(HidingTest, NothingIsHiddenOutsideTheTile) {
  TileBuffer tile;
  tile.Reset({32, 16, 16, 16}, 4, nullptr);
  std::fill_n(tile.depth(), 16 * 16 * 4, 1.);
  EXPECT_TRUE(tile.Hides(30, 10, 50, 40, .5));
  EXPECT_TRUE(tile.Hides(47, 31, 90, 90, .5));
  EXPECT_FALSE(tile.Hides(30, 10, 50, 40, 1.));
  EXPECT_FALSE(tile.Hides(10, 20, 31, 24, .5)) << "left";
  EXPECT_FALSE(tile.Hides(48, 20, 60, 24, .5)) << "right";
  EXPECT_FALSE(tile.Hides(40, 0, 44, 15, .5)) << "above";
  EXPECT_FALSE(tile.Hides(40, 32, 44, 40, .5)) << "below";
}

// Tiles far from a short stroke work with its corners too.
TEST(HidingTest, D3_StrokesFarFromATileAreHarmless) {
  v1::FrameScene scene = FlatScene(8192, 16);
  scene.mutable_output()->set_samples(4);
  AddObject(&scene, {{-4090, 0, 0}, {-4080, 3, 0}, {4080, 0, 0}, {4090, 3, 0}}, {}, Rgb(1))
      ->set_curve(true);
  const std::string wanted = DigestOf(scene, {.threads = 1, .tile_size = 4096});
  EXPECT_EQ(DigestOf(scene, {.threads = 1, .tile_size = 16}), wanted);
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
    const double spread = round % 2 == 0 ? 0 : 7;
    const std::optional<ScreenBound> bound =
        BoundOnScreen(to, corner[0], corner[1], corner[2], reach, spread);
    if (!bound) continue;
    ++bounded;
    for (int i = 0; i < 20; ++i) {
      // Corners of triangle, cone and ball are where it is closest.
      const Vec3 p = corner[draw() % 3] +
                     reach.way[draw() % 3] * (draw() % 2 == 0 ? reach.along : -reach.along) +
                     Unit(point(1)) * reach.around;
      const ScreenPoint seen = ToScreen(to, ToClip(to, p));
      ASSERT_LE(bound->left, seen.x - spread * kFixedOne);
      ASSERT_GE(bound->right, seen.x + spread * kFixedOne);
      ASSERT_LE(bound->top, seen.y - spread * kFixedOne);
      ASSERT_GE(bound->bottom, seen.y + spread * kFixedOne);
      ASSERT_GE(bound->depth, seen.depth);
      tightest = std::min(tightest, (bound->right - seen.x) / (bound->right - bound->left));
    }
  }
  EXPECT_GT(bounded, 2000);
  EXPECT_LT(tightest, .02) << "a bound that is never met would hide nothing";
}

}  // namespace
}  // namespace fjord
