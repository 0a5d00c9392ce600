#include "engine/fractal/surface.h"

#include <gtest/gtest.h>

#include "tests/fractal/surface_shapes.h"

namespace fjord::test {
namespace {

TEST(SurfaceTest, S24_StreamedIsWeldedBitForBitAtEverySimdLevelAndPatch) {
  const FractalSettings settings = SurfaceSettings(.06);
  const auto prepared = Prepare(TaiwanRelief(), settings);
  const std::vector<Leaf> truth = WeldedLeaves(Weld(*prepared));
  EXPECT_GT(truth.size(), 10000u);
  for (const std::string& level : SimdLevels()) {
    const AtSimdLevel at(level);
    for (const size_t hint : {16u, 300u, 2048u, 65536u}) {
      EXPECT_TRUE(StreamedLeaves(*prepared, hint) == truth) << level << ' ' << hint;
    }
    EXPECT_TRUE(WeldedLeaves(Weld(*prepared)) == truth) << level;
  }
}

}  // namespace
}  // namespace fjord::test
