// Remeshing: no slivers, no long edges, and still the same shape with the same points.
#include "engine/geometry/remesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/geometry/border.h"
#include "engine/geometry/check_mesh.h"
#include "engine/geometry/edges.h"
#include "engine/geometry/triangulate.h"
#include "tests/geometry/shapes.h"

namespace fjord {
namespace {

constexpr double kPi = 3.14159265358979;

// Of triangles, in degrees.
double WorstAngle(const Mesh& mesh) {
  double worst = 180;
  for (size_t c = 0; c < mesh.face_vertex.size(); ++c) {
    const auto at = [&](size_t k) {
      return mesh.points[mesh.face_vertex[c - c % 3 + (c + k) % 3]];
    };
    const Vec3 u = at(1) - at(0), v = at(2) - at(0);
    worst = std::min(worst, std::atan2(Length(glm::cross(u, v)), glm::dot(u, v)) * 180 / kPi);
  }
  return worst;
}

Mesh Triangles(const Mesh& mesh) {
  Mesh made;
  made.points = mesh.points;
  for (const Triangle& t : Triangulate(mesh)) made.AddFace(t);
  return made;
}

double AreaOf(const Mesh& mesh) {
  double area = 0;
  for (const Triangle& t : Triangulate(mesh)) {
    const Vec3 a = mesh.points[t[0]];
    area += .5 * Length(glm::cross(mesh.points[t[1]] - a, mesh.points[t[2]] - a));
  }
  return area;
}

double LongestEdge(const Mesh& mesh) {
  double longest = 0;
  const EdgeTable table(mesh);
  for (const Edge& e : table.edges()) {
    longest = std::max(longest, Length(mesh.points[e.a] - mesh.points[e.b]));
  }
  return longest;
}

// An island of `count` points, with bays; tilted where asked.
Mesh Island(uint32_t count, bool tilted = false) {
  Mesh mesh;
  std::vector<uint32_t> corners;
  for (uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * kPi * i / count;
    const double radius = 1 + .3 * std::sin(3 * angle) + .1 * std::cos(11 * angle);
    const double x = radius * std::cos(angle), y = radius * std::sin(angle);
    mesh.points.push_back(tilted ? Vec3(x, y, .3 * x + .8 * y) : Vec3(x, y, 0));
    corners.push_back(i);
  }
  mesh.AddFace(corners);
  return mesh;
}

// All that Remesh promises of any mesh.
void ExpectKept(const Mesh& before, const Mesh& after, double longest) {
  ASSERT_GE(after.points.size(), before.points.size());
  for (size_t i = 0; i < before.points.size(); ++i) EXPECT_EQ(after.points[i], before.points[i]);
  for (const uint32_t size : after.face_size) ASSERT_EQ(size, 3u);
  EXPECT_NEAR(AreaOf(after), AreaOf(before), 1e-9 * AreaOf(before));
  EXPECT_LE(LongestEdge(after), longest);
  EXPECT_TRUE(CheckMesh(after).empty());
  EXPECT_EQ(CountMesh(after).euler, CountMesh(before).euler);
}

TEST(RemeshTest, AFanHasNoSliversAfterwards) {
  for (const uint32_t count : {40u, 200u, 1000u}) {
    for (const bool tilted : {false, true}) {
      const Mesh island = Island(count, tilted);
      EXPECT_LT(WorstAngle(Triangles(island)), 5);
      const Mesh even = Remesh(island, 10).value();
      EXPECT_GT(WorstAngle(even), 19.99) << count;
      EXPECT_LT(even.points.size(), 6 * island.points.size()) << count;
      ExpectKept(island, even, 10);
    }
  }
}

// A fan of triangles round a corner of the outline, as modellers write n-gons.
TEST(RemeshTest, AFanOfTrianglesIsNoOther) {
  Mesh fan;
  const uint32_t count = 60;
  for (uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * kPi * i / count;
    fan.points.emplace_back(std::cos(angle), .6 * std::sin(angle), 2);
    if (i >= 2) fan.AddFace(Triangle{0, i - 1, i});
  }
  EXPECT_LT(WorstAngle(fan), 2);
  const Mesh even = Remesh(fan, .5).value();
  EXPECT_GT(WorstAngle(even), 19.99);
  ExpectKept(fan, even, .5);
}

TEST(RemeshTest, BordersKeepTheirCourse) {
  const Mesh island = Island(120);
  const Mesh even = Remesh(island, .04).value();
  const std::vector<Chain> border = BorderOf(even);
  ASSERT_EQ(border.size(), 1u);
  // Between two points of the outline there are points of its edge and nothing else, in order.
  const auto& chain = border[0].vertices;
  size_t start = 0;
  while (chain[start] != 0) ++start;
  uint32_t last = 0;
  double along = 0;
  for (size_t k = 1; k < chain.size(); ++k) {
    const uint32_t v = chain[(start + k) % chain.size()];
    if (v < 120) {
      EXPECT_EQ(v, last + 1);
      last = v;
      along = 0;
      continue;
    }
    const Vec3 a = even.points[last], b = even.points[(last + 1) % 120], p = even.points[v];
    EXPECT_NEAR(Length(glm::cross(b - a, p - a)), 0, 1e-15);
    const double t = glm::dot(p - a, b - a) / glm::dot(b - a, b - a);
    EXPECT_GT(t, along);
    along = t;
  }
  EXPECT_EQ(last, 119u);
}

// A box whose top is a face of many corners: creases stay creases.
TEST(RemeshTest, CreasesAreKept) {
  Mesh prism;
  const uint32_t count = 48;
  std::vector<uint32_t> top, bottom;
  for (uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * kPi * i / count;
    prism.points.emplace_back(std::cos(angle), std::sin(angle), 0);
    prism.points.emplace_back(std::cos(angle), std::sin(angle), .2);
    bottom.insert(bottom.begin(), 2 * i);
    top.push_back(2 * i + 1);
    const uint32_t next = (i + 1) % count;
    prism.AddFace(std::array<uint32_t, 4>{2 * i, 2 * next, 2 * next + 1, 2 * i + 1});
  }
  prism.AddFace(top);
  prism.AddFace(bottom);
  ASSERT_TRUE(CountMesh(prism).closed);
  EXPECT_LT(WorstAngle(Triangles(prism)), 4.1);
  const Mesh even = Remesh(prism, 1).value();
  EXPECT_GT(WorstAngle(even), 19.99);
  EXPECT_TRUE(CountMesh(even).closed);
  ExpectKept(prism, even, 1);
}

TEST(RemeshTest, SliversAreCounted) {
  EXPECT_EQ(CountSlivers(Tetrahedron()), 0u);
  const Mesh fan = Triangles(Island(200));
  EXPECT_GT(CountSlivers(fan), 150u);
  EXPECT_EQ(CountSlivers(Remesh(fan, 10).value()), 0u);
  Mesh flat = TwoTriangles();
  flat.points[2] = {.5, 0, 0};  // no area
  EXPECT_EQ(CountSlivers(flat), 1u);
}

TEST(RemeshTest, AnEvenMeshStaysAsItIs) {
  const Mesh square = TwoTriangles();
  const Mesh even = Remesh(square, 2).value();
  EXPECT_EQ(even.points, square.points);
  EXPECT_EQ(even.face_vertex, square.face_vertex);
  const Mesh solid = Tetrahedron();
  EXPECT_EQ(Remesh(solid, 2).value().face_vertex, solid.face_vertex);
}

TEST(RemeshTest, LongEdgesAreDividedEverywhere) {
  for (const double longest : {.3, .05}) {
    const Mesh even = Remesh(Tetrahedron(), longest).value();
    ExpectKept(Tetrahedron(), even, longest);
    EXPECT_TRUE(CountMesh(even).closed);
  }
}

// A corner of 3 degrees can't be mended, and does not take for ever.
TEST(RemeshTest, SharpCornersEndTheWork) {
  Mesh needle;
  needle.points = {{0, 0, 0}, {10, 0, 0}, {10, .5, 0}, {4, .3, 0}};
  needle.AddFace(std::array<uint32_t, 4>{0, 1, 2, 3});
  const Mesh even = Remesh(needle, 20).value();
  ExpectKept(needle, even, 20);
  EXPECT_LT(even.points.size(), 1000u);
}

TEST(RemeshTest, ColoursAreMeansOfTheirNeighbours) {
  Mesh square = TwoTriangles();
  square.colors = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Mesh even = Remesh(square, .2).value();
  ASSERT_EQ(even.colors.size(), even.points.size());
  for (size_t i = 0; i < even.points.size(); ++i) {
    EXPECT_NEAR(even.colors[i].r, even.points[i].x, 1e-6);
    EXPECT_NEAR(even.colors[i].g, even.points[i].y, 1e-6);
  }
}

// Three faces at one edge, and two that turn against each other, are no pair: their edge stays.
TEST(RemeshTest, EdgesOfNoPairStayWhole) {
  Mesh book = TwoTriangles();
  book.points.emplace_back(.5, .5, 1);
  book.AddFace(Triangle{0, 2, 4});
  const Mesh even = Remesh(book, .3).value();
  EXPECT_NEAR(AreaOf(even), AreaOf(book), 1e-12);
  size_t of_three = 0;
  const EdgeTable table(even);
  for (const Edge& edge : table.edges()) of_three += edge.use_count == 3 ? 1 : 0;
  EXPECT_EQ(of_three, 1u);
}

// Stars with spikes, bays and points next to one another keep all that is promised.
TEST(RemeshTest, AnyOutlineKeepsItsShape) {
  std::minstd_rand random(5);
  const auto draw = [&random] { return random() / double{std::minstd_rand::max()}; };
  for (int round = 0; round < 60; ++round) {
    Mesh star;
    std::vector<uint32_t> corners;
    double angle = 0;
    while (angle < 2 * kPi - .001 && corners.size() < 200) {
      const double radius = .05 + draw() * draw();
      corners.push_back(static_cast<uint32_t>(star.points.size()));
      star.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
      angle += draw() < .2 ? .001 : .001 + draw();
    }
    star.AddFace(corners);
    const double longest = .05 + draw();
    const Mesh even = Remesh(star, longest).value();
    EXPECT_NEAR(AreaOf(even), AreaOf(star), 1e-9) << round;
    EXPECT_LE(LongestEdge(even), longest) << round;
    EXPECT_EQ(CountMesh(even).euler, 1) << round;
    EXPECT_LT(even.points.size(), 20'000u) << round;
  }
}

// Triangles anyhow, as damaged files have them: the work ends, and no point is lost.
TEST(RemeshTest, AnyTrianglesEndTheWork) {
  std::minstd_rand random(6);
  for (int round = 0; round < 300; ++round) {
    Mesh soup;
    const bool flat = round % 2 == 0;
    const uint32_t points = 4 + random() % 12;
    for (uint32_t i = 0; i < points; ++i) {
      soup.points.emplace_back(random() % 7, random() % 7, flat ? 0 : random() % 3);
    }
    for (uint32_t f = random() % 20 + 1; f > 0; --f) {
      const uint32_t a = random() % points, b = random() % points, c = random() % points;
      if (a != b && b != c && c != a) soup.AddFace(Triangle{a, b, c});
    }
    const Mesh even = Remesh(soup, .8).value();
    ASSERT_GE(even.points.size(), points);
    for (uint32_t i = 0; i < points; ++i) EXPECT_EQ(even.points[i], soup.points[i]);
    EXPECT_GE(even.FaceCount(), soup.FaceCount());
    EXPECT_LT(even.points.size(), 100'000u);
  }
}

TEST(RemeshTest, TooManyPointsAreRefusedBeforeTheyAreMade) {
  const auto mesh = Remesh(TwoTriangles(), 1e-9);
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::kLimit);
  const auto curve = DivideCurve({{{0, 0, 0}, {1, 0, 0}}, false}, 1e-300);
  ASSERT_FALSE(curve);
  EXPECT_EQ(curve.error().code, ErrorCode::kLimit);
}

TEST(DivideCurveTest, LongPiecesBecomeEqualOnesAndPointsStay) {
  const Polyline curve = {{{0, 0, 0}, {1, 0, 0}, {1, .1, 0}, {0, .1, 0}}, true};
  const Polyline even = DivideCurve(curve, .3).value();
  EXPECT_TRUE(even.closed);
  ASSERT_EQ(even.points.size(), 4u + 3 + 3);
  EXPECT_EQ(even.points[0], curve.points[0]);
  EXPECT_EQ(even.points[1], Vec3(.25, 0, 0));
  EXPECT_EQ(even.points[4], curve.points[1]);
  EXPECT_EQ(even.points[5], curve.points[2]);
  EXPECT_EQ(even.points[9], curve.points[3]);
  // Just as long as allowed is not divided; an open curve has no piece from its end to its start.
  EXPECT_EQ(DivideCurve({{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, false}, 1).value().points.size(), 3u);
  EXPECT_EQ(DivideCurve({{{0, 0, 0}, {1, 0, 0}, {0, 3, 0}}, false}, 10).value().points.size(), 3u);
}

}  // namespace
}  // namespace fjord
