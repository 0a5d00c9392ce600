#include "engine/base/clamp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace fjord {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(ClampTest, SaturatesAndGivesZeroForNan) {
  EXPECT_EQ(ClampToInt32(3e9), std::numeric_limits<int32_t>::max());
  EXPECT_EQ(ClampToInt32(-kInfinity), std::numeric_limits<int32_t>::min());
  EXPECT_EQ(ClampToInt32(kNan), 0);
  EXPECT_EQ(ClampToInt64(1e19), std::numeric_limits<int64_t>::max());
  EXPECT_EQ(ClampToInt64(-1e19), std::numeric_limits<int64_t>::min());
  EXPECT_EQ(ClampToInt64(kNan), 0);
  EXPECT_EQ(FloorToInt32(-kInfinity), std::numeric_limits<int32_t>::min());
  EXPECT_EQ(FloorToInt64(kNan), 0);
  EXPECT_EQ(RoundToInt32(1e300), std::numeric_limits<int32_t>::max());
  EXPECT_EQ(RoundToInt32(2147483646.5), std::numeric_limits<int32_t>::max());
  EXPECT_EQ(RoundToInt64(kInfinity), std::numeric_limits<int64_t>::max());
  EXPECT_EQ(RoundToInt64(-kInfinity), std::numeric_limits<int64_t>::min());
}

TEST(ClampTest, FloatsStayFinite) {
  constexpr float kLargest = std::numeric_limits<float>::max();
  EXPECT_EQ(ClampToFloat(1e300), kLargest);
  EXPECT_EQ(ClampToFloat(-kInfinity), -kLargest);
  EXPECT_EQ(ClampToFloat(kNan), 0);
  EXPECT_EQ(ClampToFloat(double{kLargest}), kLargest);
  EXPECT_EQ(ClampToFloat(.1), .1f);
  EXPECT_EQ(ClampToFloat(-1e-50), 0);
}

TEST(ClampTest, RoundsAsItsNameSays) {
  EXPECT_EQ(ClampToInt32(-2.9), -2);
  EXPECT_EQ(FloorToInt32(-2.1), -3);
  EXPECT_EQ(FloorToInt32(-3.0), -3);
  EXPECT_EQ(FloorToInt64(2.9), 2);
  EXPECT_EQ(RoundToInt32(2.5), 3);
  EXPECT_EQ(RoundToInt32(-2.5), -2);
  EXPECT_EQ(RoundToInt32(.49999999999999994), 0);
  EXPECT_EQ(RoundToInt64(4503599627370495.5), 4503599627370496);
}

TEST(ClampTest, QuantisesIntoItsRange) {
  EXPECT_EQ(RoundToUint32(-1, 255), 0u);
  EXPECT_EQ(RoundToUint32(254.5, 255), 255u);
  EXPECT_EQ(RoundToUint32(300, 255), 255u);
  EXPECT_EQ(RoundToUint32(kNan, 255), 0u);
  EXPECT_EQ(RoundToUint32(1e30, 0xffffffffu), 0xffffffffu);
}

TEST(ClampTest, FloorEqualsTheLibrarys) {
  for (const double x : {0., -0., .5, -.5, 1e15 + .5, -1e15 - .5, 4503599627370495.5, 1e300, -1e300,
                         -4503599627370495.5, 5e-324, -5e-324}) {
    EXPECT_EQ(Floor(x), std::floor(x)) << x;
  }
}

}  // namespace
}  // namespace fjord
