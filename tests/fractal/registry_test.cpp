// What every method of the registry must hold, over every combination of its choices.
#include "engine/fractal/registry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "tests/fractal/collect.h"

namespace fjord {
namespace {

using test::CollectSink;
using test::Leaf;

struct Combination {
  const MethodInfo* method;
  MethodSettings settings;
  std::string name;
};

std::vector<Combination> AllCombinations() {
  std::vector<Combination> all;
  for (const MethodInfo& method : FractalMethods()) {
    for (const test::Choice& choice : test::AllChoices(method)) {
      for (const Split split : test::kSplits) {
        MethodSettings s;
        s.method = method.name;
        s.own = choice.own;
        s.split = split;
        s.seed = 11;
        s.max_level = 5;
        s.fineness.epsilon = method.takes == Takes::kCurve ? .05 : .1;
        if (split == Split::kAdaptive) s.fineness = {0, 14, 400, .1, {0, 0, 3}, 0};
        all.push_back(
            {&method, s,
             std::string(method.name) + " " + choice.name + " " + std::string(SplitName(split))});
      }
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

std::unique_ptr<PreparedFractal> PrepareCombination(const Combination& c) {
  auto prepared = PrepareMethod(ShapeFor(*c.method), c.settings);
  FJORD_CHECK(prepared.ok(), c.name, prepared.error().message);
  return std::move(prepared).value();
}

// What the tests below go over.
TEST(RegistryTest, EveryChoiceOfEveryMethodIsCombined) {
  std::set<std::string> names;
  for (const Combination& c : AllCombinations()) names.insert(c.name);
  EXPECT_EQ(names.size(), AllCombinations().size());
  EXPECT_GE(names.size(), 244u);
}

TEST(RegistryTest, NamesAreUniqueAndDefaultsKeepTheTables) {
  std::set<std::string_view> names;
  for (const MethodInfo& method : FractalMethods()) {
    EXPECT_TRUE(names.insert(method.name).second);
    EXPECT_EQ(FindFractalMethod(method.name), &method);
    EXPECT_GE(method.version, 1u);
    EXPECT_FALSE(method.summary.empty());
    EXPECT_TRUE(method.knobs.Check(method.knobs.defaults(), method.name).empty());
    for (const Knob& knob : method.knobs.rows()) EXPECT_FALSE(knob.effect.empty()) << knob.name;
  }
  EXPECT_EQ(FindFractalMethod("no such method"), nullptr);
  EXPECT_EQ(FractalMethods()[0].name, "surface");
  EXPECT_EQ(FractalMethods()[1].name, "coast");
  EXPECT_EQ(FractalMethods()[2].name, "curve");
}

// Three directions, variants and laws each, less what does not go together, the additions,
// and both increments of a surface.
TEST(RegistryTest, EveryCombinationIsLookedAt) {
  std::map<std::string_view, int> counts;
  for (const Combination& c : AllCombinations()) ++counts[c.method->name];
  EXPECT_EQ(counts["surface"], 3 * 3 * 4 * 3 * 2);
  EXPECT_EQ(counts["coast"], 3 * 3 * 2 * 3);
  EXPECT_EQ(counts["curve"], 3 * (3 * 3 * 3 + 1));
}

TEST(RegistryTest, BadSettingsAreNamed) {
  const MethodInfo& curve = *FindFractalMethod("curve");
  const auto defect = [&](const auto& change) {
    auto s = std::any_cast<FractalSettings>(curve.knobs.defaults());
    change(s);
    const std::vector<KnobDefect> defects = curve.knobs.Check(s, curve.name);
    return defects.size() == 1 ? defects[0].knob + ": " + defects[0].message : "?";
  };
  EXPECT_EQ(defect([](auto& s) { s.H = 1.2; }), "H: 1.2; curve takes 0 to 1");
  EXPECT_EQ(defect([](auto& s) { s.H = std::nan(""); }),
            "H: not a finite number; curve takes 0 to 1");
  EXPECT_EQ(defect([](auto& s) { s.H = .01; }), "H: 0.01; law SIMILAR takes 0.06 to 1");
  EXPECT_EQ(defect([](auto& s) { s.sigma = -1; }), "sigma: -1; curve takes 0 to 100");
  EXPECT_EQ(defect([](auto& s) { s.uniforms = 0; }), "uniforms: 0; curve takes 1 to 16");
  EXPECT_EQ(defect([](auto& s) { s.direction = Direction::kFace; }),
            "direction: ? is not one of curve's: EDGE, VERTEX, UP");
  EXPECT_EQ(defect([](auto& s) { s.increments = Increments::kAdditions; }),
            "increments: ADDITIONS goes with law AFFINE, direction EDGE and variant FIXED only");
  FractalSettings two;
  two.H = 2;
  two.move = -1;
  const auto prepared = PrepareMidpoint(curve, ShapeFor(curve), two);
  ASSERT_FALSE(prepared.ok());
  EXPECT_EQ(prepared.error().message, "fractal.H: 2; curve takes 0 to 1");
  EXPECT_EQ(prepared.error().code, ErrorCode::kInvalid);
  FractalSettings deep;
  deep.max_level = 1000;
  const auto too_deep = PrepareMidpoint(curve, ShapeFor(curve), deep);
  ASSERT_FALSE(too_deep.ok());
  EXPECT_EQ(too_deep.error().message, "fractal.max_level: 1000; at most 40");
}

// M3
TEST(RegistryTest, S3_StreamedAndWeldedHaveTheSameBits) {
  for (const Combination& c : AllCombinations()) {
    const auto fractal = PrepareCombination(c);
    const auto streamed = test::StreamedLeaves(*fractal);
    EXPECT_GT(streamed.size(), fractal->RootCount()) << c.name;
    EXPECT_EQ(streamed, test::WeldedLeaves(test::Weld(*fractal))) << c.name;
  }
}

// M1: neither the size of the patches nor the order of the roots changes a bit.
TEST(RegistryTest, S24_PatchesAndOrderChangeNothing) {
  for (const Combination& c : AllCombinations()) {
    const auto fractal = PrepareCombination(c);
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
    const WeldedShape welded = test::Weld(*fractal);
    EXPECT_EQ(*std::max_element(welded.level.begin(), welded.level.end()), 3) << c.name;
  }
}

TEST(RegistryTest, WeldStopsAtItsLimit) {
  for (const Combination& c : AllCombinations()) {
    const auto fractal = PrepareCombination(c);
    const auto welded = fractal->Weld({.max_points = 20});
    ASSERT_FALSE(welded.ok()) << c.name;
    EXPECT_EQ(welded.error().code, ErrorCode::kLimit) << c.name;
  }
}

TEST(RegistryTest, BadShapesAreRefused) {
  for (const MethodInfo& method : FractalMethods()) {
    MethodSettings s;
    s.method = method.name;
    s.own = method.knobs.defaults();
    s.fineness.epsilon = .1;
    CoarseShape shape = ShapeFor(method);
    shape.rest.pop_back();
    EXPECT_FALSE(PrepareMethod(shape, s).ok()) << method.name;
    shape = ShapeFor(method);
    shape.curve = !shape.curve;
    shape.triangles.clear();
    EXPECT_FALSE(PrepareMethod(shape, s).ok()) << method.name;
  }
}

// Collapsed shapes end cleanly and stay finite.
TEST(RegistryTest, C16a_CollapsedShapesEndCleanly) {
  size_t streamed = 0;
  for (const Combination& base : AllCombinations()) {
    for (const bool rest_too : {false, true}) {
      CoarseShape shape = ShapeFor(*base.method);
      for (size_t i = 0; i < shape.now.size(); ++i) {
        shape.now[i] = Vec3(1, 2, 0);
        if (rest_too) {
          shape.rest[i] = Vec3(3, 3, 0);
        }
      }
      auto prepared = PrepareMethod(shape, base.settings);
      ASSERT_TRUE(prepared.ok()) << base.name << ": " << prepared.error().message;
      CollectSink sink;
      for (size_t root = 0; root < (*prepared)->RootCount(); ++root) {
        (*prepared)->Stream(root, sink, 512);
      }
      for (const Vec3& p : sink.points) {
        ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << base.name;
      }
      ASSERT_FALSE(sink.points.empty()) << base.name;
      ++streamed;
    }
  }
  EXPECT_EQ(streamed, 2 * AllCombinations().size());
}

}  // namespace
}  // namespace fjord
