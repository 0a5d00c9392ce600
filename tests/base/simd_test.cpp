#include "engine/base/simd.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "engine/base/exact_math.h"
#include "engine/base/random.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/base/simd_test.cpp"
#include "hwy/foreach_target.h"
// After it: exact_math-inl.h is compiled once per target.
#include "engine/base/exact_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {
namespace {

// out[7 * i ..]: Exp2 x, Log2 x, Pow(x, y), PowOfNormal(x, y), Sin x, Cos x, Atan2(y, x).
void AllFunctions(const double* x, const double* y, size_t count, double* out) {
  const hn::ScalableTag<double> d;
  const size_t lanes = hn::Lanes(d);
  std::vector<double> part(lanes);
  for (size_t i = 0; i < count; i += lanes) {
    const auto vx = hn::LoadU(d, x + i);
    const auto vy = hn::LoadU(d, y + i);
    const auto store = [&](size_t row, hn::Vec<decltype(d)> v) HWY_ATTR {
      hn::StoreU(v, d, part.data());
      for (size_t lane = 0; lane < lanes; ++lane) out[7 * (i + lane) + row] = part[lane];
    };
    store(0, Exp2(d, vx));
    store(1, Log2(d, vx));
    store(2, Pow(d, hn::Abs(vx), vy));
    store(3, PowOfNormal(d, hn::Abs(vx), vy));
    store(4, Sin(d, vx));
    store(5, Cos(d, vx));
    store(6, Atan2(d, vy, vx));
  }
}

int64_t Target() { return HWY_TARGET; }

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fjord {
namespace {

HWY_EXPORT(AllFunctions);
HWY_EXPORT(Target);

class SimdTest : public ::testing::Test {
 protected:
  void TearDown() override { ASSERT_TRUE(SetSimdLevel("best")); }
};

TEST_F(SimdTest, EveryLevelRuns) {
  const std::vector<std::string> levels = SimdLevels();
  ASSERT_FALSE(levels.empty());
  EXPECT_EQ(levels.front(), "scalar");
  for (const std::string& level : levels) {
    ASSERT_TRUE(SetSimdLevel(level));
    EXPECT_EQ(SimdLevel(), level);
    std::string name = hwy::TargetName(HWY_DYNAMIC_DISPATCH(Target)());
    for (char& c : name) c = static_cast<char>(std::tolower(c));
    EXPECT_EQ(name, level);
  }
  ASSERT_TRUE(SetSimdLevel("best"));
  EXPECT_EQ(SimdLevel(), levels.back());
  EXPECT_FALSE(SetSimdLevel("mmx"));
}

TEST_F(SimdTest, EveryLevelGivesTheScalarBits) {
  constexpr size_t kCount = 1 << 16;
  std::vector<double> x(kCount);
  std::vector<double> y(kCount);
  for (uint64_t i = 0; i < kCount; ++i) {
    // Every bit pattern but NaN and infinity, and the ranges that matter.
    const auto unit = [&](uint64_t channel) {
      return static_cast<double>(DrawBits(Mix64(i + 1), channel) >> 11) * 0x1p-53;
    };
    x[i] = i % 4 == 0 ? std::bit_cast<double>(DrawBits(Mix64(i + 1), 1) & 0xffdfffffffffffffu)
                      : (i % 4 == 1 ? 2100 * unit(1) - 1080 : 4 * unit(1) - 2);
    y[i] = i % 8 == 0 ? std::bit_cast<double>(DrawBits(Mix64(i + 1), 2) & 0xffdfffffffffffffu)
                      : 8 * unit(2) - 4;
  }
  const double special[] = {0.,  -0.,  1.,    -1.,      2.,       .5,      5e-324, 0x1p-1022,
                            1e6, -1e6, 1e300, -1074.25, 1023.995, -1022.5, 1e-300, 0x1p1023};
  for (size_t i = 0; i < 256; ++i) {
    x[i] = special[i / 16];
    y[i] = special[i % 16];
  }
  std::vector<double> truth(7 * kCount);
  for (size_t i = 0; i < kCount; ++i) {
    const double ax = x[i] < 0 || std::signbit(x[i]) ? -x[i] : x[i];
    const double row[7] = {exact::Exp2(x[i]),       exact::Log2(x[i]), exact::Pow(ax, y[i]),
                           exact::Pow(ax, y[i]),    exact::Sin(x[i]),  exact::Cos(x[i]),
                           exact::Atan2(y[i], x[i])};
    std::copy(row, row + 7, &truth[7 * i]);
  }
  for (const std::string& level : SimdLevels()) {
    ASSERT_TRUE(SetSimdLevel(level));
    std::vector<double> got(7 * kCount);
    HWY_DYNAMIC_DISPATCH(AllFunctions)(x.data(), y.data(), kCount, got.data());
    size_t differ = 0;
    for (size_t i = 0; i < got.size(); ++i) {
      if (i % 7 == 3) {  // stated for normal x and a normal result
        const bool stated = std::isnormal(x[i / 7]) && truth[i] >= 0x1p-1021 && truth[i] < 0x1p1023;
        if (!stated) continue;
      }
      if (std::bit_cast<uint64_t>(got[i]) != std::bit_cast<uint64_t>(truth[i]) && differ++ < 5) {
        ADD_FAILURE() << level << " function " << i % 7 << " at " << x[i / 7] << ", " << y[i / 7]
                      << ": " << got[i] << " for " << truth[i];
      }
    }
    EXPECT_EQ(differ, 0u) << level;
  }
}

TEST(SimdLevelTest, NamesAreExact) {
  EXPECT_FALSE(SetSimdLevel(""));
  EXPECT_FALSE(SetSimdLevel("AVX2"));
}

}  // namespace
}  // namespace fjord
#endif
