// What every method of the registry must hold, over every combination of its choices.
#include "engine/fractal/registry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/fractal/collect.h"

namespace fjord {
namespace {

using test::CollectSink;
using test::Leaf;

struct Combination {
  const MethodInfo* method;
  FractalSettings settings;
  std::string name;
};

// A camera three units above the shape, looking down, 400 pixels a unit at distance 1.
AdaptiveView TestView() {
  AdaptiveView view;
  view.rows = {400, 0, -50, 150, 0, 400, -50, 150, 0, 0, -1, 3};
  view.near = .1;
  return view;
}

std::vector<Combination> AllCombinations() {
  std::vector<Combination> all;
  for (const MethodInfo& method : FractalMethods()) {
    for (const Law law : method.laws) {
      for (const Direction direction : method.directions) {
        for (const Variant variant : method.variants) {
          for (const Split split : method.splits) {
            FractalSettings s = method.defaults;
            s.law = law;
            s.direction = direction;
            s.variant = variant;
            s.split = split;
            s.seed = 11;
            s.max_level = 5;
            s.fineness.epsilon = method.takes == Takes::kCurve ? .05 : .1;
            if (split == Split::kAdaptive) {
              s.fineness = {0, 14, 400, .1, {0, 0, 3}, 0};
            }
            all.push_back({&method, s,
                           std::string(method.name) + " " + std::string(LawName(law)) + " " +
                               std::string(DirectionName(direction)) + " " +
                               std::string(VariantName(variant)) + " " +
                               std::string(SplitName(split))});
          }
        }
      }
    }
    if (method.additions) {
      FractalSettings s = method.defaults;
      s.law = Law::kAffine;
      s.direction = Direction::kEdge;
      s.variant = Variant::kFixed;
      s.increments = Increments::kAdditions;
      s.max_level = 7;
      s.fineness.epsilon = .05;
      all.push_back({&method, s, std::string(method.name) + " ADDITIONS"});
    }
  }
  return all;
}

CoarseShape ShapeFor(const MethodInfo& method) {
  CoarseShape shape = method.takes == Takes::kCurve ? test::OutlineCurve() : test::OutlineMesh(.5);
  for (size_t i = 0; i < shape.now.size(); ++i) {
    shape.now[i] = shape.now[i] * 1.1 + Vec3(.01 * static_cast<double>(i % 3), .02, .1);
  }
  return shape;
}

// nullptr for a method that is not built in.
std::unique_ptr<PreparedFractal> PrepareCombination(const Combination& c) {
  const AdaptiveView view = TestView();
  auto prepared = c.method->prepare(ShapeFor(*c.method), c.settings, &view);
  if (!prepared.ok()) {
    EXPECT_EQ(prepared.error().code, ErrorCode::kInternal) << c.name;
    return nullptr;
  }
  return std::move(prepared).value();
}

TEST(RegistryTest, NamesAreUniqueAndDefaultsResolved) {
  std::set<std::string_view> names;
  for (const MethodInfo& method : FractalMethods()) {
    EXPECT_TRUE(names.insert(method.name).second);
    EXPECT_EQ(FindFractalMethod(method.name), &method);
    EXPECT_GE(method.version, 1u);
    EXPECT_EQ(method.defaults.method, method.name);
    EXPECT_NE(method.defaults.law, Law::kDefault);
    EXPECT_NE(method.defaults.direction, Direction::kDefault);
    EXPECT_NE(method.defaults.variant, Variant::kDefault);
    EXPECT_TRUE(CheckSettings(method, method.defaults).empty());
    EXPECT_TRUE(CheckSettings(method, FractalSettings{}).empty());
    for (const std::string_view knob : method.knobs) {
      const auto knobs = AllKnobs();
      EXPECT_TRUE(std::any_of(knobs.begin(), knobs.end(), [&](const Knob& k) {
        return k.name == knob && !k.effect.empty();
      })) << knob;
    }
  }
  EXPECT_EQ(FindFractalMethod("no such method"), nullptr);
  EXPECT_EQ(FractalMethods()[0].name, "surface");
  EXPECT_EQ(FractalMethods()[1].name, "coast");
  EXPECT_EQ(FractalMethods()[2].name, "curve");
}

TEST(RegistryTest, BadSettingsAreNamed) {
  const MethodInfo& curve = *FindFractalMethod("curve");
  const auto defect = [&](const auto& change) {
    FractalSettings s;
    change(s);
    const std::vector<SettingDefect> defects = FindSettingDefects(curve, s);
    return defects.size() == 1 ? std::string(defects[0].field) + ": " + defects[0].message : "?";
  };
  EXPECT_EQ(defect([](auto& s) { s.H = 1.2; }), "H: H is 1.2; curve takes 0 to 1");
  EXPECT_EQ(defect([](auto& s) { s.H = std::nan(""); }), "H: H is nan; curve takes 0 to 1");
  EXPECT_EQ(defect([](auto& s) { s.H = .01; }),
            "H: H is 0.01; curve takes 0.06 to 1 with law SIMILAR");
  EXPECT_EQ(defect([](auto& s) { s.sigma = -1; }), "sigma: sigma is -1; curve takes 0 to 100");
  EXPECT_EQ(defect([](auto& s) { s.max_level = 1000; }),
            "max_level: max_level is 1000; curve takes 0 to 40");
  EXPECT_EQ(defect([](auto& s) { s.uniforms = 0; }),
            "uniforms: uniforms is 0; curve takes 1 to 16");
  EXPECT_EQ(defect([](auto& s) { s.direction = Direction::kFace; }),
            "direction: direction FACE is not one of curve's: EDGE, VERTEX, UP");
  EXPECT_EQ(
      defect([](auto& s) { s.increments = Increments::kAdditions; }),
      "increments: increments ADDITIONS goes with law AFFINE, direction EDGE and variant FIXED "
      "only");
  FractalSettings two;
  two.H = 2;
  two.move = -1;
  const Errors errors = CheckSettings(curve, two);
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_EQ(errors[0].message, "fractal.H: H is 2; curve takes 0 to 1");
  EXPECT_EQ(errors[0].code, ErrorCode::kInvalid);
}

// M3
TEST(RegistryTest, S3_StreamedAndWeldedHaveTheSameBits) {
  for (const Combination& c : AllCombinations()) {
    const auto fractal = PrepareCombination(c);
    if (fractal == nullptr) {
      continue;
    }
    const auto streamed = test::StreamedLeaves(*fractal);
    EXPECT_GT(streamed.size(), fractal->RootCount()) << c.name;
    EXPECT_EQ(streamed, test::WeldedLeaves(test::Weld(*fractal))) << c.name;
  }
}

// M1: neither the size of the patches nor the order of the roots changes a bit.
TEST(RegistryTest, S24_PatchesAndOrderChangeNothing) {
  for (const Combination& c : AllCombinations()) {
    const auto fractal = PrepareCombination(c);
    if (fractal == nullptr) {
      continue;
    }
    const auto expected = test::StreamedLeaves(*fractal, 2048);
    CollectSink sink;
    for (size_t root = fractal->RootCount(); root-- > 0;) {
      fractal->Stream(root, sink, 256);
    }
    std::sort(sink.leaves.begin(), sink.leaves.end());
    EXPECT_EQ(sink.leaves, expected) << c.name;
  }
}

// M2
TEST(RegistryTest, S7_NothingLeavesItsBound) {
  for (const Combination& c : AllCombinations()) {
    const auto fractal = PrepareCombination(c);
    if (fractal == nullptr) {
      continue;
    }
    for (size_t root = 0; root < fractal->RootCount(); ++root) {
      CollectSink sink;
      fractal->Stream(root, sink, 512);
      const Ball ball = fractal->Bound(root);
      EXPECT_TRUE(std::isfinite(ball.radius)) << c.name;
      for (const Vec3& p : sink.points) {
        ASSERT_LE(Length(p - ball.center), ball.radius) << c.name;
      }
    }
  }
}

// What culling drops is never within the reach that was stated.
TEST(RegistryTest, S7_CullingLosesNothingThatIsWanted) {
  const Vec3 eye(.9, .6, .2);
  constexpr double kRadius = .25;
  for (const Combination& c : AllCombinations()) {
    const auto fractal = PrepareCombination(c);
    if (fractal == nullptr) {
      continue;
    }
    const auto touches = [&](const Leaf& leaf) {
      return std::any_of(leaf.begin(), leaf.end(), [&](const test::Corner& corner) {
        const Vec3 p(std::bit_cast<double>(corner.bits[0]), std::bit_cast<double>(corner.bits[1]),
                     std::bit_cast<double>(corner.bits[2]));
        return Length(p - eye) <= kRadius;
      });
    };
    auto expected = test::StreamedLeaves(*fractal);
    std::erase_if(expected, [&](const Leaf& leaf) { return !touches(leaf); });
    CollectSink sink;
    sink.wanted = [&](const Vec3& a, const Vec3& b, const Vec3& d, const StreamReach& reach) {
      const Vec3 center = (a + b + d) / 3.0;
      const double size =
          std::max({Length(a - center), Length(b - center), Length(d - center)}) * (1 + 1e-12);
      return Length(center - eye) <= kRadius + size + reach.Any();
    };
    for (size_t root = 0; root < fractal->RootCount(); ++root) {
      fractal->Stream(root, sink, 256);
    }
    std::sort(sink.leaves.begin(), sink.leaves.end());
    std::erase_if(sink.leaves, [&](const Leaf& leaf) { return !touches(leaf); });
    EXPECT_EQ(sink.leaves, expected) << c.name;
  }
}

// M4
TEST(RegistryTest, S21_NothingPassesMaxLevel) {
  for (const Combination& base : AllCombinations()) {
    Combination c = base;
    c.settings.max_level = 3;
    c.settings.fineness.epsilon = 1e-6;
    c.settings.fineness.pixels *= 1e-4;
    const auto fractal = PrepareCombination(c);
    if (fractal == nullptr) {
      continue;
    }
    const WeldedShape welded = test::Weld(*fractal);
    EXPECT_EQ(*std::max_element(welded.level.begin(), welded.level.end()), 3) << c.name;
  }
}

TEST(RegistryTest, WeldStopsAtItsLimit) {
  for (const Combination& c : AllCombinations()) {
    const auto fractal = PrepareCombination(c);
    if (fractal == nullptr) {
      continue;
    }
    const auto welded = fractal->Weld({.max_points = 20});
    ASSERT_FALSE(welded.ok()) << c.name;
    EXPECT_EQ(welded.error().code, ErrorCode::kLimit) << c.name;
  }
}

TEST(RegistryTest, BadShapesAreRefused) {
  for (const MethodInfo& method : FractalMethods()) {
    FractalSettings s = method.defaults;
    s.fineness.epsilon = .1;
    CoarseShape shape = ShapeFor(method);
    shape.rest.pop_back();
    EXPECT_FALSE(method.prepare(shape, s, nullptr).ok()) << method.name;
    shape = ShapeFor(method);
    shape.curve = !shape.curve;
    shape.triangles.clear();
    EXPECT_FALSE(method.prepare(shape, s, nullptr).ok()) << method.name;
  }
}

// Collapsed shapes end cleanly and stay finite.
TEST(RegistryTest, C16a_CollapsedShapesEndCleanly) {
  for (const Combination& base : AllCombinations()) {
    const AdaptiveView view = TestView();
    for (const bool rest_too : {false, true}) {
      CoarseShape shape = ShapeFor(*base.method);
      for (size_t i = 0; i < shape.now.size(); ++i) {
        shape.now[i] = Vec3(1, 2, 0);
        if (rest_too) {
          shape.rest[i] = Vec3(3, 3, 0);
        }
      }
      auto prepared = base.method->prepare(shape, base.settings, &view);
      if (!prepared.ok()) {
        continue;
      }
      CollectSink sink;
      for (size_t root = 0; root < (*prepared)->RootCount(); ++root) {
        (*prepared)->Stream(root, sink, 512);
      }
      for (const Vec3& p : sink.points) {
        ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << base.name;
      }
    }
  }
}

}  // namespace
}  // namespace fjord
