// The direction rules, laws and order-freedom of the method "curve".
#include "engine/fractal/curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "engine/base/parallel.h"
#include "engine/base/random.h"
#include "engine/fractal/amount.h"
#include "engine/fractal/measure.h"
#include "tests/fractal/collect.h"

namespace fjord {
namespace {

using test::OutlineCurve;
using test::Prepare;
using test::StraightCurve;
using test::Weld;

FractalSettings Curve(Law law, Direction direction, Variant variant, double H, double epsilon) {
  FractalSettings s = test::SettingsOf("curve", epsilon);
  s.law = law;
  s.direction = direction;
  s.variant = variant;
  s.H = H;
  return s;
}

FractalSettings Fixed(double H, double epsilon) {
  return Curve(Law::kAffine, Direction::kEdge, Variant::kFixed, H, epsilon);
}

// Vertices by identity: position and level.
struct Made {
  Vec3 position;
  Vec3 direction;
  int level;
};
std::map<Identity, Made> ById(const WeldedShape& shape) {
  std::map<Identity, Made> made;
  for (size_t i = 0; i < shape.identity.size(); ++i) {
    made[shape.identity[i]] = {shape.mesh.points[i], shape.direction[i], shape.level[i]};
  }
  return made;
}

// Every halving of a welded curve whose edges were all split: middle vertex and its segment's ends.
struct Halving {
  size_t a, m, b;
  int level;  // of the segment
};
std::vector<Halving> Halvings(const WeldedShape& shape) {
  std::vector<Halving> all;
  const size_t count = shape.level.size();
  for (size_t m = 0; m < count; ++m) {
    if (shape.level[m] == 0) {
      continue;
    }
    size_t a = m;
    size_t b = m;
    do {
      a = (a + count - 1) % count;
    } while (shape.level[a] >= shape.level[m]);
    do {
      b = (b + 1) % count;
    } while (shape.level[b] >= shape.level[m]);
    all.push_back({a, m, b, shape.level[m] - 1});
  }
  return all;
}

// Of the halved segment, on OutlineCurve at rest.
double RestLength(const WeldedShape& shape, const Halving& h) {
  const CoarseShape outline = OutlineCurve();
  size_t edge = 0;
  for (size_t i = 0; i < h.m; ++i) {
    edge += shape.level[i + 1] == 0 ? 1 : 0;
  }
  return Length(outline.now[(edge + 1) % 12] - outline.now[edge]) * std::pow(.5, h.level);
}

Polyline AsLine(const WeldedShape& shape) { return {shape.mesh.points, shape.closed}; }

std::vector<double> Heights(const WeldedShape& shape) {
  std::vector<double> heights;
  for (const Vec3& p : shape.mesh.points) {
    heights.push_back(p.y);
  }
  return heights;
}

TEST(CurveTest, S2_FixedNormalCurvesMeasureTheirH) {
  for (const double H : {.3, .5, .7}) {
    FractalSettings s = Fixed(H, 1.5 / 65536);
    for (const uint64_t seed : {1, 2, 3}) {
      s.seed = seed;
      const WeldedShape shape = Weld(*Prepare(StraightCurve(), s));
      ASSERT_EQ(shape.mesh.points.size(), 65537u);
      EXPECT_NEAR(*HurstExponent(Heights(shape)), H, .02) << seed;
    }
  }
}

TEST(CurveTest, S2_LengthGrowsAsHFalls) {
  for (const Law law : {Law::kAffine, Law::kSimilar}) {
    double last = 0;
    for (const double H : {.9, .7, .5, .3}) {
      const auto settings = Curve(law, Direction::kVertex, Variant::kCurrent, H, .002);
      const double length = LineLength(AsLine(Weld(*Prepare(OutlineCurve(), settings))));
      EXPECT_GT(length, last) << H;
      last = length;
    }
  }
}

// The variance that a fixed rule's offsets have over many edges of one level.
TEST(CurveTest, S6_LevelVariancesFollowTheFormula) {
  CoarseShape chain = StraightCurve();
  chain.now.clear();
  for (int i = 0; i <= 11000; ++i) {
    chain.now.push_back({static_cast<double>(i), 0, 0});
  }
  chain.rest = chain.now;
  for (const double H : {.3, .7}) {
    FractalSettings s = Fixed(H, .09);
    s.sigma = 1.5;
    s.amplitude = .2;
    const WeldedShape shape = Weld(*Prepare(chain, s));
    std::map<int, std::pair<double, double>> sums;
    for (const Halving& h : Halvings(shape)) {
      const Vec3& a = shape.mesh.points[h.a];
      const Vec3& b = shape.mesh.points[h.b];
      const double offset = shape.mesh.points[h.m].y - .5 * (a.y + b.y);
      sums[h.level + 1].first += offset * offset;
      sums[h.level + 1].second += 1;
    }
    ASSERT_EQ(sums.size(), 4u);
    for (const auto& [level, sum] : sums) {
      const double deviation = LevelDeviation(1.5 * .2, H, level);
      EXPECT_GE(sum.second, 1e4);
      EXPECT_NEAR(sum.first / sum.second / (deviation * deviation), 1, .03) << level;
    }
  }
}

// Mean squared increments over two finest steps, from even places and from odd ones. Of plain
// halving they differ: with v = 2^(2H), odd / even tends to (v/8 + 2/v - 1/2) / (1 - v/8).
std::pair<double, double> EvenAndOdd(double H, Increments increments) {
  double even = 0;
  double odd = 0;
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    FractalSettings s = Fixed(H, 1.5 / 2048);
    s.seed = seed;
    s.increments = increments;
    const std::vector<double> y = Heights(Weld(*Prepare(StraightCurve(), s)));
    EXPECT_EQ(y.size(), 2049u);
    for (size_t i = 0; i + 3 < y.size(); i += 2) {
      even += (y[i + 2] - y[i]) * (y[i + 2] - y[i]);
      odd += (y[i + 3] - y[i + 1]) * (y[i + 3] - y[i + 1]);
    }
  }
  return {even, odd};
}

TEST(CurveTest, S6_HalvingIsNotStationary) {
  const auto [even2, odd2] = EvenAndOdd(.2, Increments::kMidpoint);
  EXPECT_NEAR(odd2 / even2, 1.414, .04);
  const auto [even8, odd8] = EvenAndOdd(.8, Increments::kMidpoint);
  EXPECT_NEAR(odd8 / even8, .867, .02);
}

TEST(CurveTest, S6_AdditionsAreStationary) {
  for (const double H : {.2, .5, .8}) {
    const auto [even, odd] = EvenAndOdd(H, Increments::kAdditions);
    EXPECT_NEAR(odd / even, 1, .02) << H;
  }
}

// Nor along one edge alone, where lattices in step with the dyadic places would favour one phase.
TEST(CurveTest, S6_AdditionsAreStationaryAlongOneEdge) {
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    FractalSettings s = Fixed(.5, 1.5 / 65536);
    s.seed = seed;
    s.increments = Increments::kAdditions;
    const std::vector<double> y = Heights(Weld(*Prepare(StraightCurve(), s)));
    double sums[2] = {0, 0};
    for (size_t i = 0; i + 2 < y.size(); ++i) {
      sums[i % 2] += (y[i + 2] - y[i]) * (y[i + 2] - y[i]);
    }
    EXPECT_NEAR(sums[1] / sums[0], 1, .02) << seed;
  }
}

