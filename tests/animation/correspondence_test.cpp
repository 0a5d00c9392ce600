#include "engine/animation/correspondence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "engine/animation/outline.h"
#include "tests/animation/animate.h"

namespace fjord {
namespace {

using ::testing::HasSubstr;

Geometry Curve(std::vector<Vec3> points, bool closed) {
  Geometry curve;
  curve.curve = true;
  curve.closed = closed;
  curve.points = std::move(points);
  return curve;
}

Geometry Ring(int count, double radius, double turn, const Vec3& center = Vec3(0)) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double angle = turn + 2 * 3.14159265358979 * i / count;
    points.push_back(center + radius * Vec3(std::cos(angle), std::sin(angle), 0));
  }
  return Curve(points, true);
}

double DistanceToCurve(const Geometry& curve, const Vec3& point) {
  double least = 1e300;
  const size_t count = curve.points.size();
  for (size_t i = 0; i + (curve.closed ? 0 : 1) < count; ++i) {
    const Vec3 a = curve.points[i], b = curve.points[(i + 1) % count];
    const double whole = glm::dot(b - a, b - a);
    const double t = whole > 0 ? std::clamp(glm::dot(point - a, b - a) / whole, 0., 1.) : 0;
    least = std::min(least, Length(point - (a + (b - a) * t)));
  }
  return least;
}

// C1 and C2 for every key; the numbers of a key's own vertices run in order (round, when closed).
void ExpectRefined(const std::vector<Geometry>& keys, const AlignedKeys& aligned) {
  ASSERT_EQ(aligned.points.size(), keys.size());
  for (size_t k = 0; k < keys.size(); ++k) {
    ASSERT_EQ(aligned.points[k].size(), aligned.points[0].size());
    ASSERT_EQ(aligned.number_of[k].size(), keys[k].points.size());
    int descents = 0;
    for (size_t v = 0; v < keys[k].points.size(); ++v) {
      const uint32_t number = aligned.number_of[k][v];
      ASSERT_LT(number, aligned.points[k].size());
      EXPECT_EQ(aligned.points[k][number], keys[k].points[v]) << "key " << k << " vertex " << v;
      if (v > 0) descents += aligned.number_of[k][v - 1] > number ? 1 : 0;
    }
    EXPECT_LE(descents, keys[k].closed ? 1 : 0) << "key " << k;
    for (const Vec3& point : aligned.points[k]) EXPECT_LT(DistanceToCurve(keys[k], point), 1e-9);
  }
}

TEST(CorrespondenceTest, S25_OutlinesOfDifferentCountsGetTheUnionOfTheirPoints) {
  const std::vector<Geometry> keys = {Curve({{0, 0, 0}, {4, 0, 0}}, false),
                                      Curve({{0, 1, 0}, {1, 1, 0}, {4, 1, 0}}, false)};
  const AlignedKeys aligned = AlignOutlines(keys, std::vector<PointPairs>(2));
  ExpectRefined(keys, aligned);
  ASSERT_EQ(aligned.points[0].size(), 3u);
  EXPECT_EQ(aligned.points[0][1], Vec3(1, 0, 0));
}

TEST(CorrespondenceTest, S25_PairedPointsAreAnchors) {
  const std::vector<Geometry> keys = {Curve({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {4, 0, 0}}, false),
                                      Curve({{0, 1, 0}, {3, 1, 0}, {4, 1, 0}}, false)};
  const AlignedKeys aligned = AlignOutlines(keys, std::vector<PointPairs>{{}, {{1, 1}}});
  ExpectRefined(keys, aligned);
  EXPECT_EQ(aligned.number_of[0][1], aligned.number_of[1][1]);
  ASSERT_EQ(aligned.points[0].size(), 4u) << "the ends meet too";
  EXPECT_NEAR(aligned.points[1][2].x, 3 + 1 / 3., 1e-12) << "a third of the way after the anchor";
}

TEST(CorrespondenceTest, S25_ClosedAnchorsMayStartAnywhere) {
  const std::vector<Geometry> keys = {Ring(7, 1, 0), Ring(5, 2, 1)};
  for (uint32_t from = 0; from < 7; ++from) {
    for (uint32_t to = 0; to < 5; ++to) {
      const PointPairs pairs = {{from, to}, {(from + 3) % 7, (to + 2) % 5}};
      const AlignedKeys aligned = AlignOutlines(keys, std::vector<PointPairs>{{}, pairs});
      ExpectRefined(keys, aligned);
      for (const auto& [a, b] : pairs) EXPECT_EQ(aligned.number_of[0][a], aligned.number_of[1][b]);
    }
  }
}

