// The welded form where triangles are large enough to be cut, on any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/fractal/surface_shapes.h"

namespace fjord::test {
namespace {

struct WeldCase {
  std::string name;
  CoarseShape shape;
  FractalSettings settings;
};

// All become several times as many leaves as are made at a time.
std::vector<WeldCase> LargeCases() {
  CoarseShape square;
  square.now = square.rest = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  square.colors = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<WeldCase> cases = {{"square", square, SurfaceSettings(.02)},
                                 {"taiwan", TaiwanRelief(), SurfaceSettings(.03)}};
  // One side much finer than the other: a border that a neighbour was cut through.
  cases.push_back({"near", square, PixelSettings(4, 300, Vec3(-1, -1, .2))});
  cases.push_back({"coast", TaiwanRelief(), SurfaceSettings(.03)});
  cases.back().settings.coast = true;
  cases.push_back({"edge", square, SurfaceSettings(.02)});
  cases.back().settings.direction = Direction::kEdge;
  cases.push_back({"face", square, SurfaceSettings(.02)});
  cases.back().settings.direction = Direction::kFace;
  cases.push_back({"length", square, SurfaceSettings(.02)});
  cases.back().settings.split = Split::kLength;
  return cases;
}

WeldedShape WeldBy(const WeldCase& one, int threads) {
  auto welded = Prepare(one.shape, one.settings)->Weld({.max_points = 1 << 24, .threads = threads});
  FJORD_CHECK(welded.ok(), welded.error().message);
  return std::move(*welded);
}

TEST(SurfaceWeldTest, AnyNumberOfThreadsGivesOneFile) {
  for (const WeldCase& one : LargeCases()) {
    const WeldedShape alone = WeldBy(one, 1);
    ASSERT_GT(alone.mesh.FaceCount(), 10000u) << one.name;
    for (const int threads : {2, 3, 8}) {
      const WeldedShape many = WeldBy(one, threads);
      EXPECT_TRUE(many.mesh.points == alone.mesh.points) << one.name << ' ' << threads;
      EXPECT_TRUE(many.mesh.face_vertex == alone.mesh.face_vertex) << one.name << ' ' << threads;
      EXPECT_TRUE(many.mesh.colors == alone.mesh.colors) << one.name << ' ' << threads;
      EXPECT_TRUE(many.identity == alone.identity) << one.name << ' ' << threads;
      EXPECT_TRUE(many.level == alone.level) << one.name << ' ' << threads;
      EXPECT_TRUE(many.direction == alone.direction) << one.name << ' ' << threads;
      EXPECT_TRUE(many.coast == alone.coast) << one.name << ' ' << threads;
    }
  }
}

TEST(SurfaceWeldTest, LargeShapesAreWhatTheStreamMakes) {
  for (const WeldCase& one : LargeCases()) {
    EXPECT_TRUE(WeldedLeaves(WeldBy(one, 2)) == StreamedLeaves(*Prepare(one.shape, one.settings)))
        << one.name;
  }
}

// Neighbours share points; an edge that only one face has lies on the border of the coarse shape.
TEST(SurfaceWeldTest, EveryPointIsThereOnce) {
  for (const WeldCase& one : LargeCases()) {
    if (one.settings.direction == Direction::kFace) continue;  // gapes along input edges
    const WeldedShape shape = WeldBy(one, 2);
    std::vector<Identity> identity = shape.identity;
    std::sort(identity.begin(), identity.end());
    EXPECT_EQ(std::adjacent_find(identity.begin(), identity.end()), identity.end()) << one.name;
    std::map<std::pair<uint32_t, uint32_t>, int> uses;
    const std::vector<uint32_t>& v = shape.mesh.face_vertex;
    for (size_t i = 0; i < v.size(); ++i) {
      const uint32_t next = v[i % 3 == 2 ? i - 2 : i + 1];
      ++uses[{std::min(v[i], next), std::max(v[i], next)}];
    }
    // Euler: a disc has one more point and face than edges.
    EXPECT_EQ(shape.mesh.points.size() + shape.mesh.FaceCount(), uses.size() + 1) << one.name;
    for (const auto& [edge, count] : uses) ASSERT_LE(count, 2) << one.name;
  }
}

TEST(SurfaceWeldTest, TheLimitIsExact) {
  for (const WeldCase& one : LargeCases()) {
    const auto prepared = Prepare(one.shape, one.settings);
    const size_t points = WeldBy(one, 1).mesh.points.size();
    EXPECT_TRUE(prepared->Weld({.max_points = points, .threads = 2}).ok()) << one.name;
    const auto less = prepared->Weld({.max_points = points - 1, .threads = 2});
    ASSERT_FALSE(less.ok()) << one.name;
    EXPECT_EQ(less.error().code, ErrorCode::kLimit) << one.name;
  }
}

// However fine: what is beyond the limit is refused after work in proportion to the limit.
TEST(SurfaceWeldTest, EndlessFinenessIsRefusedSoon) {
  WeldCase one = LargeCases().front();
  one.settings.fineness.epsilon = 1e-9;
  one.settings.max_level = 40;
  const auto welded = Prepare(one.shape, one.settings)->Weld({.max_points = 100000, .threads = 2});
  ASSERT_FALSE(welded.ok());
  EXPECT_EQ(welded.error().code, ErrorCode::kLimit);
}

}  // namespace
}  // namespace fjord::test