// Not only at the finest steps: quarter of the edge against quarter, over many edges.
TEST(CurveTest, S6_AdditionsAreStationaryAtEveryScale) {
  CoarseShape chain = StraightCurve();
  chain.now.clear();
  for (int i = 0; i <= 8000; ++i) {
    chain.now.push_back({static_cast<double>(i), 0, 0});
  }
  chain.rest = chain.now;
  FractalSettings s = Fixed(.5, .07);
  s.increments = Increments::kAdditions;
  const std::vector<double> y = Heights(Weld(*Prepare(chain, s)));
  ASSERT_EQ(y.size(), 8000u * 16 + 1);
  double at[13] = {};  // increments over 1/4, from each sixteenth
  for (size_t edge = 0; edge < 8000; ++edge) {
    for (size_t i = 0; i <= 12; ++i) {
      const double step = y[16 * edge + i + 4] - y[16 * edge + i];
      at[i] += step * step / 8000;
    }
  }
  // The kept ends take a bridge's share from all alike; variance of a quarter's step of a bridge.
  double mean = 0;
  for (const double v : at) {
    mean += v / 13;
  }
  for (const double v : at) {
    EXPECT_NEAR(v / mean, 1, .08);
  }
}

TEST(CurveTest, S6_AdditionsMeasureTheirHAndKeepTheirEnds) {
  for (const double H : {.3, .5, .7}) {
    FractalSettings s = Fixed(H, 1.5 / 65536);
    s.increments = Increments::kAdditions;
    const WeldedShape shape = Weld(*Prepare(StraightCurve(2), s));
    EXPECT_NEAR(*HurstExponent(Heights(shape), false), H, .03);
    EXPECT_EQ(shape.mesh.points.front(), Vec3(0));
    EXPECT_EQ(shape.mesh.points.back(), Vec3(2, 0, 0));
    // Its size is that of plain halving: sigma A lag^H.
    const std::vector<double> y = Heights(shape);
    const double step = 2.0 / static_cast<double>(y.size() - 1);
    EXPECT_NEAR(Variogram(y, 4, false) / (.15 * .15 * std::pow(4 * step, 2 * H)), 1, .1) << H;
  }
}

