#include "engine/geometry/primitives.h"

#include <gtest/gtest.h>

#include "engine/geometry/check_mesh.h"
#include "engine/geometry/edges.h"
#include "engine/geometry/normals.h"
#include "engine/geometry/orientation.h"

namespace fjord {
namespace {

double SixVolumes(const Mesh& mesh) {
  double sum = 0;
  for (size_t f = 0; f < mesh.FaceCount(); ++f) {
    const auto p = [&](size_t k) { return mesh.points[mesh.face_vertex[3 * f + k]]; };
    sum += glm::dot(p(0), glm::cross(p(1), p(2)));
  }
  return sum;
}

void ExpectClosed(const Mesh& mesh, int64_t euler) {
  const MeshCounts counts = CountMesh(mesh);
  EXPECT_TRUE(counts.closed);
  EXPECT_EQ(counts.euler, euler);
  EXPECT_EQ(counts.boundary_edges, 0u);
  EXPECT_EQ(counts.components, 1u);
  EXPECT_EQ(FacingOf(mesh, EdgeTable(mesh)), Facing::kRight);
  for (const MeshDefect& defect : CheckMesh(mesh)) ADD_FAILURE() << defect.message;
}

TEST(PrimitivesTest, S23_SphereIsClosed) {
  for (uint32_t segments : {3u, 4u, 7u, 32u}) {
    for (uint32_t rings : {2u, 3u, 16u}) {
      ExpectClosed(MakeEllipsoid(Vec3(1.5), segments, rings).value(), 2);
    }
  }
}

TEST(PrimitivesTest, S23_EllipsoidIsClosedAndHasItsVolume) {
  const Mesh mesh = MakeEllipsoid({1, 2, 3}, 200, 100).value();
  ExpectClosed(mesh, 2);
  EXPECT_NEAR(SixVolumes(mesh) / 6, 4. / 3 * 3.14159265 * 6, .03);
  for (const Vec3& p : mesh.points) {
    EXPECT_NEAR(p.x * p.x + p.y * p.y / 4 + p.z * p.z / 9, 1, 1e-14);
  }
}

TEST(PrimitivesTest, S23_TorusIsClosedWithOneHole) {
  for (uint32_t segments : {3u, 5u, 24u}) {
    ExpectClosed(MakeTorus(2, .5, segments, segments).value(), 0);
  }
  const double pi = 3.14159265358979;
  EXPECT_NEAR(SixVolumes(MakeTorus(2, .5, 200, 200).value()) / 6, 2 * pi * pi * 2 * .25, .01);
}

TEST(PrimitivesTest, S23_BoxIsClosedAndHasItsVolume) {
  for (uint32_t x : {1u, 2u, 5u}) {
    for (uint32_t y : {1u, 3u}) {
      const Mesh mesh = MakeBox({1, 2, 3}, x, y).value();
      ExpectClosed(mesh, 2);
      EXPECT_NEAR(SixVolumes(mesh), 36, 1e-12);
    }
  }
}

TEST(PrimitivesTest, GridIsAFlatSheetFacingUp) {
  const Mesh mesh = MakeGrid({4, 2, 0}, 4, 3).value();
  const MeshCounts counts = CountMesh(mesh);
  EXPECT_EQ(counts.vertices, 20u);
  EXPECT_EQ(counts.faces, 24u);
  EXPECT_EQ(counts.euler, 1);
  EXPECT_EQ(counts.boundary_edges, 14u);
  EXPECT_TRUE(CheckMesh(mesh).empty());
  EXPECT_EQ(mesh.points.front(), Vec3(-2, -1, 0));
  EXPECT_EQ(mesh.points.back(), Vec3(2, 1, 0));
  for (const Vec3& n : VertexNormals(mesh)) EXPECT_EQ(n, Vec3(0, 0, 1));
}

TEST(PrimitivesTest, TrianglesStartAtTheirSmallestVertex) {
  for (const Mesh& mesh : {MakeEllipsoid(Vec3(1), 9, 7).value(), MakeTorus(2, 1, 9, 7).value(),
                           MakeBox(Vec3(1), 3, 2).value(), MakeGrid(Vec3(1), 3, 2).value()}) {
    for (size_t f = 0; f < mesh.FaceCount(); ++f) {
      ASSERT_EQ(mesh.face_size[f], 3u);
      EXPECT_LT(mesh.face_vertex[3 * f], mesh.face_vertex[3 * f + 1]);
      EXPECT_LT(mesh.face_vertex[3 * f], mesh.face_vertex[3 * f + 2]);
    }
  }
}

TEST(PrimitivesTest, RefusesWhatCannotBeMade) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(MakeEllipsoid({1, 0, 1}, 8, 8));
  EXPECT_FALSE(MakeEllipsoid({1, nan, 1}, 8, 8));
  EXPECT_FALSE(MakeEllipsoid({1, 1e308, 1}, 8, 8));
  EXPECT_FALSE(MakeEllipsoid(Vec3(1), 2, 8));
  EXPECT_FALSE(MakeEllipsoid(Vec3(1), 8, 1));
  EXPECT_FALSE(MakeTorus(1, 1, 8, 8));
  EXPECT_FALSE(MakeTorus(1, -.1, 8, 8));
  EXPECT_FALSE(MakeTorus(1, .5, 8, 2));
  EXPECT_FALSE(MakeBox({1, 1, 0}, 1, 1));
  EXPECT_FALSE(MakeBox(Vec3(1), 0, 1));
  EXPECT_FALSE(MakeGrid({1, -1, 1}, 1, 1));
  EXPECT_NE(MakeTorus(1, 2, 8, 8).error().message.find("tube"), std::string::npos);
}

TEST(PrimitivesTest, CountsThatWouldFillTheMemoryAreRefused) {
  const uint32_t huge = 0xffffffffu;
  for (const uint32_t n : {70'000u, huge}) {
    for (const auto& mesh : {MakeEllipsoid(Vec3(1), n, n), MakeTorus(2, 1, n, n),
                             MakeBox(Vec3(1), n, n), MakeGrid(Vec3(1), n, n)}) {
      ASSERT_FALSE(mesh);
      EXPECT_EQ(mesh.error().code, ErrorCode::kLimit);
    }
  }
}

}  // namespace
}  // namespace fjord
