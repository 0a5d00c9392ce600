#include "engine/geometry/triangulate.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numeric>

#include "engine/geometry/normals.h"
#include "engine/geometry/primitives.h"
#include "tests/geometry/shapes.h"

namespace fjord {
namespace {

std::vector<uint32_t> FirstNumbers(size_t n) {
  std::vector<uint32_t> polygon(n);
  std::iota(polygon.begin(), polygon.end(), 0u);
  return polygon;
}

std::vector<Triangle> Cut(const std::vector<Vec3>& points, const std::vector<uint32_t>& polygon) {
  std::vector<Triangle> triangles;
  TriangulatePolygon(points, polygon, &triangles);
  return triangles;
}

// All triangles turn with the polygon and their areas add up to its: then they neither overlap nor
// leave a gap.
void ExpectTiles(const std::vector<Vec3>& points, const std::vector<uint32_t>& polygon) {
  const std::vector<Triangle> triangles = Cut(points, polygon);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  const Vec3 whole = AreaVector(points, polygon);
  const double size = Length(whole);
  double sum = 0;
  for (const Triangle& t : triangles) {
    const double part = glm::dot(AreaVector(points, t), whole) / size;
    EXPECT_GE(part, -1e-12 * size);
    sum += part;
    EXPECT_LT(t[0], std::min(t[1], t[2]));
  }
  EXPECT_NEAR(sum, size, 1e-9 * size);
}

TEST(TriangulateTest, ConvexFacesBecomeAFanFromTheSmallestVertex) {
  const std::vector<Vec3> points = {{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 2, 0}};
  const std::vector<Triangle> want = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  EXPECT_EQ(Cut(points, {0, 1, 2, 3, 4}), want);
  EXPECT_EQ(Cut(points, {3, 4, 0, 1, 2}), want);
  EXPECT_EQ(Cut(points, {2, 3, 1}), (std::vector<Triangle>{{1, 2, 3}}));
}

TEST(TriangulateTest, ConcaveQuadIsCutInside) {
  // The corner 2 is pushed in: the diagonal 1-3 would run outside.
  const std::vector<Vec3> points = {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}};
  EXPECT_EQ(Cut(points, {0, 1, 2, 3}), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(Cut(points, {1, 2, 3, 0}), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  ExpectTiles({{0, 0, 0}, {1, 1, 0}, {4, 0, 0}, {1, 4, 0}}, {0, 1, 2, 3});
}

TEST(TriangulateTest, CombIsTiled) {
  std::vector<Vec3> comb = {{0, 0, 0}, {20, 0, 0}};
  for (int x = 20; x >= 0; --x) comb.push_back({double(x), x % 2 ? .5 : 10., 0});
  ExpectTiles(comb, FirstNumbers(comb.size()));
}

TEST(TriangulateTest, TiltedPlanesAreTiled) {
  std::vector<Vec3> star;
  for (int i = 0; i < 14; ++i) {
    const double r = i % 2 ? 1 : 3, a = i * 3.14159265358979 / 7;
    star.push_back({r * std::cos(a), r * std::sin(a), 0});
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (double sign : {1., -1.}) {
      std::vector<Vec3> turned;
      for (const Vec3& p : star) {
        Vec3 q(0);
        q[(axis + 1) % 3] = p.x;
        q[(axis + 2) % 3] = sign * p.y;
        q[axis] = .25 * p.x - .5 * p.y;
        turned.push_back(q);
      }
      ExpectTiles(turned, FirstNumbers(turned.size()));
    }
  }
}

TEST(TriangulateTest, CornersOnOneLineLeaveNoGap) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                    {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
  ExpectTiles(points, FirstNumbers(8));
  for (const Triangle& t : Cut(points, FirstNumbers(8))) {
    EXPECT_GT(Length(AreaVector(points, t)), 0);
  }
}

// Star-shaped outlines: random radii at rising angles.
RC_GTEST_PROP(TriangulateTest, RandomOutlinesAreTiled, ()) {
  const auto radii = *rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 1000));
  RC_PRE(radii.size() >= 3);
  std::vector<Vec3> points;
  for (size_t i = 0; i < radii.size(); ++i) {
    const double a = 2 * 3.14159265358979 * double(i) / double(radii.size());
    points.push_back({radii[i] * std::cos(a), radii[i] * std::sin(a), 1});
  }
  const auto polygon = FirstNumbers(points.size());
  const auto triangles = Cut(points, polygon);
  RC_ASSERT(triangles.size() == polygon.size() - 2);
  const double whole = AreaVector(points, polygon).z;
  double sum = 0;
  for (const Triangle& t : triangles) {
    const double part = AreaVector(points, t).z;
    RC_ASSERT(part >= -1e-9 * std::abs(whole));
    sum += part;
  }
  RC_ASSERT(std::abs(sum - whole) <= 1e-9 * std::abs(whole));
  // Where a face starts in the file makes no difference.
  auto turned = polygon;
  std::rotate(turned.begin(), turned.begin() + long(turned.size() / 2), turned.end());
  RC_ASSERT(Cut(points, turned) == triangles);
}

RC_GTEST_PROP(TriangulateTest, AnyPolygonGivesTwoTrianglesLessThanCorners, ()) {
  const auto numbers = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-3, 4));
  std::vector<Vec3> points;
  for (size_t i = 0; i + 1 < numbers.size(); i += 2) {
    points.push_back({double(numbers[i]), double(numbers[i + 1]), 0});
  }
  RC_PRE(points.size() >= 3);
  RC_ASSERT(Cut(points, FirstNumbers(points.size())).size() == points.size() - 2);
}

TEST(TriangulateTest, FractalOutlineOfManyCornersIsTiled) {
  // A Koch snowflake, 3 * 4^6 = 12288 corners.
  std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {.5, std::sqrt(.75), 0}};
  for (int level = 0; level < 6; ++level) {
    std::vector<Vec3> next;
    for (size_t i = 0; i < points.size(); ++i) {
      const Vec3 a = points[i], d = (points[(i + 1) % points.size()] - a) / 3.;
      next.push_back(a);
      next.push_back(a + d);
      next.push_back(a + d * 1.5 + Vec3(d.y, -d.x, 0) * std::sqrt(.75));
      next.push_back(a + d * 2.);
    }
    points = next;
  }
  ExpectTiles(points, FirstNumbers(points.size()));
}

TEST(TriangulateTest, HugeFoldedPolygonEnds) {
  std::minstd_rand random(7);
  std::vector<Vec3> points;
  for (int i = 0; i < 20'000; ++i)
    points.push_back({double(random() % 999), double(random() % 999), 0});
  EXPECT_EQ(Cut(points, FirstNumbers(points.size())).size(), points.size() - 2);
}

TEST(TriangulateTest, MeshKeepsTheOrderOfItsFaces) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
  mesh.AddFace(std::vector<uint32_t>{4, 2, 1});
  mesh.AddFace(std::vector<uint32_t>{2, 3, 0, 1});
  EXPECT_EQ(Triangulate(mesh), (std::vector<Triangle>{{1, 4, 2}, {0, 1, 2}, {0, 2, 3}}));
}

}  // namespace
}  // namespace fjord