TEST(CurveTest, S8_EachKnobMovesItsStatistic) {
  const auto furthest = [](double sigma) {
    FractalSettings s = Fixed(.7, .01);
    s.sigma = sigma;
    double most = 0;
    for (const double y : Heights(Weld(*Prepare(StraightCurve(), s)))) {
      most = std::max(most, std::abs(y));
    }
    return most;
  };
  EXPECT_LT(furthest(.5), furthest(1));
  EXPECT_LT(furthest(1), furthest(2));
  const auto roughness = [](double H) {
    FractalSettings s = Fixed(H, .001);
    return LineLength(AsLine(Weld(*Prepare(StraightCurve(), s))));
  };
  EXPECT_GT(roughness(.3), roughness(.5));
  EXPECT_GT(roughness(.5), roughness(.9));
  const auto points = [](double epsilon) {
    return Weld(*Prepare(OutlineCurve(), Fixed(.7, epsilon))).mesh.points.size();
  };
  EXPECT_GT(points(.01), points(.02));
  EXPECT_GT(points(.02), points(.1));
}

TEST(CurveTest, G5_WantedDimensionOrdersMeasuredRoughness) {
  double last = 1;
  for (const double H : {.9, .7, .5}) {
    const auto s = Curve(Law::kSimilar, Direction::kEdge, Variant::kCurrent, H, 1e-4);
    const Polyline line = AsLine(Weld(*Prepare(StraightCurve(), s)));
    const std::vector<double> openings = {.1, .07, .05, .035, .025, .017, .012, .008, .006, .004};
    const double dimension = RulerDimension(line, openings);
    EXPECT_GT(dimension, last);
    last = dimension;
  }
}

// Means over seeds: one curve's measured dimension scatters by some hundredths.
TEST(CurveTest, S14_SimilarLawMeasuresItsDimension) {
  const std::vector<double> openings = {.04, .03, .02, .015, .01, .0075, .005, .00375, .0025};
  for (const auto& [direction, variant] : {std::pair(Direction::kEdge, Variant::kCurrent),
                                           std::pair(Direction::kVertex, Variant::kPerturbed)}) {
    for (const double H : {.7, .8, .9}) {
      double sum = 0;
      constexpr uint64_t kSeeds = 24;
      for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
        auto s = Curve(Law::kSimilar, direction, variant, H, 4e-4);
        s.split = Split::kLength;
        s.seed = seed;
        s.max_level = 32;
        sum += RulerDimension(AsLine(Weld(*Prepare(StraightCurve(), s))), openings);
      }
      EXPECT_NEAR(sum / kSeeds, 2 - H, .05) << DirectionName(direction);
    }
  }
}

