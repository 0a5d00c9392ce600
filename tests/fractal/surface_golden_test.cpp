// Digests of what the surface method makes; they change with its version alone (D5).
#include <gtest/gtest.h>

#include "tests/fractal/surface_shapes.h"

namespace fjord::test {
namespace {

struct Golden {
  std::string name;
  FractalSettings settings;
  std::string digest;
};

TEST(SurfaceGoldenTest, D5_DigestsOfTaiwan) {
  const FractalSettings by_epsilon = SurfaceSettings(.08);
  const FractalSettings by_pixels = PixelSettings(2, 60, Vec3(0, 0, 6), .5);
  std::vector<Golden> all;
  const auto add = [&](const std::string& name, const FractalSettings& from,
                       const std::string& digest, auto change) {
    FractalSettings settings = from;
    change(settings);
    all.push_back({name, settings, digest});
  };
  add("plain", by_epsilon, "6b7d4c6b5fc13f9d", [](FractalSettings&) {});
  add("pixels", by_pixels, "1540f778ac0a71a9", [](FractalSettings&) {});
  add("rough", by_epsilon, "94117c3f00b60e45", [](FractalSettings& s) { s.H = .3; });
  add("perturbed", by_epsilon, "6753a159f8c6c767",
      [](FractalSettings& s) { s.variant = Variant::kPerturbed; });
  add("shih current", by_epsilon, "089d20d0b86fef42", [](FractalSettings& s) {
    s.law = Law::kShih;
    s.variant = Variant::kCurrent;
  });
  add("similar edge", by_epsilon, "b525dc46f8d9d914", [](FractalSettings& s) {
    s.law = Law::kSimilar;
    s.direction = Direction::kEdge;
  });
  add("face", by_epsilon, "1924874083f4647b",
      [](FractalSettings& s) { s.direction = Direction::kFace; });
  add("up, five uniforms", by_epsilon, "72843a27e08e2b90", [](FractalSettings& s) {
    s.direction = Direction::kUp;
    s.uniforms = 5;
  });
  add("coast", by_epsilon, "87c840fd11384de4", [](FractalSettings& s) { s.coast = true; });
  add("adaptive", by_pixels, "b7a4885303d46dae",
      [](FractalSettings& s) { s.split = Split::kAdaptive; });
  add("length", by_epsilon, "acbdf2d3e2a2a43c",
      [](FractalSettings& s) { s.split = Split::kLength; });
  for (const Golden& one : all) {
    const auto prepared = Prepare(TaiwanRelief(), one.settings);
    EXPECT_EQ(DigestOf(StreamedLeaves(*prepared)), one.digest) << one.name;
  }
}

}  // namespace
}  // namespace fjord::test
