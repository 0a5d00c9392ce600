#include "engine/base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "engine/base/digest.h"

namespace fjord {
namespace {

// From an independent program (Python, big integers). Frozen: pictures rest on them.
TEST(RandomTest, S24_KnownAnswers) {
  EXPECT_EQ(Mix64(0), 0u);
  EXPECT_EQ(Mix64(1), 0x4179b061e0c0e0d0u);
  EXPECT_EQ(Mix64(0x0123456789abcdefu), 0x3efdea49c590f4ecu);
  EXPECT_EQ(CoarseIdentity(0, 0), (Identity{0x5fe9b868a5ea9466u, 0x78aabe8929c3527du}));
  EXPECT_EQ(CoarseIdentity(7, 41), (Identity{0x714da2217ae987ceu, 0x2ea75858a3bb652fu}));
  EXPECT_EQ(MidpointIdentity({1, 2}, {3, 5}), (Identity{0x7675c2ab9b4a82fcu, 0x4da7714a63442190u}));
  EXPECT_EQ(DrawBits(99, 0), 99u);
  EXPECT_EQ(DrawBits(99, 3), 0x20b6c10d863c0ba2u);
}

TEST(RandomTest, S24_MidpointIsSymmetricAndDependsOnBothEnds) {
  const Identity a = CoarseIdentity(5, 1);
  const Identity b = CoarseIdentity(5, 2);
  const Identity c = CoarseIdentity(5, 3);
  EXPECT_EQ(MidpointIdentity(a, b), MidpointIdentity(b, a));
  EXPECT_NE(MidpointIdentity(a, b), MidpointIdentity(a, c));
  EXPECT_NE(CoarseIdentity(5, 1), CoarseIdentity(6, 1));
}

// Raw small numbers would collide here (1 + 4 = 2 + 3): coarse identities are mixed first.
TEST(RandomTest, S24_TwoMillionMidpointsAreDistinct) {
  std::vector<Identity> all;
  all.reserve(2'100'000);
  for (uint64_t i = 0; i < 64; ++i) all.push_back(CoarseIdentity(1, i));
  // Every pair of the first 64, then edges between newer and older vertices, each edge once.
  for (size_t i = 0; i < 64; ++i) {
    for (size_t j = i + 1; j < 64; ++j) all.push_back(MidpointIdentity(all[i], all[j]));
  }
  for (size_t next = 256; all.size() < 2'000'000; ++next) {
    const Identity a = all[next];
    all.push_back(MidpointIdentity(a, all[next - 64]));
    all.push_back(MidpointIdentity(a, all[next - 129]));
  }
  const size_t count = all.size();
  std::sort(all.begin(), all.end());
  EXPECT_EQ(std::unique(all.begin(), all.end()) - all.begin(), static_cast<ptrdiff_t>(count));
}

class GaussianTest : public ::testing::TestWithParam<int> {};

TEST_P(GaussianTest, S7_MeanDeviationAndBound) {
  const int n = GetParam();
  const double bound = GaussianBound(n);
  EXPECT_NEAR(bound, std::sqrt(3.0 * n), 2e-4);
  double sum = 0;
  double squares = 0;
  double largest = 0;
  constexpr int kDraws = 1'000'000;
  for (uint64_t i = 0; i < kDraws; ++i) {
    const double g = Gaussian(Mix64(i + 1), n);
    sum += g;
    squares += g * g;
    largest = std::max(largest, std::fabs(g));
  }
  const double mean = sum / kDraws;
  EXPECT_NEAR(mean, 0, .01);
  EXPECT_NEAR(std::sqrt(squares / kDraws - mean * mean), 1, .01);
  EXPECT_LE(largest, bound);
  EXPECT_GT(largest, std::min(.95 * bound, 4.0));
}

INSTANTIATE_TEST_SUITE_P(Uniforms, GaussianTest, ::testing::Values(1, 2, 3, 4, 8, 12, 16));

TEST(RandomTest, S7_ExtremesAreReachedAndTheScaleIsExact) {
  EXPECT_EQ(Gaussian(0, 4), -GaussianBound(4));
  EXPECT_EQ(Gaussian(~uint64_t{0}, 4), GaussianBound(4));
  // Every value of one uniform: deviation 1 to rounding.
  double squares = 0;
  for (uint64_t u = 0; u < 65536; ++u) squares += Gaussian(u, 1) * Gaussian(u, 1);
  EXPECT_NEAR(squares / 65536, 1, 1e-12);
}

TEST(RandomTest, S7_GoldenDigestOfDraws) {
  for (const auto& [n, golden] :
       {std::pair<int, const char*>{
            4, "7291737021d37b91cee65878fa492b30453e240dde2cb716c622d2f0b85a4575"},
        {12, "10ec7d0a694e992df35bf8ec147f6259af0ed3ecf65ea9272ba168233f61e044"}}) {
    Sha256 sha;
    for (uint64_t i = 0; i < 100'000; ++i) {
      const auto bits = std::bit_cast<uint64_t>(Gaussian(Mix64(i + 1), n));
      uint8_t bytes[8];
      for (int b = 0; b < 8; ++b) bytes[b] = static_cast<uint8_t>(bits >> (56 - 8 * b));
      sha.Update(bytes);
    }
    EXPECT_EQ(sha.Finish().Hex(), golden) << n;
  }
}

TEST(RandomTest, S12_TangentDrawFillsItsRange) {
  double least = 1;
  double most = -1;
  double sum = 0;
  for (uint64_t i = 0; i < 100'000; ++i) {
    const double t = TangentDraw(Mix64(i + 1));
    least = std::min(least, t);
    most = std::max(most, t);
    sum += t;
  }
  EXPECT_GE(least, -.5);
  EXPECT_LE(most, .5);
  EXPECT_LT(least, -.45);
  EXPECT_GT(most, .45);
  EXPECT_NEAR(sum / 100'000, 0, .002);
}

TEST(RandomTest, ChannelsAreIndependent) {
  // each by itself: two correlations of opposite sign would hide each other in a sum
  double other_draw = 0, tangent = 0, tangent_size = 0;
  for (uint64_t i = 0; i < 100'000; ++i) {
    const uint64_t id = Mix64(i + 1);
    const double gaussian = Gaussian(id, 4);
    other_draw += gaussian * Gaussian(DrawBits(id, 5), 4);
    tangent += gaussian * TangentDraw(id);
    tangent_size += TangentDraw(id) * TangentDraw(id);
  }
  // four deviations of a mean of 100,000 products of unit deviation
  constexpr double kFour = 4 / 316.2;
  EXPECT_NEAR(other_draw / 100'000, 0, kFour);
  EXPECT_NEAR(tangent / 100'000, 0, kFour * std::sqrt(tangent_size / 100'000));
  EXPECT_GT(tangent_size, 1'000);
}

TEST(RandomDeathTest, TooManyUniforms) { EXPECT_DEATH(GaussianScale(17), "17"); }

}  // namespace
}  // namespace fjord