TEST(CurveTest, S14_AllLawsEqualTheirFormula) {
  const double r = *SimilarFactor(.6, 5);
  for (const Law law : {Law::kAffine, Law::kSimilar, Law::kShih}) {
    auto s = Curve(law, Direction::kEdge, Variant::kCurrent, .6, .02);
    s.uniforms = 5;
    s.sigma = .5;
    const WeldedShape shape = Weld(*Prepare(OutlineCurve(), s));
    for (const Halving& h : Halvings(shape)) {
      const Vec3& a = shape.mesh.points[h.a];
      const Vec3& b = shape.mesh.points[h.b];
      const double length = Length(b - a);
      const Vec3 right = Vec3(b.y - a.y, a.x - b.x, 0) / length;
      const double offset = glm::dot(shape.mesh.points[h.m] - (a + b) * .5, right);
      const double g = Gaussian(shape.identity[h.m].lo, 5);
      const double rest = RestLength(shape, h);
      const double expected =
          law == Law::kAffine
              ? .5 * .15 * std::pow(rest, .6) * AffineConstant(.6) * g
              : (law == Law::kSimilar ? std::clamp(r * g, -kSimilarClamp, kSimilarClamp)
                                      : ShihDeviation(.5, .6, h.level) * g * .4) *
                    length;
      EXPECT_NEAR(offset, expected, 1e-12);
    }
  }
}

// [T] of S14: the historic law shrinks twice, so that its curves have no roughness left.
TEST(CurveTest, S14_HistoricLawMeasuresAsSmooth) {
  auto s = Curve(Law::kShih, Direction::kEdge, Variant::kFixed, .3, 1.5 / 16384);
  EXPECT_GT(*HurstExponent(Heights(Weld(*Prepare(StraightCurve(), s)))), .95);
}

TEST(CurveTest, S14_HalvingEpsilonKeepsCommonVertices) {
  for (const Increments increments : {Increments::kMidpoint, Increments::kAdditions}) {
    FractalSettings s = Fixed(.5, .05);
    s.increments = increments;
    const WeldedShape coarse = Weld(*Prepare(OutlineCurve(), s));
    s.fineness.epsilon = .025;
    const auto fine = ById(Weld(*Prepare(OutlineCurve(), s)));
    for (size_t i = 0; i < coarse.identity.size(); ++i) {
      const auto found = fine.find(coarse.identity[i]);
      ASSERT_NE(found, fine.end());
      EXPECT_EQ(found->second.position, coarse.mesh.points[i]);
    }
    EXPECT_GT(fine.size(), 1.9 * static_cast<double>(coarse.identity.size()));
  }
}

TEST(CurveTest, S15_LeavesAreShortAndParentsLong) {
  constexpr double kEpsilon = .03;
  auto s = Curve(Law::kSimilar, Direction::kVertex, Variant::kPerturbed, .7, kEpsilon);
  s.split = Split::kLength;
  const WeldedShape shape = Weld(*Prepare(OutlineCurve(), s));
  const std::vector<Vec3>& p = shape.mesh.points;
  for (size_t i = 0; i < p.size(); ++i) {
    EXPECT_LE(Length(p[(i + 1) % p.size()] - p[i]), kEpsilon);
  }
  for (const Halving& h : Halvings(shape)) {
    EXPECT_GT(Length(p[h.b] - p[h.a]), kEpsilon);
  }
  s.max_level = 3;
  for (const uint8_t level : Weld(*Prepare(OutlineCurve(), s)).level) {
    EXPECT_LE(level, 3);
  }
}

// Pixels: nearer the eye, finer. The thresholds grow with the distance.
TEST(CurveTest, S15_DistanceSetsTheFineness) {
  auto s = Fixed(.7, 0);
  s.fineness = {0, 2, 500, .1, {0, 0, 1}, 0};
  const WeldedShape near = Weld(*Prepare(StraightCurve(20), s));
  const std::vector<Vec3>& p = near.mesh.points;
  const double first = p[1].x - p[0].x;
  const double last = p[p.size() - 1].x - p[p.size() - 2].x;
  EXPECT_LT(first * 500, 2 * 1.01);
  EXPECT_GT(first * 500, 2 * .49);
  EXPECT_LE(last * 500, 2 * 20.1);
  EXPECT_GE(last, 8 * first);
  s.fineness.eye = {0, 0, 2};
  const WeldedShape far = Weld(*Prepare(StraightCurve(20), s));
  EXPECT_NEAR((far.mesh.points[1].x - far.mesh.points[0].x) / first, 2, 1e-12);
  s.fineness.eye_radius = 1;
  const WeldedShape ball = Weld(*Prepare(StraightCurve(20), s));
  EXPECT_NEAR((ball.mesh.points[1].x - ball.mesh.points[0].x) / first, 1, 1e-12);
}

