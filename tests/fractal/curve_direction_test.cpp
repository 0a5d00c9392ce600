// The four direction rules of curves (S10-S13), and what pictures of them were for.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random.h"
#include "engine/fractal/amount.h"
#include "engine/fractal/curve_chain.h"
#include "tests/fractal/collect.h"

namespace fjord {
namespace {

using test::OutlineCurve;
using test::Prepare;
using test::StraightCurve;
using test::Weld;

FractalSettings Rule(Direction direction, Variant variant, double epsilon, Law law = Law::kSimilar,
                     double H = .5) {
  FractalSettings s = test::SettingsOf("curve", epsilon);
  s.law = law;
  s.direction = direction;
  s.variant = variant;
  s.H = H;
  return s;
}

// Vertex i lies on this input edge.
size_t EdgeOf(const WeldedShape& shape, size_t i) {
  size_t edge = 0;
  for (size_t k = 1; k <= i; ++k) {
    edge += shape.level[k] == 0 ? 1 : 0;
  }
  return edge;
}

TEST(CurveDirectionTest, S10_FixedOffsetsAreParallel) {
  const CoarseShape outline = OutlineCurve();
  const WeldedShape shape = Weld(*Prepare(outline, Rule(Direction::kEdge, Variant::kFixed, .01)));
  for (size_t i = 0; i < shape.mesh.points.size(); ++i) {
    const size_t edge = EdgeOf(shape, i);
    const Vec3 a = outline.now[edge];
    const Vec3 along = outline.now[(edge + 1) % 12] - a;
    if (shape.level[i] > 0) {
      EXPECT_NEAR(glm::dot(shape.direction[i], Unit(along)), 0, 1e-14);
    }
    // Evenly spaced in the edge's own direction, for no offset has a part along it.
    const double share = glm::dot(shape.mesh.points[i] - a, along) / glm::dot(along, along);
    const double steps = share * 4096;
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
  }
}

// Can bend back: x of a curve along x is not monotone. The fixed rule cannot.
TEST(CurveDirectionTest, S11_CurrentRuleBendsBack) {
  const auto turns = [](Variant variant) {
    int back = 0;
    auto s = Rule(Direction::kEdge, variant, .002);
    const WeldedShape shape = Weld(*Prepare(StraightCurve(), s));
    for (size_t i = 1; i < shape.mesh.points.size(); ++i) {
      back += shape.mesh.points[i].x < shape.mesh.points[i - 1].x ? 1 : 0;
    }
    return back;
  };
  EXPECT_EQ(turns(Variant::kFixed), 0);
  EXPECT_GT(turns(Variant::kCurrent), 20);
  EXPECT_GT(turns(Variant::kPerturbed), 20);
}

// Direction against segment, of every halving.
std::vector<double> Cosines(const WeldedShape& shape) {
  std::vector<double> cosines;
  const size_t count = shape.level.size();
  for (size_t m = 1; m + 1 < count; ++m) {
    if (shape.level[m] == 0) {
      continue;
    }
    size_t a = m - 1;
    size_t b = m + 1;
    while (shape.level[a] >= shape.level[m]) --a;
    while (b < count && shape.level[b] >= shape.level[m]) ++b;
    const Vec3 along = shape.mesh.points[b % count] - shape.mesh.points[a];
    cosines.push_back(glm::dot(Unit(along), shape.direction[m]));
  }
  return cosines;
}

TEST(CurveDirectionTest, S11_CurrentNormalIsSquareToItsSegment) {
  for (const Direction direction : {Direction::kEdge, Direction::kVertex}) {
    for (const double cosine :
         Cosines(Weld(*Prepare(OutlineCurve(), Rule(direction, Variant::kCurrent, .02))))) {
      EXPECT_NEAR(cosine, 0, 1e-12);
    }
  }
}

// G20: offsets along the perpendicular only, in proportion to the segment.
TEST(CurveDirectionTest, G20_OffsetsScaleWithTheSegment) {
  double sums[2] = {0, 0};
  for (const double length : {1.0, 4.0}) {
    for (uint64_t seed = 1; seed <= 200; ++seed) {
      auto s = Rule(Direction::kEdge, Variant::kCurrent, .6 * length);
      s.seed = seed;
      const WeldedShape shape = Weld(*Prepare(StraightCurve(length), s));
      ASSERT_EQ(shape.mesh.points.size(), 3u);
      EXPECT_EQ(shape.mesh.points[1].x, length / 2);
      sums[length > 1] += shape.mesh.points[1].y * shape.mesh.points[1].y;
    }
  }
  EXPECT_NEAR(std::sqrt(sums[1] / sums[0]), 4, 1e-12);
}

TEST(CurveDirectionTest, S12_PerturbedNormalHasASmallTangentPart) {
  const WeldedShape shape =
      Weld(*Prepare(OutlineCurve(), Rule(Direction::kEdge, Variant::kPerturbed, .01)));
  double sum = 0;
  double squares = 0;
  const std::vector<double> cosines = Cosines(shape);
  for (const double cosine : cosines) {
    EXPECT_LE(std::abs(cosine), .5 / std::sqrt(1.25) + 1e-12);
    sum += cosine;
    squares += cosine * cosine;
  }
  const auto count = static_cast<double>(cosines.size());
  EXPECT_NEAR(sum / count, 0, .03);
  EXPECT_NEAR(std::sqrt(squares / count), 1.0 / 6, .02);  // mean of three uniforms in +-.5

  auto none = Rule(Direction::kEdge, Variant::kPerturbed, .01);
  none.perturb = 0;
  const WeldedShape straight = Weld(*Prepare(OutlineCurve(), none));
  const WeldedShape current =
      Weld(*Prepare(OutlineCurve(), Rule(Direction::kEdge, Variant::kCurrent, .01)));
  ASSERT_EQ(straight.identity, current.identity);
  for (size_t i = 0; i < current.mesh.points.size(); ++i) {
    EXPECT_LT(Length(straight.mesh.points[i] - current.mesh.points[i]), 1e-13);
  }
}

// Near an input vertex the directions of both sides meet in the vertex's own; the edge rule's jump.
TEST(CurveDirectionTest, S13_NoKinkAtInputVertices) {
  const auto largest_jump = [](Direction direction) {
    const WeldedShape shape =
        Weld(*Prepare(OutlineCurve(), Rule(direction, Variant::kFixed, .002, Law::kAffine, .7)));
    const size_t count = shape.level.size();
    double largest = 0;
    for (size_t i = 0; i < count; ++i) {
      if (shape.level[i] == 0) {
        const Vec3 before = shape.direction[(i + count - 1) % count];
        const Vec3 after = shape.direction[(i + 1) % count];
        largest = std::max(largest, Length(after - before));
      }
    }
    return largest;
  };
  EXPECT_LT(largest_jump(Direction::kVertex), .01);
  EXPECT_GT(largest_jump(Direction::kEdge), .5);
}

TEST(CurveDirectionTest, S13_NewVerticesKeepTheMeanOfTheirEnds) {
  const WeldedShape shape =
      Weld(*Prepare(OutlineCurve(), Rule(Direction::kVertex, Variant::kFixed, .3)));
  const size_t count = shape.level.size();
  for (size_t m = 0; m < count; ++m) {
    if (shape.level[m] > 0) {
      size_t a = m;
      size_t b = m;
      do a = (a + count - 1) % count;
      while (shape.level[a] >= shape.level[m]);
      do b = (b + 1) % count;
      while (shape.level[b] >= shape.level[m]);
      EXPECT_LT(Length(Unit(shape.direction[a] + shape.direction[b]) - shape.direction[m]), 1e-14);
    }
  }
}

TEST(CurveDirectionTest, S13_InputVerticesHaveTheMeanOfTheirEdges) {
  const CoarseShape outline = OutlineCurve();
  const CurveChain chain = *MakeCurveChain(outline, test::SettingsOf("curve", .1));
  const auto right = [&](size_t i) {
    const Vec3 along = outline.now[(i + 1) % 12] - outline.now[i % 12];
    return Unit(Vec3(along.y, -along.x, 0));
  };
  for (size_t i = 0; i < 12; ++i) {
    EXPECT_LT(Length(chain.vertices[i].direction - Unit(right(i + 11) + right(i))), 1e-14) << i;
  }
}

TEST(CurveDirectionTest, S10_UpMovesAlongZOnly) {
  const WeldedShape shape =
      Weld(*Prepare(OutlineCurve(), Rule(Direction::kUp, Variant::kFixed, .05, Law::kAffine)));
  double highest = 0;
  for (size_t i = 0; i < shape.mesh.points.size(); ++i) {
    highest = std::max(highest, std::abs(shape.mesh.points[i].z));
  }
  EXPECT_GT(highest, .01);
}

// The normal of a closed counter-clockwise outline points outward, and the plane does not flip as a
// curve leaves z = 0.
TEST(CurveDirectionTest, S10_SidesAreTheChains) {
  const CoarseShape square = [] {
    CoarseShape s;
    s.curve = s.closed = true;
    s.now = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    s.rest = s.now;
    return s;
  }();
  const CurveChain chain = *MakeCurveChain(square, test::SettingsOf("curve", .1));
  EXPECT_EQ(chain.frames[0].normal, Vec3(0, -1, 0));
  EXPECT_EQ(chain.frames[1].normal, Vec3(1, 0, 0));
  EXPECT_LT(Length(chain.vertices[1].direction - Unit(Vec3(1, -1, 0))), 1e-15);
  std::vector<Vec3> points(square.now.rbegin(), square.now.rend());
  EXPECT_EQ(CurvePlane(points), Vec3(0, 0, 1));
  points[0].z = 1e-6;
  EXPECT_GT(CurvePlane(points).z, .999);
  // Upright curves: a ridge in x, z; an S whose area cancels; a bolt straight down.
  EXPECT_LT(Length(CurvePlane({{0, 2, 0}, {1, 2, 1}, {2, 2, 0}}) - Vec3(0, 1, 0)), 1e-12);
  EXPECT_LT(
      Length(CurvePlane({{0, 0, 0}, {1, 0, 1}, {2, 0, 0}, {3, 0, -1}, {4, 0, 0}}) - Vec3(0, 1, 0)),
      1e-12);
  EXPECT_EQ(CurvePlane({{0, 0, 5}, {0, 0, 0}}), Vec3(0, 1, 0));
}

TEST(CurveDirectionTest, C16a_MovingTheShapeMovesNoDetail) {
  const auto s = Rule(Direction::kVertex, Variant::kPerturbed, .02);
  CoarseShape moved = OutlineCurve();
  for (Vec3& p : moved.now) {
    p = Vec3(-p.y, p.x, 0) + Vec3(3, -7, 0);  // a quarter turn, and away
  }
  const WeldedShape here = Weld(*Prepare(OutlineCurve(), s));
  const WeldedShape there = Weld(*Prepare(moved, s));
  ASSERT_EQ(here.identity, there.identity);
  for (size_t i = 0; i < here.mesh.points.size(); ++i) {
    const Vec3& p = here.mesh.points[i];
    EXPECT_LT(Length(Vec3(-p.y, p.x, 0) + Vec3(3, -7, 0) - there.mesh.points[i]), 1e-12);
  }
}

// Whatever becomes of the shape, its rest pose says what is halved.
TEST(CurveDirectionTest, C16a_TheTreeIsTheSameInEveryFrame) {
  const auto s = Rule(Direction::kVertex, Variant::kPerturbed, .02);
  CoarseShape squeezed = OutlineCurve();
  for (Vec3& p : squeezed.now) {
    p = Vec3(2 * p.x, .1 * p.y, 0);
  }
  EXPECT_EQ(Weld(*Prepare(squeezed, s)).identity, Weld(*Prepare(OutlineCurve(), s)).identity);
}

// Stretch: half the size now, half the offsets; the same tree.
TEST(CurveDirectionTest, S25_OffsetsFollowTheSizeOfTheShape) {
  auto s = Rule(Direction::kEdge, Variant::kFixed, .02, Law::kAffine);
  CoarseShape small = OutlineCurve();
  for (Vec3& p : small.now) {
    p = p * .5;
  }
  const WeldedShape grown = Weld(*Prepare(OutlineCurve(), s));
  const WeldedShape young = Weld(*Prepare(small, s));
  ASSERT_EQ(grown.identity, young.identity);
  for (size_t i = 0; i < grown.mesh.points.size(); ++i) {
    EXPECT_LT(Length(grown.mesh.points[i] * .5 - young.mesh.points[i]), 1e-7);
  }
  s.stretch = false;
  const WeldedShape shredded = Weld(*Prepare(small, s));
  double most = 0;
  for (size_t i = 0; i < grown.mesh.points.size(); ++i) {
    most = std::max(most, Length(shredded.mesh.points[i] - young.mesh.points[i]));
  }
  EXPECT_GT(most, .01);
}

TEST(CurveDirectionTest, GoldenDigests) {
  const auto digest = [](Direction direction, Variant variant, Law law) {
    return test::DigestOf(
        test::WeldedLeaves(Weld(*Prepare(OutlineCurve(), Rule(direction, variant, .01, law, .7)))));
  };
  EXPECT_EQ(digest(Direction::kEdge, Variant::kFixed, Law::kAffine), "0708db0361d972b3");
  EXPECT_EQ(digest(Direction::kEdge, Variant::kCurrent, Law::kSimilar), "f7ff33a1277c0948");
  EXPECT_EQ(digest(Direction::kVertex, Variant::kPerturbed, Law::kSimilar), "dd643467711952b6");
  EXPECT_EQ(digest(Direction::kUp, Variant::kCurrent, Law::kShih), "e932d8471e2dde07");
  FractalSettings additions = Rule(Direction::kEdge, Variant::kFixed, .01, Law::kAffine, .7);
  additions.increments = Increments::kAdditions;
  EXPECT_EQ(test::DigestOf(test::WeldedLeaves(Weld(*Prepare(OutlineCurve(), additions)))),
            "b697e612f83f4479");
}

}  // namespace
}  // namespace fjord