TEST(CorrespondenceTest, S25_ComputedStartsFindTheTurn) {
  const Geometry ring = Ring(12, 1, 0);
  Geometry egg = ring;
  for (Vec3& point : egg.points) point.x *= point.x > 0 ? 3 : 1;  // one long side
  for (const uint32_t turn : {0u, 1u, 5u, 11u}) {
    Geometry turned = egg;
    std::rotate(turned.points.begin(), turned.points.begin() + turn, turned.points.end());
    for (Vec3& point : turned.points) point += Vec3(100, -50, 3);  // centred before it is compared
    const BestStart start = FindBestStart(egg, turned);
    EXPECT_EQ(start.vertex, (12 - turn) % 12);
    EXPECT_FALSE(start.reversed);
    std::reverse(turned.points.begin(), turned.points.end());
    EXPECT_TRUE(FindBestStart(egg, turned).reversed);
    EXPECT_EQ(turned.points[FindBestStart(egg, turned).vertex], egg.points[0] + Vec3(100, -50, 3));
  }
}

TEST(CorrespondenceTest, S25_PointsAtOnePlaceOfTheOutlineBecomeOne) {
  const std::vector<Geometry> keys = {Curve({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, false),
                                      Curve({{0, 0, 0}, {1 + 1e-7, 0, 0}, {2, 0, 0}}, false),
                                      Curve({{0, 0, 0}, {1 + 1e-4, 0, 0}, {2, 0, 0}}, false)};
  EXPECT_EQ(AlignOutlines(std::span(keys).first(2), std::vector<PointPairs>(2)).points[0].size(),
            3u);
  EXPECT_EQ(AlignOutlines(keys, std::vector<PointPairs>(3)).points[0].size(), 4u);
}

TEST(CorrespondenceTest, S25_AnIslandMayGrowOutOfOnePoint) {
  const std::vector<Geometry> keys = {Curve({{1, 1, 0}, {1, 1, 0}, {1, 1, 0}}, true),
                                      Ring(9, 2, .3)};
  const AlignedKeys aligned = AlignOutlines(keys, std::vector<PointPairs>(2));
  ExpectRefined(keys, aligned);
  for (const Vec3& point : aligned.points[0]) EXPECT_EQ(point, Vec3(1, 1, 0));
}

rc::Gen<std::vector<Vec3>> Points() {
  return rc::gen::suchThat(
      rc::gen::container<std::vector<Vec3>>(rc::gen::map(
          rc::gen::tuple(rc::gen::inRange(-40, 40), rc::gen::inRange(-40, 40)),
          [](const auto& xy) { return Vec3(std::get<0>(xy) * .37, std::get<1>(xy) * .53, 0); })),
      [](const auto& points) { return points.size() >= 3; });
}

// Pairs in the same order on both sides; cyclic where `turn` > 0.
PointPairs RandomPairs(size_t from, size_t to, bool closed) {
  const auto count = *rc::gen::inRange<size_t>(0, std::min(from, to) + 1);
  const auto choose = [&](size_t size) {
    std::vector<uint32_t> all(size), chosen;
    for (uint32_t i = 0; i < size; ++i) all[i] = i;
    size_t left = count;
    for (uint32_t i = 0; i < size && left > 0; ++i) {
      if (size - i == left || *rc::gen::arbitrary<bool>()) {
        chosen.push_back(i);
        --left;
      }
    }
    return chosen;
  };
  std::vector<uint32_t> a = choose(from), b = choose(to);
  if (closed && count > 0) {
    std::rotate(b.begin(), b.begin() + static_cast<long>(*rc::gen::inRange<size_t>(0, count)),
                b.end());
  }
  PointPairs pairs;
  for (size_t i = 0; i < a.size(); ++i) pairs.emplace_back(a[i], b[i]);
  return pairs;
}

RC_GTEST_PROP(CorrespondenceProperty, S25_OriginalPointsAndTheirOrderAreKept, ()) {
  const bool closed = *rc::gen::arbitrary<bool>();
  const auto count = *rc::gen::inRange<size_t>(2, 5);
  std::vector<Geometry> keys;
  std::vector<PointPairs> pairs(1);
  for (size_t k = 0; k < count; ++k) {
    keys.push_back(Curve(*Points(), closed));
    if (k > 0)
      pairs.push_back(RandomPairs(keys[k - 1].points.size(), keys[k].points.size(), closed));
  }
  const AlignedKeys aligned = AlignOutlines(keys, pairs);
  for (size_t k = 0; k < count; ++k) {
    RC_ASSERT(aligned.points[k].size() == aligned.points[0].size());
    int descents = 0;
    for (size_t v = 0; v < keys[k].points.size(); ++v) {
      const uint32_t number = aligned.number_of[k][v];
      RC_ASSERT(number < aligned.points[k].size());
      RC_ASSERT(aligned.points[k][number] == keys[k].points[v]);
      if (v > 0) descents += aligned.number_of[k][v - 1] > number ? 1 : 0;
    }
    RC_ASSERT(descents <= (closed ? 1 : 0));
    for (const Vec3& point : aligned.points[k]) RC_ASSERT(DistanceToCurve(keys[k], point) < 1e-9);
    for (const auto& [from, to] : k > 0 ? pairs[k] : PointPairs()) {
      RC_ASSERT(aligned.number_of[k - 1][from] == aligned.number_of[k][to]);
    }
  }
}

// The last point of the first outline lies on its first, at the end of its length, and is paired.
TEST(CorrespondenceTest, AnOutlineMayEndInThePointItBeganWith) {
  const std::vector<Geometry> keys = {
      Curve({Vec3(0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0)}, true),
      Curve({Vec3(0), Vec3(2, 0, 0), Vec3(2, 2, 0), Vec3(1, 2, 0), Vec3(0, 2, 0)}, true)};
  const std::vector<PointPairs> pairs = {{}, {{3, 2}, {0, 4}}};
  const AlignedKeys aligned = AlignOutlines(keys, pairs);
  for (size_t k = 0; k < 2; ++k) {
    for (size_t v = 0; v < keys[k].points.size(); ++v) {
      EXPECT_EQ(aligned.points[k][aligned.number_of[k][v]], keys[k].points[v]) << k << ' ' << v;
    }
  }
  EXPECT_EQ(aligned.number_of[0][3], aligned.number_of[1][2]);
  EXPECT_EQ(aligned.number_of[0][0], aligned.number_of[1][4]);
}

const std::string kSquare = "point {} point { x: 1 } point { x: 1 y: 1 } point { y: 1 }";

std::string Meshes(const std::string& second, const std::string& more) {
  return "output { frames: 2 }\nobjects { name: \"m\"\nkey { frame: 1 shape { mesh { " + kSquare +
         " face { v: [1,2,3] } face { v: [1,3,4] } } } }\nkey { frame: 2 shape { mesh { " + second +
         " } } " + more + " }";
}

TEST(CorrespondenceTest, S25_MeshPairsRenumberToTheFirstKey) {
  // the second key lists the corners backwards
  const auto animation = testing::Animate(Meshes(
      "point { y: 5 } point { x: 5 y: 5 } point { x: 5 } point {} face { v: [4,3,2] } face { v: "
      "[2,1,4] }",
      "pair { from: 1 to: 4 } pair { from: 2 to: 3 } pair { from: 3 to: 2 } pair { from: 4 to: 1 "
      "} }\ncorrespondence: BY_PAIRS"));
  ASSERT_NE(animation, nullptr);
  const v1::FrameScene end = testing::FrameOf(*animation, 2);
  EXPECT_EQ(testing::PointOf(end, 1, 1), Vec3(0));
  EXPECT_EQ(testing::PointOf(end, 1, 3), Vec3(5, 5, 0));
}

TEST(CorrespondenceTest, S25_FacesMayStandInAnotherOrder) {
  EXPECT_NE(testing::Animate(Meshes(kSquare + " face { v: [4,1,3] } face { v: [2,3,1] }", "}")),
            nullptr);
}

TEST(CorrespondenceTest, S25_ComputedOutlinesMorphInAScene) {
  const auto animation = testing::Animate(
      "output { frames: 9 }\nobjects { correspondence: COMPUTED\n"
      "key { frame: 1 shape { polyline { closed: true " +
      kSquare +
      " } } }\n"
      "key { frame: 9 shape { polyline { closed: true point { x: 3 } point { x: 3 y: 3 } point { "
      "y: 3 } "
      "point {} point { x: 1.5 } } } }\nfractal {} }");
  ASSERT_NE(animation, nullptr);
  const v1::FrameScene middle = testing::FrameOf(*animation, 5);
  EXPECT_EQ(middle.object(0).point_size(), 15);
  EXPECT_EQ(testing::PointOf(middle, 1, 1), Vec3(0)) << "corner to corner";
  EXPECT_TRUE(middle.object(0).curve() && middle.object(0).closed());
}

}  // namespace
}  // namespace fjord
