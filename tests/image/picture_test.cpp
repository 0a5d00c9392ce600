#include "engine/image/picture.h"

#include <bit>
#include <cmath>
#include <limits>

#include "engine/image/half.h"
#include "engine/image/srgb.h"
#include "gtest/gtest.h"

namespace fjord {
namespace {

// The curve by libm: good enough to check against away from the thresholds.
double Encode(double linear) {
  return linear <= .0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - .055;
}

TEST(SrgbTest, CodesAreTheNearestToTheCurve) {
  std::vector<float> linear;
  for (int i = -20; i <= 200000; ++i) linear.push_back(static_cast<float>(i / 190000.));
  for (float v = 1e-9f; v < 1; v *= 1.001f) linear.push_back(v);
  std::vector<uint8_t> codes(linear.size());
  std::vector<uint16_t> wide(linear.size());
  EncodeSrgb8(linear, codes);
  EncodeSrgb16(linear, wide);
  for (size_t i = 0; i < linear.size(); ++i) {
    const double e = Encode(std::min(std::max<double>(linear[i], 0), 1.));
    EXPECT_NEAR(codes[i], e * 255, .5001) << linear[i];
    EXPECT_NEAR(wide[i], e * 65535, .52) << linear[i];
  }
}

TEST(SrgbTest, EveryCodeComesBack) {
  for (uint32_t k = 0; k < 65536; ++k) {
    const float linear = DecodeSrgb16(static_cast<uint16_t>(k));
    uint16_t code = 0;
    EncodeSrgb16({&linear, 1}, {&code, 1});
    ASSERT_EQ(code, k);
    if (k > 255) continue;
    const float linear8 = DecodeSrgb8(static_cast<uint8_t>(k));
    uint8_t code8 = 0;
    EncodeSrgb8({&linear8, 1}, {&code8, 1});
    ASSERT_EQ(code8, k);
  }
}

TEST(SrgbTest, ExtremesSaturate) {
  const float values[] = {-std::numeric_limits<float>::infinity(), -0.f, 1e-40f, 1.f, 7.f,
                          std::numeric_limits<float>::infinity()};
  uint8_t codes[6];
  EncodeSrgb8(values, codes);
  EXPECT_EQ(std::vector<uint8_t>(codes, codes + 6), (std::vector<uint8_t>{0, 0, 0, 255, 255, 255}));
}

TEST(HalfTest, EveryHalfComesBack) {
  for (uint32_t h = 0; h < 65536; ++h) {
    const bool nan = (h & 0x7c00) == 0x7c00 && (h & 0x3ff) != 0;
    if (nan) continue;
    ASSERT_EQ(FloatToHalf(HalfToFloat(static_cast<uint16_t>(h))), h);
  }
}

TEST(HalfTest, RoundsToNearestEven) {
  for (uint32_t h = 0; h < 0x7bff; ++h) {
    const float low = HalfToFloat(static_cast<uint16_t>(h));
    const float high = HalfToFloat(static_cast<uint16_t>(h + 1));
    const float middle = low + (high - low) / 2;
    ASSERT_EQ(FloatToHalf(middle), h % 2 == 0 ? h : h + 1) << h;
    ASSERT_EQ(FloatToHalf(std::nextafter(middle, 0.f)), h);
    ASSERT_EQ(FloatToHalf(std::nextafter(middle, 1e9f)), h + 1);
    ASSERT_EQ(FloatToHalf(-low), h | 0x8000);
  }
  EXPECT_EQ(FloatToHalf(65519.f), 0x7bff);
  EXPECT_EQ(FloatToHalf(65520.f), 0x7c00);
  EXPECT_EQ(FloatToHalf(std::numeric_limits<float>::quiet_NaN()), 0x7e00);
}

std::string DigestHex(PixelFormat format) {
  const std::vector<float> linear = {0, .5f, 1, -0.f, 2, .001f};
  return PixelDigest(Quantise(2, 1, format, linear)).Hex();
}

TEST(PictureTest, DigestsHaveKnownValues) {
  // SHA-256 of the header line and the samples written out by hand, big-endian.
  const auto by_hand = [](const std::string& type, const std::string& samples) {
    return Sha256Of("fjord-pixels 1 2 1 3 " + type + "\n" + samples).Hex();
  };
  const auto bytes = [](std::initializer_list<int> values) {
    std::string s;
    for (const int v : values) s += static_cast<char>(v);
    return s;
  };
  EXPECT_EQ(DigestHex(PixelFormat::kPng8), by_hand("uint8", bytes({0, 188, 255, 0, 255, 3})));
  // .5 -> 48192 (0xbc40), .001 -> 847 (0x034f)
  EXPECT_EQ(DigestHex(PixelFormat::kPng16),
            by_hand("uint16", bytes({0, 0, 0xbc, 0x40, 0xff, 0xff, 0, 0, 0xff, 0xff, 3, 0x4f})));
  EXPECT_EQ(DigestHex(PixelFormat::kExrHalf),
            by_hand("half", bytes({0, 0, 0x38, 0, 0x3c, 0, 0, 0, 0x40, 0, 0x14, 0x19})));
  EXPECT_EQ(DigestHex(PixelFormat::kExrFloat),
            by_hand("float", bytes({0, 0, 0, 0, 0x3f, 0, 0, 0, 0x3f, 0x80, 0,    0,
                                    0, 0, 0, 0, 0x40, 0, 0, 0, 0x3a, 0x83, 0x12, 0x6f})));
}

TEST(PictureTest, SizeAndTypeAreInTheDigest) {
  const std::vector<float> linear(12, .25f);
  const Picture wide = Quantise(4, 1, PixelFormat::kPng8, linear);
  const Picture tall = Quantise(1, 4, PixelFormat::kPng8, linear);
  EXPECT_EQ(wide.bytes, tall.bytes);
  EXPECT_NE(PixelDigest(wide), PixelDigest(tall));
}

TEST(PictureDeathTest, NaNIsABrokenInvariant) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const std::vector<float> linear(3, std::numeric_limits<float>::quiet_NaN());
  EXPECT_DEATH(Quantise(1, 1, PixelFormat::kPng8, linear), "NaN");
  EXPECT_DEATH(Quantise(1, 1, PixelFormat::kExrHalf, linear), "NaN");
}

}  // namespace
}  // namespace fjord
