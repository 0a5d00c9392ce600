// Texture stages alone: what each does to a sample, and what it says that it reads.
#include <gtest/gtest.h>

#include "engine/base/random.h"
#include "engine/texture/registry.h"
#include "engine/texture/value_noise.h"

namespace fjord {
namespace {

TextureChain Chain(std::string_view name, const std::vector<NamedValue>& values = {}) {
  const StageInfo* info = FindTextureStage(name);
  EXPECT_NE(info, nullptr) << name;
  std::vector<KnobDefect> defects;
  TextureChain chain;
  AppendStage(*info, info->knobs.Read(values, name, &defects), &chain);
  EXPECT_TRUE(defects.empty());
  return chain;
}

Rgb ColorAt(const TextureChain& chain, const SurfaceSample& sample, double time = 0) {
  SurfaceSample one = sample;
  chain.ApplyColor({&one, 1}, time);
  return one.color;
}

TEST(StageTest, EveryStageOfTheRegistryLeavesAlmostAllOfASampleAlone) {
  int seen = 0;
  for (const StageInfo& info : TextureStages()) {
    ++seen;
    TextureChain chain;
    AppendStage(info, info.knobs.defaults(), &chain);
    EXPECT_FALSE(chain.empty());
    SurfaceSample before;
    before.position = {.1, .2, .3};
    before.rest = {.7, .1, .4};
    before.normal = {0, 0, 1};
    before.tangent = {1, 0, 0};
    before.u = .3;
    before.v = .6;
    SurfaceSample after = before;
    chain.ApplyGeometric({&after, 1}, 5);
    const bool colors = info.kind == StageKind::kColor;
    EXPECT_TRUE(!colors || after.normal == before.normal) << info.name;
    EXPECT_EQ(after.color, before.color) << info.name << ": colours change with light, not before";
    chain.ApplyColor({&after, 1}, 5);
    EXPECT_EQ(after.position, before.position) << info.name;
    EXPECT_EQ(after.rest, before.rest) << info.name;
    EXPECT_EQ(after.u, before.u) << info.name;
  }
  EXPECT_GE(seen, 2);
}

TEST(StageTest, CheckerAlternatesOverUv) {
  const TextureChain chain = Chain("checker", {{"across", {.numbers = {4}}},
                                               {"down", {.numbers = {2}}},
                                               {"color", {.numbers = {0, 0, 1}}}});
  EXPECT_TRUE(chain.reads().uv);
  EXPECT_FALSE(chain.reads().time);
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 4; ++column) {
      SurfaceSample sample;
      sample.u = (column + .5) / 4;
      sample.v = (row + .5) / 2;
      const Rgb wanted = (row + column) % 2 == 1 ? Rgb(0, 0, 1) : Rgb(1);
      EXPECT_EQ(ColorAt(chain, sample), wanted) << row << ' ' << column;
    }
  }
}

TEST(StageTest, NoiseReadsTheRestPoseAlone) {
  const TextureChain chain = Chain("noise");
  EXPECT_TRUE(chain.reads().rest);
  EXPECT_FALSE(chain.reads().time) << "nothing drifts: the time must not part frame keys";
  SurfaceSample sample;
  sample.rest = {.31, -.2, .77};
  const Rgb color = ColorAt(chain, sample);
  sample.position = {9, 9, 9};
  sample.u = .9;
  EXPECT_EQ(ColorAt(chain, sample, 100), color);
  sample.rest.x += .2;
  EXPECT_NE(ColorAt(chain, sample), color);
}

TEST(StageTest, NoiseDriftsWithTheTime) {
  const TextureChain chain = Chain("noise", {{"drift", {.numbers = {.01, 0, 0}}}});
  EXPECT_TRUE(chain.reads().time);
  SurfaceSample sample, moved;
  sample.rest = {.31, -.2, .77};
  moved.rest = sample.rest + Vec3(.01, 0, 0) * 8.;
  EXPECT_NE(ColorAt(chain, sample, 8), ColorAt(chain, sample, 0));
  const Rgb a = ColorAt(chain, sample, 0), b = ColorAt(chain, moved, 8);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-6);
}

TEST(StageTest, ValueNoiseIsSmoothBoundedAndSpread) {
  double least = 1, most = -1, sum = 0, square = 0;
  constexpr int kPlaces = 20000;
  for (uint64_t i = 0; i < kPlaces; ++i) {
    const auto draw = [i](uint64_t channel) {
      return static_cast<double>(DrawBits(Mix64(i + 1), channel + 1) >> 11) * 0x1p-53 * 60 - 30;
    };
    const Vec3 place(draw(0), draw(1), draw(2));
    const double value = ValueNoise(place, 7);
    least = std::min(least, value);
    most = std::max(most, value);
    sum += value;
    square += value * value;
    constexpr double kStep = 1e-6;
    const double next = ValueNoise(place + Vec3(kStep, -kStep, kStep), 7);
    EXPECT_LT(next - value < 0 ? value - next : next - value, 12 * kStep) << "a jump";
  }
  EXPECT_GE(least, -1);
  EXPECT_LE(most, 1);
  EXPECT_NEAR(sum / kPlaces, 0, .03);
  EXPECT_GT(square / kPlaces, .05);
  EXPECT_LT(square / kPlaces, .2);
  // At the lattice it is the lattice's own value from all sides.
  for (const double side : {-1e-9, 0., 1e-9}) {
    EXPECT_NEAR(ValueNoise(Vec3(3 + side, -2, 5), 7), ValueNoise(Vec3(3, -2, 5), 7), 1e-12);
  }
  EXPECT_NE(ValueNoise(Vec3(.5), 7), ValueNoise(Vec3(.5), 8));
}

TEST(StageTest, OctavesAddDetailWithinTheSameBounds) {
  const Vec3 place(.3, .4, .5);
  EXPECT_EQ(NoiseSum(place, 3, 1, .5), ValueNoise(place, Mix64(3)));
  for (uint64_t i = 0; i < 2000; ++i) {
    const auto at = static_cast<double>(i);
    const double value = NoiseSum(Vec3(at * .37, at * .11, -at * .23), 3, 8, .7);
    EXPECT_GE(value, -1);
    EXPECT_LE(value, 1);
  }
  // Gain 0: the first octave alone.
  EXPECT_EQ(NoiseSum(place, 3, 5, 0), NoiseSum(place, 3, 1, .5));
}

}  // namespace
}  // namespace fjord
