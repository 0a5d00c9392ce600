#include "engine/geometry/edges.h"

#include <gtest/gtest.h>

#include "engine/geometry/primitives.h"
#include "tests/geometry/shapes.h"

namespace fjord {
namespace {

TEST(EdgeTableTest, ListsEachEdgeOnceInOrder) {
  const EdgeTable table(TwoTriangles());
  ASSERT_EQ(table.edges().size(), 5u);
  const std::vector<std::pair<uint32_t, uint32_t>> want = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}};
  for (size_t e = 0; e < want.size(); ++e) {
    EXPECT_EQ(table.edges()[e].a, want[e].first);
    EXPECT_EQ(table.edges()[e].b, want[e].second);
    EXPECT_EQ(table.edges()[e].use_count, e == 1 ? 2u : 1u);
  }
}

TEST(EdgeTableTest, S21_FindsAnEdgeFromBothEnds) {
  const EdgeTable table(TwoTriangles());
  for (uint32_t e = 0; e < table.edges().size(); ++e) {
    EXPECT_EQ(table.Find(table.edges()[e].a, table.edges()[e].b), e);
    EXPECT_EQ(table.Find(table.edges()[e].b, table.edges()[e].a), e);
  }
  EXPECT_EQ(table.Find(1, 3), EdgeTable::kNone);
  EXPECT_EQ(table.Find(0, 0), EdgeTable::kNone);
  EXPECT_EQ(table.Find(7, 99), EdgeTable::kNone);
}

TEST(EdgeTableTest, CornersKnowTheirEdge) {
  const Mesh mesh = Tetrahedron();
  const EdgeTable table(mesh);
  for (uint32_t corner = 0; corner < mesh.face_vertex.size(); ++corner) {
    const uint32_t u = mesh.face_vertex[corner];
    const uint32_t v = mesh.face_vertex[corner / 3 * 3 + (corner + 1) % 3];
    EXPECT_EQ(table.OfCorner(corner), table.Find(u, v));
  }
}

TEST(EdgeTableTest, DirectionsOfAConsistentMeshDiffer) {
  const EdgeTable table(Tetrahedron());
  for (const Edge& edge : table.edges()) {
    ASSERT_EQ(edge.use_count, 2u);
    EXPECT_TRUE(table.Uses(edge)[0].forward);
    EXPECT_FALSE(table.Uses(edge)[1].forward);
  }
}

TEST(EdgeTableTest, TrianglesAndMeshAgree) {
  const Mesh mesh = Tetrahedron();
  std::vector<Triangle> triangles;
  for (size_t f = 0; f < mesh.FaceCount(); ++f) {
    triangles.push_back(
        {mesh.face_vertex[3 * f], mesh.face_vertex[3 * f + 1], mesh.face_vertex[3 * f + 2]});
  }
  const EdgeTable a(mesh), b{std::span<const Triangle>(triangles)};
  ASSERT_EQ(a.edges().size(), b.edges().size());
  for (size_t e = 0; e < a.edges().size(); ++e) {
    EXPECT_EQ(a.edges()[e].a, b.edges()[e].a);
    EXPECT_EQ(a.Uses(a.edges()[e])[0].face, b.Uses(b.edges()[e])[0].face);
  }
}

// The third vertices of an edge's faces come in the same order, however the faces are listed.
TEST(EdgeTableTest, S24_UsesDoNotDependOnTheOrderOfFaces) {
  const Mesh mesh = MakeEllipsoid(Vec3(1, 2, 3), 12, 8).value();
  const auto thirds = [](const Mesh& m) {
    const EdgeTable table(m);
    std::vector<uint32_t> list;
    for (const Edge& edge : table.edges()) {
      for (const EdgeUse& use : table.Uses(edge)) {
        list.push_back(m.face_vertex[3 * use.face + (use.corner + 2) % 3]);
      }
    }
    return list;
  };
  for (uint32_t seed = 1; seed < 6; ++seed) EXPECT_EQ(thirds(Shuffled(mesh, seed)), thirds(mesh));
}

TEST(EdgeTableTest, LeavesOutEdgesOfNoLength) {
  Mesh mesh = TwoTriangles();
  mesh.AddFace(Triangle{1, 1, 2});
  const EdgeTable table(mesh);
  EXPECT_EQ(table.edges().size(), 5u);
  EXPECT_EQ(table.OfCorner(6), EdgeTable::kNone);
}

}  // namespace
}  // namespace fjord