TEST(CurveTest, S24_RootsInAnyOrderOnAnyThreadGiveTheSameBits) {
  for (const Direction direction : {Direction::kEdge, Direction::kVertex, Direction::kUp}) {
    const auto s = Curve(Law::kSimilar, direction, Variant::kPerturbed, .6, .01);
    const auto curve = Prepare(OutlineCurve(), s);
    const auto expected = test::StreamedLeaves(*curve);
    std::vector<test::CollectSink> sinks(curve->RootCount());
    ParallelFor(sinks.size(), 3,
                [&](size_t i) { curve->Stream(sinks.size() - 1 - i, sinks[i], 300); });
    std::vector<test::Leaf> leaves;
    for (const auto& sink : sinks) {
      leaves.insert(leaves.end(), sink.leaves.begin(), sink.leaves.end());
    }
    std::sort(leaves.begin(), leaves.end());
    EXPECT_EQ(leaves, expected);
  }
}

// Edges draw their own numbers: the thesis' S10 gave every edge the same ones.
TEST(CurveTest, S24_EdgesAndSeedsDiffer) {
  CoarseShape chain = StraightCurve();
  chain.now = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  chain.rest = chain.now;
  FractalSettings s = Fixed(.7, .3);
  const std::vector<double> y = Heights(Weld(*Prepare(chain, s)));
  ASSERT_EQ(y.size(), 9u);
  EXPECT_NE(y[2], y[6]);
  s.seed = 2;
  EXPECT_NE(Heights(Weld(*Prepare(chain, s)))[2], y[2]);
}

TEST(CurveTest, NumbersThatAreNotFiniteAreRefused) {
  CoarseShape shape = OutlineCurve();
  shape.now[1].y = std::nan("");
  const auto prepared = PrepareCurve(shape, Fixed(.7, .1));
  ASSERT_FALSE(prepared.ok());
  EXPECT_EQ(prepared.error().message, "point 2 of the curve is not finite");
}

TEST(CurveTest, C4_MidpointsOfTheUnitStep) {
  CoarseShape chain = StraightCurve();
  chain.now.clear();
  for (int i = 0; i <= 100000; ++i) {
    chain.now.push_back({static_cast<double>(i), 0, 0});
  }
  chain.rest = chain.now;
  FractalSettings s = Fixed(.5, .6);
  s.sigma = 1 / AffineConstant(.5);
  s.amplitude = 1;
  const WeldedShape shape = Weld(*Prepare(chain, s));
  double sum = 0;
  double squares = 0;
  for (size_t i = 1; i < shape.mesh.points.size(); i += 2) {
    sum += shape.mesh.points[i].y;
    squares += shape.mesh.points[i].y * shape.mesh.points[i].y;
    ASSERT_EQ(shape.mesh.points[i - 1], chain.now[i / 2]);
  }
  EXPECT_NEAR(sum / 1e5, 0, .01);
  EXPECT_NEAR(std::sqrt(squares / 1e5), 1, .01);
}

// Statistics that a job can report: finer costs more.
TEST(CurveTest, C49_FinerCostsMore) {
  uint64_t last = 0;
  for (const double epsilon : {.1, .03, .01}) {
    const auto curve = Prepare(OutlineCurve(), Fixed(.7, epsilon));
    test::CollectSink sink;
    StreamStats sum;
    for (size_t root = 0; root < curve->RootCount(); ++root) {
      const StreamStats stats = curve->Stream(root, sink, 512);
      sum.midpoints += stats.midpoints;
      sum.triangles += stats.triangles;
      sum.depth = std::max(sum.depth, stats.depth);
    }
    EXPECT_EQ(sum.triangles, sink.leaves.size());
    EXPECT_EQ(sum.midpoints + curve->RootCount(), sum.triangles);
    EXPECT_GT(sum.triangles, last);
    EXPECT_GT(sum.depth, 2u);
    last = sum.triangles;
  }
}

