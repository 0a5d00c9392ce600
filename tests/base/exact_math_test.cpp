// Errors against MPFR, in units in the last place, over the stated ranges; the largest seen over
// millions of arguments in brackets:
//   Sin, Cos 1.1 (1.07), Exp2 1.4 (1.33), Log2 .6 (.57), Atan2 1.6 (1.47),
//   Pow 4.5 for |y log2 x| < 100 (4.3), 2.2 for |y log2 x| < 20.
#include "engine/base/exact_math.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "engine/base/random.h"
#include "tests/base/mpfr_check.h"

namespace fjord {
namespace {

using testing::Real;
using testing::UlpError;

constexpr uint64_t kArguments = 200'000;

double Unit(uint64_t i, uint64_t channel) {
  return static_cast<double>(DrawBits(Mix64(i + 1), channel) >> 11) * 0x1p-53;
}

double Between(double a, double b, uint64_t i, uint64_t channel = 1) {
  return a + (b - a) * Unit(i, channel);
}

using OneArgument = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
using TwoArguments = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

double Error(double got, OneArgument truth, double x) {
  Real value(x);
  truth(value.get(), value.get(), MPFR_RNDN);
  return UlpError(got, value);
}

double Error(double got, TwoArguments truth, double x, double y) {
  Real a(x);
  Real b(y);
  truth(a.get(), a.get(), b.get(), MPFR_RNDN);
  return UlpError(got, a);
}

TEST(ExactMathTest, Exp2) {
  for (uint64_t i = 0; i < kArguments; ++i) {
    const double x = i % 2 == 0 ? Between(-1074, 1023.99, i) : Between(-2, 2, i);
    ASSERT_LT(Error(exact::Exp2(x), mpfr_exp2, x), 1.4) << x;
  }
  for (int k = -1074; k <= 1023; ++k) EXPECT_EQ(exact::Exp2(k), std::ldexp(1, k));
  EXPECT_EQ(exact::Exp2(-1074.5), 0);
  EXPECT_EQ(exact::Exp2(-1e300), 0);
  EXPECT_EQ(exact::Exp2(1023.995), std::numeric_limits<double>::max());
  EXPECT_EQ(exact::Exp2(1e300), std::numeric_limits<double>::max());
}

TEST(ExactMathTest, Log2) {
  for (uint64_t i = 0; i < kArguments; ++i) {
    const double anywhere = std::bit_cast<double>(0x0010000000000000u +
                                                  DrawBits(Mix64(i + 1), 1) % 0x7fe0000000000000u);
    const double x = i % 2 == 0 ? anywhere : Between(.5, 2, i);
    ASSERT_LT(Error(exact::Log2(x), mpfr_log2, x), .6) << x;
  }
  for (int k = -1022; k <= 1023; ++k) EXPECT_EQ(exact::Log2(std::ldexp(1, k)), k);
  for (const double x : {0., -0., -1., 5e-324, 0x0.fffffffffffffp-1022, -1e300}) {
    EXPECT_EQ(exact::Log2(x), -1075) << x;
  }
}

// Never a step back next to whole numbers and powers of two. (At k + 1/2, where Exp2's reduction
// changes over, neighbours may step back by one unit.)
TEST(ExactMathTest, Exp2AndLog2RiseWithTheirArgument) {
  constexpr int kSteps = 2000;
  for (int k = -60; k <= 60; ++k) {
    double x = k;
    double power = std::ldexp(1, k);
    for (int i = 0; i < kSteps; ++i) {
      x = std::nextafter(x, -1e9);
      power = std::nextafter(power, 0);
    }
    double last = exact::Exp2(x);
    double last_log = exact::Log2(power);
    for (int i = 0; i < 2 * kSteps; ++i) {
      x = std::nextafter(x, 1e9);
      power = std::nextafter(power, 1e300);
      const double now = exact::Exp2(x);
      const double log = exact::Log2(power);
      ASSERT_GE(now, last) << x;
      ASSERT_GE(log, last_log) << power;
      last = now;
      last_log = log;
    }
  }
}

TEST(ExactMathTest, Pow) {
  for (uint64_t i = 0; i < kArguments; ++i) {
    const double x = i % 2 == 0 ? exact::Exp2(Between(-50, 50, i)) : Between(.5, 2, i);
    const double log = std::fabs(exact::Log2(x)) + 1e-3;
    const double wide = Between(-99, 99, i, 2) / log;
    ASSERT_LT(Error(exact::Pow(x, wide), mpfr_pow, x, wide), 4.5) << x << ' ' << wide;
    const double usual = Between(-19, 19, i, 3) / log;
    ASSERT_LT(Error(exact::Pow(x, usual), mpfr_pow, x, usual), 2.2) << x << ' ' << usual;
  }
}

TEST(ExactMathTest, PowAtItsLimits) {
  constexpr double kMost = std::numeric_limits<double>::max();
  EXPECT_EQ(exact::Pow(0, 0), 1);
  EXPECT_EQ(exact::Pow(0, .5), 0);
  EXPECT_EQ(exact::Pow(0, -1), 0);
  EXPECT_EQ(exact::Pow(5, 0), 1);
  EXPECT_EQ(exact::Pow(1, 1e300), 1);
  EXPECT_EQ(exact::Pow(2, 10), 1024);
  EXPECT_EQ(exact::Pow(4, .5), 2);
  EXPECT_EQ(exact::Pow(3, 1e300), kMost);
  EXPECT_EQ(exact::Pow(3, -1e300), 0);
  EXPECT_EQ(exact::Pow(.5, 1e300), 0);
  EXPECT_EQ(exact::Pow(kMost, 1), kMost);
  EXPECT_EQ(exact::Pow(0x1.0000000000001p0, 1e300), kMost);
}

TEST(ExactMathTest, SinAndCos) {
  for (uint64_t i = 0; i < kArguments; ++i) {
    const double x = i % 2 == 0 ? Between(-1e6, 1e6, i) : Between(-4, 4, i);
    ASSERT_LT(Error(exact::Sin(x), mpfr_sin, x), 1.1) << x;
    ASSERT_LT(Error(exact::Cos(x), mpfr_cos, x), 1.1) << x;
  }
  EXPECT_EQ(exact::Sin(0), 0);
  EXPECT_EQ(exact::Cos(0), 1);
  EXPECT_EQ(exact::Sin(1.0000001e6), 0);
  EXPECT_EQ(exact::Cos(-1e300), 0);
}

// The worst of the reduction: doubles next to multiples of a quarter turn.
TEST(ExactMathTest, SinAndCosNextToQuarterTurns) {
  for (int k = 1; k < 636'619; k += 7) {
    const double x = k * (exact::kPi / 2);
    ASSERT_LT(Error(exact::Sin(x), mpfr_sin, x), 1.1) << x;
    ASSERT_LT(Error(exact::Cos(x), mpfr_cos, x), 1.1) << x;
  }
}

TEST(ExactMathTest, Atan2) {
  for (uint64_t i = 0; i < kArguments; ++i) {
    const double y = Between(-1, 1, i, 1);
    const double stretch = i % 2 == 0 ? 1 : exact::Exp2(Between(-40, 40, i, 3));
    const double x = Between(-1, 1, i, 2) * stretch;
    ASSERT_LT(Error(exact::Atan2(y, x), mpfr_atan2, y, x), 1.6) << y << ' ' << x;
  }
  EXPECT_EQ(exact::Atan2(0, 0), 0);
  EXPECT_EQ(exact::Atan2(0, 1), 0);
  EXPECT_EQ(exact::Atan2(0, -1), exact::kPi);
  EXPECT_EQ(exact::Atan2(1, 0), exact::kPi / 2);
  EXPECT_EQ(exact::Atan2(-1, 0), -exact::kPi / 2);
  EXPECT_EQ(exact::Atan2(1e308, 1e308), exact::kPi / 4);
  EXPECT_EQ(exact::Atan2(-5e-324, -5e-324), -3 * (exact::kPi / 4));
}

}  // namespace
}  // namespace fjord
