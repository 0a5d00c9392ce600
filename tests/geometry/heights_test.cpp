// Samples by index, and their ranges over any rectangle.
#include "engine/geometry/heights.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/random.h"

namespace fjord {
namespace {

TEST(HeightsTest, ARangeHoldsAllItsSamples) {
  for (const auto& [columns, rows] : {std::pair(2u, 2u), {9u, 8u}, {200u, 77u}, {513u, 257u}}) {
    std::vector<float> samples;
    for (uint32_t i = 0; i < columns * rows; ++i) {
      samples.push_back(static_cast<float>(Mix64(i) >> 40) - (1 << 23));
    }
    const auto source = SampledHeights(columns, rows, samples);
    uint64_t rectangles = 0;
    for (uint32_t n = 0; n < 400; ++n) {
      const auto pick = [&](uint32_t salt, uint32_t count) {
        return static_cast<uint32_t>(Mix64(n * 4 + salt) % count);
      };
      auto [i0, i1] = std::minmax({pick(0, columns), pick(1, columns)});
      auto [j0, j1] = std::minmax({pick(2, rows), pick(3, rows)});
      const HeightSource::Range range = source->RangeOf(i0, j0, i1, j1);
      float low = samples[j0 * columns + i0], high = low;
      for (uint32_t j = j0; j <= j1; ++j) {
        for (uint32_t i = i0; i <= i1; ++i) {
          low = std::min(low, source->At(i, j));
          high = std::max(high, source->At(i, j));
        }
      }
      ASSERT_LE(range.low, low);
      ASSERT_GE(range.high, high);
      ++rectangles;
    }
    EXPECT_EQ(rectangles, 400u);
    const HeightSource::Range all = source->RangeOf(0, 0, columns - 1, rows - 1);
    EXPECT_EQ(all.low, *std::min_element(samples.begin(), samples.end()));
    EXPECT_EQ(all.high, *std::max_element(samples.begin(), samples.end()));
  }
}

TEST(HeightsTest, SamplesStandWhereTheyShould) {
  const HeightField field{SampledHeights(3, 2, {0, 1, 2, 3, 4, 5}), Vec3(4, 6, .5)};
  EXPECT_EQ(field.At(0, 0), Vec3(-2, -3, 0));
  EXPECT_EQ(field.At(1, 0), Vec3(0, -3, .5));
  EXPECT_EQ(field.At(2, 1), Vec3(2, 3, 2.5));
  const Mesh mesh = MeshOf(field);
  EXPECT_EQ(mesh.points.size(), 6u);
  EXPECT_EQ(mesh.FaceCount(), 4u);
}

TEST(HeightsTest, AFlatSourceStoresNothing) {
  const auto flat = FlatHeights(4097, 4097);
  EXPECT_EQ(flat->At(4096, 4096), 0);
  EXPECT_LT(flat->Bytes(), 100u);
}

}  // namespace
}  // namespace fjord
