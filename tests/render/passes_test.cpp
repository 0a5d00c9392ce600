// What the film's passes do beside light: sky and haze.
#include <cmath>
#include <limits>

#include "tests/render/scenes.h"

namespace fjord {
namespace {

TEST(PassesTest, DomeIsAFunctionOfTheDirectionOfSight) {
  constexpr double kSlope = .75;  // the middle of the picture looks up by 3 : 4
  v1::FrameScene scene = PerspectiveScene(9, 9, {0, 0, 5}, {0, 4, 5 + 4 * kSlope}, 40);
  Put(scene.mutable_background(), {.2, .4, .8, .8, .6, .4});
  scene.set_sky(1);
  const Rgb middle = At(Draw(scene), 4, 4);
  for (int k = 0; k < 3; ++k) {
    const double top = scene.background(k), bottom = scene.background(3 + k);
    EXPECT_NEAR(middle[k], bottom + (top - bottom) * .6, 1e-6) << k;
  }
  // Below the horizon it is the horizon's colour.
  Put(scene.mutable_camera()->mutable_look_at(), {0, 4, 0});
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(At(Draw(scene), 4, 4)[k], static_cast<float>(scene.background(3 + k)));
  }
  // A picture's gradient does not care where the camera looks.
  scene.set_sky(0);
  const std::string down = DigestOf(scene);
  Put(scene.mutable_camera()->mutable_look_at(), {0, 4, 8});
  EXPECT_EQ(DigestOf(scene), down);
}

TEST(PassesTest, SeaMeetsADomeWithoutALine) {
  v1::FrameScene scene = PerspectiveScene(16, 64, {0, 0, 2}, {0, 10, 2}, 60);
  Put(scene.mutable_background(), {.1, .2, .6, .8, .7, .6});
  scene.set_sky(1);
  scene.mutable_sea()->set_level(0);
  Put(scene.mutable_sea()->mutable_color(), {.02, .05, .08});
  const Picture picture = Draw(scene);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(At(picture, 8, 31)[k], At(picture, 8, 32)[k], .06);
}

TEST(PassesTest, HazeTakesItsShareOfTheWay) {
  for (const bool orthographic : {false, true}) {
    v1::FrameScene scene =
        orthographic ? FlatScene(16, 16) : PerspectiveScene(16, 16, {0, 0, 100}, {0, 0, 0}, 8);
    Put(scene.mutable_camera()->mutable_up(), {0, 1, 0});
    Put(scene.mutable_background(), {.3, .3, .3, .3, .3, .3});
    AddObject(&scene, {{-8, -8, 20}, {0, -8, 20}, {0, 8, 20}, {-8, 8, 20}}, {{0, 1, 2, 3}},
              {1, .5f, 0});
    const Picture clear = Draw(scene);
    Put(scene.mutable_haze()->mutable_color(), {.2, .4, 1});
    scene.mutable_haze()->set_density(.01);
    const Picture hazy = Draw(scene);
    const double left = std::exp(-.01 * 80);  // the picture is narrow: all ways are 80 long
    int land = 0;
    for (uint32_t x = 0; x < 16; ++x) {
      const Rgb before = At(clear, x, 8), after = At(hazy, x, 8);
      if (before == Rgb(.3f)) {
        EXPECT_EQ(after, before) << "the sky stays";
        continue;
      }
      ++land;
      EXPECT_NEAR(after.r, before.r * left + .2 * (1 - left), 2e-3);
      EXPECT_NEAR(after.b, before.b * left + 1 * (1 - left), 2e-3);
    }
    EXPECT_GE(land, 6);
  }
}

// The plate leans over the sea and leaves sky above: every kind of pixel.
TEST(PassesTest, TheDepthLayerIsTheDistanceOfTheNearestSample) {
  v1::FrameScene scene = PerspectiveScene(32, 32, {0, 0, 2}, {0, 10, 2}, 60);
  scene.mutable_output()->set_samples(4);
  scene.mutable_sea()->set_level(0);
  // Its near end stands at y = 4, its far end, on the right, at y = 8.
  AddObject(&scene, {{-1, 4, 1}, {2, 8, 1}, {2, 8, 3}, {-1, 4, 3}}, {{0, 1, 2, 3}}, Rgb(1));
  const std::string color = DigestOf(scene);
  scene.mutable_output()->add_layer(1);
  const Picture picture = Draw(scene);
  EXPECT_NE(PixelDigest(picture).Hex(), color);
  ASSERT_EQ(picture.layers.size(), 1u);
  EXPECT_EQ(picture.layers[0].name, "depth");
  const auto at = [&](uint32_t x, uint32_t y) { return picture.layers[0].samples[y * 32 + x]; };
  EXPECT_EQ(at(16, 0), std::numeric_limits<float>::infinity()) << "sky";
  const double pixel = 2 * std::tan(M_PI / 6) / 32;  // at distance 1
  for (const uint32_t y : {24u, 31u}) {
    // The pixel's samples see the sea nearer the lower they lie: the lowest is at 7/8 of it.
    const double down = (y + 224. / 256 - 16) * pixel;
    EXPECT_NEAR(at(1, y), 2 / down, 1e-4) << y;
  }
  for (const uint32_t x : {15u, 16u, 17u}) {
    // x = y (X - 16) pixel, y = 4 + (x + 1) 4 / 3; nearest where x is smallest: at 1/8 of the
    // pixel.
    const double across = (x + 32. / 256 - 16) * pixel;
    EXPECT_NEAR(at(x, 16), (16 / 3.) / (1 - across * 4 / 3), 1e-4) << x;
  }
  // The same for every tile.
  EXPECT_EQ(DigestOf(scene, {.threads = 2, .tile_size = 16}), PixelDigest(picture).Hex());
}

TEST(PassesTest, HazeAndDomeAreTheSameForEveryTile) {
  v1::FrameScene scene = PerspectiveScene(80, 60, {0, -4, 1.5}, {0, 0, .4}, 50);
  scene.mutable_output()->set_samples(4);
  Put(scene.mutable_background(), {.1, .2, .6, .8, .7, .6});
  scene.set_sky(1);
  Put(scene.mutable_haze()->mutable_color(), {.8, .7, .6});
  scene.mutable_haze()->set_density(.2);
  scene.mutable_sea()->set_level(0);
  AddObject(&scene, {{-2, -1, -.1}, {2, -1, .3}, {0, 3, 1.2}}, {{0, 1, 2}}, {.3f, .6f, .2f});
  AddSun(&scene, {1, -1, 1}, Rgb(1));
  const std::string wanted = DigestOf(scene);
  EXPECT_EQ(DigestOf(scene, {.threads = 2, .tile_size = 16}), wanted);
  EXPECT_EQ(DigestOf(scene, {.threads = 1, .tile_size = 48}), wanted);
}

}  // namespace
}  // namespace fjord
