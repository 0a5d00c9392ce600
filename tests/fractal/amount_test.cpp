#include "engine/fractal/amount.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random.h"

namespace fjord {
namespace {

TEST(AmountTest, S6_LevelDeviationsFollowTheFormula) {
  for (const double H : {.1, .3, .5, .7, .9}) {
    for (int n = 1; n <= 12; ++n) {
      const double variance =
          2.25 / std::pow(std::pow(2.0, n), 2 * H) * (1 - std::pow(2, 2 * H - 2));
      EXPECT_NEAR(std::pow(LevelDeviation(1.5, H, n), 2) / variance, 1, 1e-12);
    }
  }
  EXPECT_NEAR(std::pow(LevelDeviation(1, .5, 4), 2), 1 / std::pow(2, 5), 1e-15);
}

TEST(AmountTest, S6_AffineConstantIsTheFirstLevelOfAUnitEdge) {
  for (const double H : {0., .2, .5, .8, 1.}) {
    EXPECT_NEAR(AffineConstant(H), LevelDeviation(1, H, 1), 1e-15);
  }
  EXPECT_EQ(AffineConstant(1), 0);
}

TEST(AmountTest, S14_HistoricEqualsItsFormula) {
  for (const double H : {.3, .7}) {
    for (int i = 0; i < 16; ++i) {
      const double delta =
          .5 * std::pow(2, -i * H) * std::sqrt(.5) * std::sqrt(1 - std::pow(2, 2 * H - 2));
      EXPECT_NEAR(ShihDeviation(.5, H, i) / delta, 1, 1e-12);
    }
  }
}

// The defining sum, estimated from the very draws that vertices use.
TEST(AmountTest, S14_SimilarFactorSolvesItsEquation) {
  for (const double H : {.1, .3, .5, .7, .9}) {
    for (const int uniforms : {1, 2, 4, 5, 12, 16}) {
      const Result<double> r = SimilarFactor(H, uniforms);
      ASSERT_TRUE(r.ok());
      double sum = 0;
      constexpr int kDraws = 200000;
      for (int i = 0; i < kDraws; ++i) {
        const double g =
            std::abs(Gaussian(CoarseIdentity(7, static_cast<uint64_t>(i)).lo, uniforms));
        const double offset = std::min(*r * g, kSimilarClamp);
        sum += std::pow(.25 + offset * offset, (2 - H) / 2);
      }
      EXPECT_NEAR(2 * sum / kDraws, 1, .003) << H << " " << uniforms;
    }
  }
}

TEST(AmountTest, S14_SimilarFactorFallsAsHGrows) {
  double last = 1e9;
  for (double H = .06; H < 1; H += .02) {
    const Result<double> r = SimilarFactor(H, 4);
    ASSERT_TRUE(r.ok()) << H;
    EXPECT_LT(*r, last);
    last = *r;
  }
  EXPECT_EQ(*SimilarFactor(1, 4), 0);
}

// Never smoother than asked, and the knob turns over its whole range.
TEST(AmountTest, S14_HeldBackHIsRougherAndTurnsAllTheWay) {
  EXPECT_EQ(HeldBackH(1), 1);
  EXPECT_EQ(HeldBackH(.06), .06);
  double last = 0;
  for (double H = .06; H <= 1; H += .02) {
    EXPECT_LE(HeldBackH(H), H);
    EXPECT_GT(HeldBackH(H), last);
    EXPECT_TRUE(SimilarFactor(HeldBackH(H), 4).ok());
    last = HeldBackH(H);
  }
}

TEST(AmountTest, S14_SimilarFactorRefusesWhatTheClampForbids) {
  EXPECT_FALSE(SimilarFactor(.03, 4).ok());
  EXPECT_FALSE(SimilarFactor(-1, 4).ok());
  EXPECT_FALSE(SimilarFactor(std::nan(""), 4).ok());
  EXPECT_TRUE(SimilarFactor(.06, 1).ok());
  EXPECT_TRUE(SimilarFactor(.06, 16).ok());
}

}  // namespace
}  // namespace fjord
