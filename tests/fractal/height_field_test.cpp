// Height fields: every sample drawn once, no crack where fine meets coarse, nothing lost by
// culling.
#include "engine/fractal/height_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "engine/geometry/heights.h"
#include "tests/fractal/collect.h"

namespace fjord {
namespace {

using test::CollectSink;
using test::Leaf;

// A rough field: hashed samples, so that no two neighbours agree by chance.
HeightField Field(uint32_t columns, uint32_t rows, double height = .3) {
  std::vector<float> samples;
  for (uint32_t i = 0; i < columns * rows; ++i) {
    samples.push_back(static_cast<float>(Mix64(i) >> 40) / (1 << 24));
  }
  return {SampledHeights(columns, rows, std::move(samples)), Vec3(2, 2. * rows / columns, height)};
}

std::unique_ptr<PreparedFractal> Prepared(const HeightField& field, const Fineness& fineness = {}) {
  auto prepared = PrepareHeights(field, field.size, fineness, 1);
  EXPECT_TRUE(prepared.ok());
  return std::move(*prepared);
}

Fineness SeenFrom(const Vec3& eye, double pixels) {
  Fineness fineness;
  fineness.pixels = pixels;
  fineness.focal = 500;
  fineness.near = .001;
  fineness.eye = eye;
  return fineness;
}

// Area of the leaves from above; the border of the mesh as edges that one leaf has.
struct Ground {
  double area = 0;
  uint64_t clockwise = 0;
  uint64_t inner_borders = 0;  // edges with one leaf that do not lie on the border of the field
  uint64_t overused = 0;
};
Ground GroundOf(const std::vector<Leaf>& leaves, const Vec3& size) {
  const auto place = [](const test::Corner& c, int k) { return std::bit_cast<double>(c.bits[k]); };
  Ground ground;
  std::map<std::pair<uint64_t, uint64_t>, std::pair<int, bool>> edges;
  for (const Leaf& leaf : leaves) {
    double turn = 0;
    for (int k = 0; k < 3; ++k) {
      const test::Corner &a = leaf[k], &b = leaf[(k + 1) % 3];
      turn += place(a, 0) * place(b, 1) - place(b, 0) * place(a, 1);
      const auto on = [&](int axis, double at) {
        return std::abs(std::abs(place(a, axis)) - at) < 1e-12 && place(a, axis) == place(b, axis);
      };
      auto& [uses, border] = edges[std::minmax(a.id, b.id)];
      ++uses;
      border = on(0, size.x / 2) || on(1, size.y / 2);
    }
    ground.area += turn / 2;
    ground.clockwise += turn <= 0 ? 1 : 0;
  }
  for (const auto& [edge, use] : edges) {
    ground.inner_borders += use.first == 1 && !use.second ? 1 : 0;
    ground.overused += use.first > 2 ? 1 : 0;
  }
  return ground;
}

void ExpectWhole(const HeightField& field, const std::vector<Leaf>& leaves) {
  const Ground ground = GroundOf(leaves, field.size);
  EXPECT_NEAR(ground.area, field.size.x * field.size.y, 1e-9);
  EXPECT_EQ(ground.clockwise, 0u);
  EXPECT_EQ(ground.inner_borders, 0u) << "a crack";
  EXPECT_EQ(ground.overused, 0u);
}

TEST(HeightFieldTest, EverySampleIsDrawnWhereAllIsAskedFor) {
  for (const auto& [columns, rows] :
       {std::pair(2u, 2u), {3u, 2u}, {65u, 65u}, {257u, 65u}, {300u, 131u}, {258u, 34u}}) {
    const HeightField field = Field(columns, rows);
    const auto prepared = Prepared(field);
    const std::vector<Leaf> leaves = test::StreamedLeaves(*prepared);
    EXPECT_EQ(leaves.size(), 2u * (columns - 1) * (rows - 1)) << columns << "x" << rows;
    ExpectWhole(field, leaves);
    const Result<WeldedShape> welded = prepared->Weld({});
    ASSERT_TRUE(welded.ok());
    EXPECT_EQ(welded->mesh.points.size(), size_t{columns} * rows);
    EXPECT_EQ(test::WeldedLeaves(*welded), leaves);
  }
}

TEST(HeightFieldTest, S21_FineMeetsCoarseWithoutACrack) {
  const HeightField field = Field(337, 305, .05);
  size_t before = 2u * 336 * 304;
  for (const double pixels : {8., 40., 150.}) {
    const auto prepared = Prepared(field, SeenFrom(Vec3(-.9, -.3, .1), pixels));
    const std::vector<Leaf> leaves = test::StreamedLeaves(*prepared);
    EXPECT_LT(leaves.size(), before) << pixels;
    EXPECT_GT(leaves.size(), 100u) << pixels;
    before = leaves.size();
    ExpectWhole(field, leaves);
    const Result<WeldedShape> welded = prepared->Weld({});
    ASSERT_TRUE(welded.ok());
    EXPECT_EQ(test::WeldedLeaves(*welded), leaves);
  }
}

TEST(HeightFieldTest, SizesThatCannotBeHalvedAreDrawnWhole) {
  const HeightField field = Field(300, 131);
  const auto prepared = Prepared(field, SeenFrom(Vec3(-.9, -.3, .1), 40));
  const std::vector<Leaf> leaves = test::StreamedLeaves(*prepared);
  EXPECT_EQ(leaves.size(), 2u * 299 * 130);
  ExpectWhole(field, leaves);
}

TEST(HeightFieldTest, TheRestPoseDecidesWhatIsHalved) {
  const HeightField low = Field(129, 129, .01), high = Field(129, 129, 5);
  Fineness fineness;
  fineness.epsilon = .08;
  const auto ids = [](const PreparedFractal& prepared) {
    std::vector<std::array<uint64_t, 3>> all;
    for (const Leaf& leaf : test::StreamedLeaves(prepared)) {
      std::array<uint64_t, 3> three = {leaf[0].id, leaf[1].id, leaf[2].id};
      std::sort(three.begin(), three.end());
      all.push_back(three);
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  const auto now = PrepareHeights(low, high.size, fineness, 1);
  ASSERT_TRUE(now.ok());
  EXPECT_EQ(ids(**now), ids(*Prepared(high, fineness)));
  EXPECT_NE(ids(**now), ids(*Prepared(low, fineness)));
}

TEST(HeightFieldTest, S7_WhatIsMadeLiesWithinWhatWasAsked) {
  const HeightField field = Field(301, 277);
  const auto prepared = Prepared(field);
  for (size_t root = 0; root < prepared->RootCount(); ++root) {
    // holds the triangle asked for last, and its reach
    class Checked final : public CollectSink {
     public:
      void Take(const StreamBatch& batch) override {
        for (const StreamVertex& v : batch.vertices) {
          // over the triangle widened by `around`, and within `along` of its plane's corners
          const double low = std::min({a.z, b.z, c.z}) - reach.along - reach.around;
          const double high = std::max({a.z, b.z, c.z}) + reach.along + reach.around;
          outside += v.position.z < low || v.position.z > high ? 1 : 0;
          const Vec3 corner[3] = {a, b, c};
          for (int k = 0; k < 3; ++k) {
            const Vec3 p = corner[k], q = corner[(k + 1) % 3];
            const double dx = q.x - p.x, dy = q.y - p.y, length = std::sqrt(dx * dx + dy * dy);
            const double right = ((v.position.x - p.x) * dy - (v.position.y - p.y) * dx) / length;
            outside += right > reach.around + 1e-12 ? 1 : 0;
          }
        }
        made += batch.vertices.size();
      }
      Vec3 a{0}, b{0}, c{0};
      StreamReach reach{0};
      size_t outside = 0, made = 0;
    } checked;
    checked.wanted = [&](const Vec3& p, const Vec3& q, const Vec3& r, const StreamReach& its) {
      checked.a = p;
      checked.b = q;
      checked.c = r;
      checked.reach = its;
      return true;
    };
    prepared->Stream(root, checked, 2048);
    EXPECT_EQ(checked.outside, 0u);
    EXPECT_GT(checked.made, 0u);
    const Ball ball = prepared->Bound(root);
    CollectSink all;
    prepared->Stream(root, all, 2048);
    for (const Vec3& p : all.points) ASSERT_LE(Length(p - ball.center), ball.radius);
  }
}

TEST(HeightFieldTest, ARefusedPartIsNotMade) {
  const auto prepared = Prepared(Field(513, 513));
  CollectSink sink;
  sink.wanted = [](const Vec3& a, const Vec3& b, const Vec3& c, const StreamReach& reach) {
    return std::min({a.x, b.x, c.x}) - reach.Towards(Vec3(1, 0, 0)) < -.9;
  };
  for (size_t root = 0; root < prepared->RootCount(); ++root) prepared->Stream(root, sink, 2048);
  EXPECT_LT(sink.leaves.size(), 513u * 513 / 4);
  EXPECT_GE(sink.leaves.size(), 2u * 25 * 512);
}

TEST(HeightFieldTest, WeldingKeepsItsBound) {
  const auto welded = Prepared(Field(100, 100))->Weld({5000});
  ASSERT_FALSE(welded.ok());
  EXPECT_EQ(welded.error().code, ErrorCode::kLimit);
}

TEST(HeightFieldTest, MemoryIsThatOfTheSamples) {
  const HeightField flat{FlatHeights(16385, 16385), Vec3(1)};
  EXPECT_LT(Prepared(flat)->Bytes(), 1000u);
  const HeightField field = Field(512, 512);
  EXPECT_LT(Prepared(field)->Bytes(), 5u * 512 * 512);
}

}  // namespace
}  // namespace fjord
