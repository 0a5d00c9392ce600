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
  add("plain", by_epsilon, "bdae51a423514a05", [](FractalSettings&) {});
  // Plain halving keeps the digests that it had as version 3.
  const auto plain_halving = [](FractalSettings& s) { s.increments = Increments::kMidpoint; };
  add("midpoint", by_epsilon, "6b7d4c6b5fc13f9d", plain_halving);
  add("midpoint, pixels", by_pixels, "1540f778ac0a71a9", plain_halving);
  add("midpoint, length", by_epsilon, "acbdf2d3e2a2a43c", [](FractalSettings& s) {
    s.increments = Increments::kMidpoint;
    s.split = Split::kLength;
  });
  add("pixels", by_pixels, "13fe73684a02c0e0", [](FractalSettings&) {});
  add("rough", by_epsilon, "46cea077fcaf9297", [](FractalSettings& s) { s.H = .3; });
  add("perturbed", by_epsilon, "08ccaf4a360df403",
      [](FractalSettings& s) { s.variant = Variant::kPerturbed; });
  add("shih current", by_epsilon, "570694d94524f80f", [](FractalSettings& s) {
    s.law = Law::kShih;
    s.variant = Variant::kCurrent;
  });
  add("similar edge", by_epsilon, "d1f57dc6ad6fa078", [](FractalSettings& s) {
    s.law = Law::kSimilar;
    s.direction = Direction::kEdge;
  });
  add("face", by_epsilon, "12e27f0cbcec0f00",
      [](FractalSettings& s) { s.direction = Direction::kFace; });
  add("up, five uniforms", by_epsilon, "2b5f7ddc44572163", [](FractalSettings& s) {
    s.direction = Direction::kUp;
    s.uniforms = 5;
  });
  add("coast", by_epsilon, "9e55edd9d153aca4", [](FractalSettings& s) { s.coast = true; });
  add("adaptive", by_pixels, "435f6da98531a24e",
      [](FractalSettings& s) { s.split = Split::kAdaptive; });
  add("length", by_epsilon, "5bce7cdece956f55",
      [](FractalSettings& s) { s.split = Split::kLength; });
  for (const Golden& one : all) {
    const auto prepared = Prepare(TaiwanRelief(), one.settings);
    EXPECT_EQ(DigestOf(StreamedLeaves(*prepared)), one.digest) << one.name;
  }
}

}  // namespace
}  // namespace fjord::test
