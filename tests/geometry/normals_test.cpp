#include "engine/geometry/normals.h"

#include <gtest/gtest.h>

#include "engine/geometry/primitives.h"
#include "tests/geometry/shapes.h"

namespace fjord {
namespace {

TEST(NormalsTest, AreaVectorIsTwiceTheArea) {
  const std::vector<Vec3> points = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}};
  EXPECT_EQ(AreaVector(points, std::vector<uint32_t>{2, 3, 0, 1}), Vec3(0, 0, 24));
  EXPECT_EQ(AreaVector(points, std::vector<uint32_t>{3, 2, 1, 0}), Vec3(0, 0, -24));
  EXPECT_EQ(AreaVector(points, std::vector<uint32_t>{1, 2}), Vec3(0));
}

TEST(NormalsTest, S20_FlatMeshHasUprightNormals) {
  for (const Vec3& n : VertexNormals(TwoTriangles())) EXPECT_EQ(n, Vec3(0, 0, 1));
}

TEST(NormalsTest, S20_CornerOfTheTetrahedronIsTheMeanOfItsFaces) {
  const std::vector<Vec3> normals = VertexNormals(Tetrahedron());
  const double third = -1 / std::sqrt(3.);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(normals[0][k], third, 1e-15);
}

TEST(NormalsTest, S20_SphereNormalsPointOutwards) {
  const Mesh mesh = MakeEllipsoid(Vec3(2), 48, 32).value();
  const std::vector<Vec3> normals = VertexNormals(mesh);
  for (size_t v = 0; v < normals.size(); ++v) {
    EXPECT_GT(glm::dot(normals[v], mesh.points[v]) / 2, .99) << v;
    EXPECT_NEAR(Length(normals[v]), 1, 1e-12);
  }
}

TEST(NormalsTest, S24_OrderOfFacesChangesNoBit) {
  const Mesh mesh = MakeTorus(3, 1.1, 17, 11).value();
  const std::vector<Vec3> want = VertexNormals(mesh);
  for (uint32_t seed = 1; seed < 8; ++seed) {
    const Mesh shuffled = Shuffled(mesh, seed);
    EXPECT_EQ(VertexNormals(shuffled), want);
    std::vector<Triangle> triangles;
    for (size_t f = 0; f < shuffled.FaceCount(); ++f) {
      triangles.push_back({shuffled.face_vertex[3 * f], shuffled.face_vertex[3 * f + 1],
                           shuffled.face_vertex[3 * f + 2]});
    }
    EXPECT_EQ(VertexNormals(shuffled.points, triangles), want);
  }
}

TEST(NormalsTest, LonelyPointsAndFoldedFacesFaceUp) {
  Mesh mesh = TwoTriangles();
  mesh.points.push_back(Vec3(9));
  mesh.AddFace(Triangle{2, 1, 0});
  mesh.AddFace(Triangle{3, 2, 0});
  for (const Vec3& n : VertexNormals(mesh)) EXPECT_EQ(n, Vec3(0, 0, 1));
}

}  // namespace
}  // namespace fjord