// The last level of a view fades in: a hair's breadth of camera moves nothing by more than a hair.
TEST(CurveTest, S21_AdaptiveDetailFadesIn) {
  auto s = Curve(Law::kAffine, Direction::kEdge, Variant::kFixed, .5, 0);
  s.split = Split::kAdaptive;
  const auto at = [&](double pixels) {
    s.fineness = {0, pixels, 100, .1, {0, 0, 3}, 0};
    return Weld(*Prepare(OutlineCurve(), s));
  };
  const WeldedShape before = at(3);
  const auto after = ById(at(3 * .9999));
  EXPECT_GE(after.size(), before.identity.size());
  for (size_t i = 0; i < before.identity.size(); ++i) {
    const auto found = after.find(before.identity[i]);
    ASSERT_NE(found, after.end());
    EXPECT_LT(Length(found->second.position - before.mesh.points[i]), 1e-4);
  }
  // Offsets are those of the law, times w of the length in thresholds, in the rest pose.
  std::vector<Vec3> rest_place(before.mesh.points.size());
  size_t corner = 0;
  for (size_t i = 0; i < rest_place.size(); ++i) {
    if (before.level[i] == 0) rest_place[i] = OutlineCurve().now[corner++];
  }
  std::vector<Halving> halvings = Halvings(before);
  std::stable_sort(halvings.begin(), halvings.end(),
                   [](const Halving& a, const Halving& b) { return a.level < b.level; });
  int faded = 0;
  for (const Halving& h : halvings) {
    const Vec3& a = before.mesh.points[h.a];
    const Vec3& b = before.mesh.points[h.b];
    rest_place[h.m] = (rest_place[h.a] + rest_place[h.b]) * .5;
    const double rest = RestLength(before, h);
    const double distance = Length(rest_place[h.m] - Vec3(0, 0, 3));
    const double t = std::min(1.0, rest * 100 / distance / 3 - 1);
    const double w = t * t * (3 - 2 * t);
    const double full = .15 * std::pow(rest, .5) * AffineConstant(.5) *
                        std::abs(Gaussian(before.identity[h.m].lo, 4));
    EXPECT_NEAR(Length(before.mesh.points[h.m] - (a + b) * .5), full * w, 1e-12);
    faded += w < .9 ? 1 : 0;
  }
  EXPECT_GT(faded, 10);
}

TEST(CurveTest, S4_InputEdgesMeetBitForBit) {
  for (const Variant variant : {Variant::kFixed, Variant::kCurrent, Variant::kPerturbed}) {
    const auto curve =
        Prepare(OutlineCurve(), Curve(Law::kSimilar, Direction::kVertex, variant, .5, .02));
    std::vector<test::CollectSink> sinks(curve->RootCount());
    for (size_t root = 0; root < sinks.size(); ++root) {
      curve->Stream(root, sinks[root], 100);
      for (size_t i = 0; i + 1 < sinks[root].leaves.size(); ++i) {
        ASSERT_EQ(sinks[root].leaves[i][1], sinks[root].leaves[i + 1][0]);
      }
    }
    for (size_t root = 0; root < sinks.size(); ++root) {
      EXPECT_EQ(sinks[root].leaves.back()[1], sinks[(root + 1) % 12].leaves.front()[0]);
    }
  }
}

// The bound is the finite sum over the levels that are left (curve_rules.cpp), neither more nor
// less.
TEST(CurveTest, S7_ReachIsTheSumOverItsLevels) {
  constexpr double kLength = 2;
  constexpr double kBound = 3.4641;  // sqrt(3 n)
  const auto reach = [&](Law law, Variant variant) {
    auto s = Curve(law, Direction::kEdge, variant, .6, 1.9 / 16);
    return Prepare(StraightCurve(kLength), s)->Bound(0).radius - kLength / 2;
  };
  double affine = 0;
  double shih = 0;
  double length = kLength;
  for (int k = 0; k < 5; ++k) {  // 2 > 1.9 / 16 five times halved
    affine += .15 * std::pow(kLength / std::pow(2, k), .6) * AffineConstant(.6) * kBound;
    const double c = ShihDeviation(1, .6, k) * .4 * kBound;
    shih += c * length;
    length *= .5 + c;
  }
  EXPECT_NEAR(reach(Law::kAffine, Variant::kCurrent) / affine, 1, 1e-4);
  EXPECT_NEAR(reach(Law::kShih, Variant::kFixed) / shih, 1, 1e-4);
  const double c = std::min(*SimilarFactor(.6, 4) * kBound, kSimilarClamp);
  const double q = std::sqrt(.25 + c * c);
  EXPECT_NEAR(
      reach(Law::kSimilar, Variant::kCurrent) / (c * kLength * (1 - std::pow(q, 5)) / (1 - q)), 1,
      2e-3);
}

}  // namespace
}  // namespace fjord
