#include "engine/image/dither.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/image/picture.h"
#include "engine/image/srgb.h"

namespace fjord {
namespace {

std::vector<uint8_t> Dithered(uint32_t x, uint32_t y, const std::vector<float>& linear) {
  std::vector<uint8_t> codes(linear.size());
  EncodeDithered8(x, y, linear, codes);
  return codes;
}

// Every float that an entry of a table could begin or end at, and their neighbours.
std::vector<float> ManyFloats() {
  std::vector<float> many = {0,
                             -1,
                             1,
                             2,
                             1e-30f,
                             1e-4f,
                             -std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::infinity()};
  for (const float start : Srgb16Starts()) {
    many.push_back(start);
    many.push_back(std::nextafter(start, 0.f));
    many.push_back(std::nextafter(start, 2.f));
  }
  for (float x = 1e-5f; x < 1; x *= 1.0007f) many.push_back(x);
  while (many.size() % 3 != 0) many.push_back(.5f);
  return many;
}

TEST(DitherTest, CodesAreSixteenBitOnesWithTheOffsetAdded) {
  const std::vector<float> linear = ManyFloats();
  std::vector<uint16_t> exact(linear.size());
  EncodeSrgb16(linear, exact);
  for (uint32_t y = 0; y < 16; ++y) {
    const std::vector<uint8_t> codes = Dithered(70 * y, y, linear);
    for (uint32_t i = 0; i < linear.size(); ++i) {
      ASSERT_EQ(codes[i], (exact[i] + DitherOffset(70 * y + i / 3, y, i % 3)) / 257)
          << linear[i] << " row " << y;
    }
  }
}

TEST(DitherTest, WhatACodeStandsForStaysThatCode) {
  std::vector<float> linear;
  for (int code = 0; code < 256; ++code) linear.insert(linear.end(), 3, DecodeSrgb8(code));
  for (uint32_t y = 0; y < 16; ++y) {
    for (const uint32_t x : {0u, 64u, 128u, 1000u}) {
      const std::vector<uint8_t> codes = Dithered(x, y, linear);
      for (size_t i = 0; i < codes.size(); ++i) ASSERT_EQ(codes[i], i / 3) << x << ' ' << y;
    }
  }
}

TEST(DitherTest, EveryOffsetComesEquallyOften) {
  std::array<int, 16> seen{};
  for (uint32_t y = 0; y < 64; ++y) {
    for (uint32_t x = 0; x < 1024; ++x) {
      for (uint32_t c = 0; c < 3; ++c) {
        const uint32_t offset = DitherOffset(x, y, c);
        ASSERT_EQ(offset % 16, 8u);
        ++seen[offset / 16];
      }
    }
  }
  for (const int count : seen) EXPECT_EQ(count, 64 * 1024 * 3 / 16);
}

// The mean over a small area follows a gradient that plain codes show as bands.
TEST(DitherTest, GradientsHaveNoBands) {
  constexpr uint32_t kWidth = 96, kHeight = 160;
  double plain_error = 0, dithered_error = 0;
  std::vector<double> plain(kHeight), dithered(kHeight), exact(kHeight);
  for (uint32_t y = 0; y < kHeight; ++y) {
    const float value = .2f + .0001f * static_cast<float>(y);
    const std::vector<float> linear(size_t{kWidth} * 3, value);
    std::vector<uint16_t> fine(linear.size());
    EncodeSrgb16(linear, fine);
    std::vector<uint8_t> codes(linear.size());
    EncodeSrgb8(linear, codes);
    exact[y] = fine[0] / 257.;
    plain[y] = codes[0];
    for (const uint8_t code : Dithered(0, y, linear)) dithered[y] += code;
    dithered[y] /= kWidth * 3;
  }
  for (uint32_t y = 0; y + 16 <= kHeight; ++y) {
    double sums[3] = {};
    for (uint32_t j = y; j < y + 16; ++j) {
      sums[0] += exact[j] / 16;
      sums[1] += plain[j] / 16;
      sums[2] += dithered[j] / 16;
    }
    plain_error = std::max(plain_error, std::abs(sums[1] - sums[0]));
    dithered_error = std::max(dithered_error, std::abs(sums[2] - sums[0]));
  }
  EXPECT_GT(plain_error, .25);
  EXPECT_LT(dithered_error, .06);
}

TEST(DitherTest, PiecesOfARowAreThoseOfTheRow) {
  std::vector<float> linear;
  for (int i = 0; i < 600; ++i) linear.push_back(.1f + .0003f * static_cast<float>(i));
  const std::vector<uint8_t> whole = Dithered(0, 11, linear);
  for (const size_t cut : {1u, 17u, 64u, 130u}) {
    const std::vector<float> rest(linear.begin() + static_cast<std::ptrdiff_t>(3 * cut),
                                  linear.end());
    const std::vector<uint8_t> part = Dithered(static_cast<uint32_t>(cut), 11, rest);
    EXPECT_TRUE(
        std::equal(part.begin(), part.end(), whole.begin() + static_cast<std::ptrdiff_t>(3 * cut)))
        << cut;
  }
}

TEST(DitherDeathTest, NaNIsABrokenInvariant) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(Dithered(0, 0, std::vector<float>(3, std::numeric_limits<float>::quiet_NaN())),
               "NaN");
}

}  // namespace
}  // namespace fjord
