#include "engine/geometry/border.h"

#include <gtest/gtest.h>

#include "engine/geometry/primitives.h"

namespace fjord {
namespace {

TEST(BorderTest, OfOneFaceItIsTheFace) {
  Mesh mesh;
  mesh.points.resize(5);
  mesh.AddFace(std::vector<uint32_t>{4, 2, 0, 1});
  const std::vector<Chain> border = BorderOf(mesh);
  ASSERT_EQ(border.size(), 1u);
  EXPECT_TRUE(border[0].closed);
  EXPECT_EQ(border[0].vertices, (std::vector<uint32_t>{4, 2, 0, 1}));
}

TEST(BorderTest, OfAGridItGoesAround) {
  const Mesh grid = MakeGrid(Vec3(1, 1, 0), 5, 3).value();
  const std::vector<Chain> border = BorderOf(grid);
  ASSERT_EQ(border.size(), 1u);
  EXPECT_TRUE(border[0].closed);
  EXPECT_EQ(border[0].vertices.size(), 16u);
  for (const uint32_t v : border[0].vertices) {
    const Vec3& p = grid.points[v];
    EXPECT_TRUE(p.x == -.5 || p.x == .5 || p.y == -.5 || p.y == .5) << p.x << ' ' << p.y;
  }
}

TEST(BorderTest, AHoleIsABorderOfItsOwn) {
  Mesh mesh;  // a ring of four quads
  mesh.points.resize(8);
  for (uint32_t k = 0; k < 4; ++k) {
    mesh.AddFace(std::vector<uint32_t>{k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k});
  }
  const std::vector<Chain> border = BorderOf(mesh);
  ASSERT_EQ(border.size(), 2u);
  EXPECT_EQ(border[0].vertices, (std::vector<uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(border[1].vertices.size(), 4u);
}

TEST(BorderTest, AClosedMeshHasNone) {
  EXPECT_TRUE(BorderOf(MakeBox(Vec3(1), 2, 2).value()).empty());
}

}  // namespace
}  // namespace fjord
