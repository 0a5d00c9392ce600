// Pictures for laying over others: what is covered, and that laying them over a colour gives what
// rendering before that colour gives.
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/image/srgb.h"
#include "tests/render/random_scenes.h"

namespace fjord {
namespace {

using Pixel = std::array<float, 4>;

Pixel PixelAt(const Picture& picture, size_t pixel) {
  Pixel value{0, 0, 0, 1};
  const size_t channels = picture.channels();
  std::memcpy(value.data(), &picture.bytes[pixel * channels * 4], channels * 4);
  return value;
}

// A plate over the left half of the picture, and up to a quarter of pixel 8.
v1::FrameScene Plate() {
  v1::FrameScene scene = FlatScene(16, 16);
  scene.mutable_output()->set_samples(16);
  Put(scene.mutable_background(), {.9, .1, .4, .9, .1, .4});
  AddObject(&scene, {{-8, -8, 0}, {.25, -8, 0}, {.25, 8, 0}, {-8, 8, 0}}, {{0, 1, 2, 3}},
            {.5f, .25f, 1});
  scene.mutable_output()->set_alpha(true);
  return scene;
}

TEST(AlphaTest, IsTheShareOfSamplesThatSeeSomething) {
  const Picture picture = Draw(Plate());
  ASSERT_TRUE(picture.alpha);
  ASSERT_EQ(picture.bytes.size(), 16u * 16 * 4 * 4);
  EXPECT_EQ(PixelAt(picture, 16 * 8 + 3), (Pixel{.5f, .25f, 1, 1}));
  EXPECT_EQ(PixelAt(picture, 16 * 8 + 8), (Pixel{.125f, .0625f, .25f, .25f})) << "associated";
  EXPECT_EQ(PixelAt(picture, 16 * 8 + 12), (Pixel{0, 0, 0, 0})) << "no sky";
}

TEST(AlphaTest, PngIsStraight) {
  v1::FrameScene scene = Plate();
  scene.mutable_output()->set_format(0);
  const Picture eight = Draw(scene);
  const auto code = [&](size_t pixel, size_t k) { return eight.bytes[4 * pixel + k]; };
  EXPECT_EQ(code(16 * 8 + 8, 3), 64) << "a quarter of 255, to nearest";
  for (size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(code(16 * 8 + 8, k), code(16 * 8 + 3, k)) << "the colour of what is covered";
    EXPECT_EQ(code(16 * 8 + 12, k), 0);
  }
  EXPECT_EQ(code(16 * 8 + 3, 3), 255);
  EXPECT_EQ(code(16 * 8 + 12, 3), 0);
  // Dither moves colours by a code at most, alpha not at all.
  scene.mutable_output()->set_dither(1);
  const Picture dithered = Draw(scene);
  for (size_t i = 0; i < dithered.bytes.size(); ++i) {
    EXPECT_LE(std::abs(dithered.bytes[i] - eight.bytes[i]), i % 4 == 3 ? 0 : 1) << i;
  }
  scene.mutable_output()->set_dither(0);
  scene.mutable_output()->set_format(1);
  const Picture sixteen = Draw(scene);
  uint16_t alpha = 0;
  std::memcpy(&alpha, &sixteen.bytes[2 * (4 * (16 * 8 + 8) + 3)], 2);
  EXPECT_EQ(alpha, 16384);
}

TEST(AlphaTest, SeaAndHazeCover) {
  v1::FrameScene scene = PerspectiveScene(16, 16, {0, 0, 2}, {0, 10, 2}, 60);
  scene.mutable_sea()->set_level(0);
  Put(scene.mutable_sea()->mutable_color(), {.02, .05, .08});
  Put(scene.mutable_haze()->mutable_color(), {1, 0, 0});
  scene.mutable_haze()->set_density(.3);
  scene.mutable_output()->set_alpha(true);
  const Picture picture = Draw(scene);
  EXPECT_EQ(PixelAt(picture, 16 * 14)[3], 1);
  EXPECT_GT(PixelAt(picture, 16 * 14)[0], .3) << "haze before the sea";
  EXPECT_EQ(PixelAt(picture, 16 * 2), (Pixel{0, 0, 0, 0})) << "none before the sky";
}

// The depth layer beside alpha is that of the picture without.
TEST(AlphaTest, DepthGoesBeside) {
  v1::FrameScene scene = Plate();
  scene.mutable_output()->add_layer(1);
  const Picture with = Draw(scene);
  scene.mutable_output()->set_alpha(false);
  const Picture without = Draw(scene);
  ASSERT_EQ(with.layers.size(), 1u);
  EXPECT_EQ(with.layers[0].samples, without.layers[0].samples);
  EXPECT_NE(PixelDigest(with), PixelDigest(without));
}

double Encoded(double linear) {
  return linear <= .0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - .055;
}

// As an 8-bit picture: over(straight picture, colour) against the picture before that colour.
void RequireEqualCodes(v1::FrameScene scene, double background) {
  scene.mutable_output()->set_format(0);
  scene.mutable_output()->set_alpha(true);
  const Picture over = Draw(scene);
  scene.mutable_output()->set_alpha(false);
  const Picture whole = Draw(scene);
  for (size_t i = 0; i < size_t{over.width} * over.height; ++i) {
    const double alpha = over.bytes[4 * i + 3] / 255.;
    for (size_t k = 0; k < 3; ++k) {
      const double color = DecodeSrgb8(over.bytes[4 * i + k]);
      const double laid = color * alpha + (1 - alpha) * background;
      // Half a code of colour, half a code of alpha between it and the background, half a code of
      // the whole picture; a bright sample beyond 1 is cut off before the average in the one only.
      const double near = DecodeSrgb8(whole.bytes[3 * i + k]);
      const double code = std::abs(Encoded(std::min(laid, 1.)) - Encoded(near)) * 255;
      const double linear = std::abs(laid - near);
      RC_ASSERT(code < 1.6 || linear < .75 / 255);
    }
  }
}

RC_GTEST_PROP(AlphaProperty, LaidOverAColourIsThePictureBeforeIt, ()) {
  v1::FrameScene scene = RandomScene();
  const double background = Between(0, 1);
  Put(scene.mutable_background(),
      {background, background, background, background, background, background});
  const Picture whole = Draw(scene);
  scene.mutable_output()->set_alpha(true);
  const Picture over = Draw(scene);
  for (size_t i = 0; i < size_t{over.width} * over.height; ++i) {
    const Pixel above = PixelAt(over, i), wanted = PixelAt(whole, i);
    RC_ASSERT(above[3] >= 0 && above[3] <= 1);
    for (size_t k = 0; k < 3; ++k) {
      const double laid = above[k] + (1 - above[3]) * background;
      RC_ASSERT(std::abs(laid - wanted[k]) < 2e-6);
    }
  }
  RequireEqualCodes(scene, background);
}

}  // namespace
}  // namespace fjord
