#include "engine/image/alpha.h"

#include <cstring>

#include "engine/image/dither.h"
#include "engine/image/picture.h"
#include "engine/image/srgb.h"
#include "gtest/gtest.h"

namespace fjord {
namespace {

TEST(AlphaTest, StraightColoursAreThoseOfTheCoveredPart) {
  const std::vector<float> pixels = {.25f, .125f, 0, .25f, 0, 0, 0, 0, .5f, .5f, 1, 1};
  std::vector<float> straight;
  ToStraight(pixels, &straight);
  EXPECT_EQ(straight, (std::vector<float>{1, .5f, 0, .25f, 0, 0, 0, 0, .5f, .5f, 1, 1}));
}

TEST(AlphaTest, CodesAreTheNearest) {
  for (uint32_t i = 0; i <= 1000; ++i) {
    const float alpha = static_cast<float>(i) / 1000;
    const std::vector<float> pixel = {0, 0, 0, alpha};
    std::vector<uint8_t> eight = {7, 7, 7, 0};
    EncodeAlpha8(pixel, eight);
    EXPECT_LE(std::abs(alpha * 255 - eight[3]), .5001) << alpha;
    EXPECT_EQ(eight[0], 7) << "colours stay";
    std::vector<uint16_t> sixteen(4);
    EncodeAlpha16(pixel, sixteen);
    EXPECT_LE(std::abs(alpha * 65535 - sixteen[3]), .51) << alpha;
  }
  const std::vector<float> beyond = {0, 0, 0, 1.5f, 0, 0, 0, -1};
  std::vector<uint8_t> codes(8);
  EncodeAlpha8(beyond, codes);
  EXPECT_EQ(codes[3], 255);
  EXPECT_EQ(codes[7], 0);
}

TEST(AlphaTest, ExrKeepsAssociatedColoursPngStraightOnes) {
  const std::vector<float> pixel = {.25f, .125f, 0, .25f};
  const Picture exr = Quantise(1, 1, PixelFormat::kExrFloat, pixel, Channels::kRgba);
  ASSERT_EQ(exr.bytes.size(), 16u);
  EXPECT_EQ(std::memcmp(exr.bytes.data(), pixel.data(), 16), 0);
  const Picture png = Quantise(1, 1, PixelFormat::kPng8, pixel, Channels::kRgba);
  std::vector<uint8_t> wanted(3);
  EncodeSrgb8(std::vector<float>{1, .5f, 0}, wanted);
  wanted.push_back(64);
  EXPECT_EQ(png.bytes, wanted);
}

TEST(AlphaTest, TheDigestSaysFourChannels) {
  const std::vector<float> pixel = {.25f, .125f, 0, .25f};
  const Picture png = Quantise(1, 1, PixelFormat::kPng8, pixel, Channels::kRgba);
  Sha256 sha;
  sha.Update("fjord-pixels 1 1 1 4 uint8\n");
  sha.Update(png.bytes);
  EXPECT_EQ(PixelDigest(png), sha.Finish());
}

// Colours are dithered as those of opaque pictures are, and the fourth code is nobody's business.
TEST(AlphaTest, DitherPassesOverIt) {
  std::vector<float> rgb, rgba;
  for (int i = 0; i < 100; ++i) {
    for (int k = 0; k < 3; ++k) rgb.push_back(static_cast<float>(3 * i + k) / 300);
    rgba.insert(rgba.end(), rgb.end() - 3, rgb.end());
    rgba.push_back(.5f);
  }
  std::vector<uint8_t> three(300), four(400, 99);
  EncodeDithered8(17, 5, rgb, three);
  EncodeDithered8(17, 5, rgba, four, 4);
  for (size_t i = 0; i < 100; ++i) {
    for (size_t k = 0; k < 3; ++k) EXPECT_EQ(four[4 * i + k], three[3 * i + k]);
    EXPECT_EQ(four[4 * i + 3], 99);
  }
}

}  // namespace
}  // namespace fjord
