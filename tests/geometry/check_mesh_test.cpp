#include "engine/geometry/check_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <limits>

#include "engine/geometry/orientation.h"
#include "engine/geometry/primitives.h"
#include "tests/geometry/shapes.h"

namespace fjord {
namespace {

using Kind = MeshDefect::Kind;
using testing::HasSubstr;

// The one defect of a mesh; a failure if there are more or none.
MeshDefect Only(const Mesh& mesh) {
  const std::vector<MeshDefect> defects = CheckMesh(mesh);
  for (size_t i = 1; i < defects.size(); ++i) ADD_FAILURE() << "also: " << defects[i].message;
  if (defects.empty()) {
    ADD_FAILURE() << "no defect found";
    return {Kind::kBadIndex, 0, 0, ""};
  }
  return defects[0];
}

void Expect(const MeshDefect& defect, Kind kind, uint32_t vertex, uint32_t face,
            const std::string& words) {
  EXPECT_EQ(defect.kind, kind) << defect.message;
  EXPECT_EQ(defect.vertex, vertex);
  EXPECT_EQ(defect.face, face);
  EXPECT_THAT(defect.message, HasSubstr(words));
}

TEST(CheckMeshTest, S28_GoodMeshesHaveNoDefects) {
  EXPECT_TRUE(CheckMesh(TwoTriangles()).empty());
  EXPECT_TRUE(CheckMesh(Tetrahedron()).empty());
  EXPECT_TRUE(CheckMesh(Mesh{}).empty());
}

TEST(CheckMeshTest, S28_DuplicateVertex) {
  Mesh mesh = MakeGrid({2, 2, 0}, 2, 2).value();
  mesh.points.push_back(mesh.points[8]);  // vertex 10 at the place of vertex 9
  std::replace(mesh.face_vertex.end() - 3, mesh.face_vertex.end(), 8u, 9u);
  for (const MeshDefect& d : CheckMesh(mesh)) {
    if (d.kind == Kind::kUnusedVertex) continue;  // 9 is left without a face or not
    Expect(d, Kind::kDuplicateVertex, 10, 0, "vertices 9 and 10 are at one place (1, 1, 0)");
  }
  mesh = TwoTriangles();
  mesh.points[3] = Vec3(0, 1, -0.);
  mesh.points.push_back(Vec3(0, 1, 0));
  mesh.points.push_back(Vec3(0, 2, 0));
  mesh.AddFace(Triangle{4, 2, 5});
  Expect(Only(mesh), Kind::kDuplicateVertex, 5, 0, "vertices 4 and 5");
}

TEST(CheckMeshTest, S28_UnusedVertex) {
  Mesh mesh = TwoTriangles();
  mesh.points.push_back(Vec3(5));
  Expect(Only(mesh), Kind::kUnusedVertex, 5, 0, "vertex 5 belongs to no face");
}

TEST(CheckMeshTest, S28_TripleEdge) {
  Mesh mesh = TwoTriangles();
  mesh.points.push_back(Vec3(.5, .5, 1));
  mesh.AddFace(Triangle{0, 2, 4});
  Expect(Only(mesh), Kind::kTripleEdge, 0, 3, "edge 1-3 has 3 faces: 1, 2, 3");
}

TEST(CheckMeshTest, S28_FlippedFace) {
  Mesh mesh = MakeGrid({3, 3, 0}, 3, 3).value();
  std::swap(mesh.face_vertex[3 * 8 + 1], mesh.face_vertex[3 * 8 + 2]);
  Expect(Only(mesh), Kind::kFlippedFace, 0, 9, "face 9 is turned against face");
}

TEST(CheckMeshTest, S28_FlippedPatchIsNamedFaceByFaceAndNotItsSurroundings) {
  Mesh mesh = MakeGrid({9, 9, 0}, 9, 9).value();
  std::vector<uint32_t> flipped;
  for (uint32_t f = 60; f < 66; ++f) {
    std::swap(mesh.face_vertex[3 * f + 1], mesh.face_vertex[3 * f + 2]);
    flipped.push_back(f + 1);
  }
  std::vector<uint32_t> named;
  for (const MeshDefect& d : CheckMesh(mesh)) {
    EXPECT_EQ(d.kind, Kind::kFlippedFace);
    named.push_back(d.face);
  }
  EXPECT_EQ(named, flipped);
}

TEST(CheckMeshTest, S28_MoebiusBandCannotBeHealed) {
  Mesh mesh;
  for (int i = 0; i < 5; ++i) {
    mesh.points.push_back({double(i * i), 0, 0});
    mesh.points.push_back({double(i), 1, double(i % 2)});
  }
  for (uint32_t i = 0; i < 5; ++i) {
    uint32_t a = 2 * i, b = 2 * i + 1, c = (2 * i + 2) % 10, d = (2 * i + 3) % 10;
    if (i == 4) std::swap(c, d);
    mesh.AddFace(Triangle{a, c, b});
    mesh.AddFace(Triangle{b, c, d});
  }
  bool found = false;
  for (const MeshDefect& d : CheckMesh(mesh)) found = found || d.kind == Kind::kFlippedFace;
  EXPECT_TRUE(found);
}

TEST(CheckMeshTest, S28_ZeroArea) {
  Mesh mesh = TwoTriangles();
  mesh.points.push_back(Vec3(2, 2, 0));
  mesh.points.push_back(Vec3(3, 3, 0));
  mesh.AddFace(Triangle{2, 4, 5});
  Expect(CheckMesh(mesh)[0], Kind::kTJunction, 5, 3, "");
  bool found = false;
  for (const MeshDefect& d : CheckMesh(mesh)) {
    if (d.kind != Kind::kZeroArea) continue;
    found = true;
    Expect(d, Kind::kZeroArea, 0, 3, "face 3 has no area");
  }
  EXPECT_TRUE(found);
}

TEST(CheckMeshTest, S28_RepeatedVertex) {
  Mesh mesh = TwoTriangles();
  mesh.AddFace(std::vector<uint32_t>{0, 1, 2, 1});
  Expect(Only(mesh), Kind::kRepeatedVertex, 0, 3, "face 3 names vertex 2 twice");
}

TEST(CheckMeshTest, S28_BadIndexAndBadSize) {
  Mesh mesh = TwoTriangles();
  mesh.AddFace(Triangle{0, 1, 17});
  Expect(Only(mesh), Kind::kBadIndex, 0, 3, "face 3 names vertex 18, but there are 4");
  mesh = TwoTriangles();
  mesh.AddFace(std::vector<uint32_t>{0, 1});
  Expect(Only(mesh), Kind::kBadIndex, 0, 3, "at least 3");
  mesh = TwoTriangles();
  mesh.face_size.push_back(4'000'000'000u);
  Expect(Only(mesh), Kind::kBadIndex, 0, 3, "past the end");
}

TEST(CheckMeshTest, S28_NotFinite) {
  for (double bad :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    Mesh mesh = TwoTriangles();
    mesh.points[2].y = bad;
    Expect(Only(mesh), Kind::kNotFinite, 3, 0, "vertex 3");
  }
}

TEST(CheckMeshTest, S28_ClockwiseMesh) {
  Mesh mesh = TwoTriangles();
  FlipMesh(&mesh);
  Expect(Only(mesh), Kind::kClockwise, 0, 0, "clockwise");
  mesh.points[1].z = .25;  // relief, too
  Expect(Only(mesh), Kind::kClockwise, 0, 0, "clockwise");
  mesh = Tetrahedron();
  FlipMesh(&mesh);
  Expect(Only(mesh), Kind::kClockwise, 0, 0, "inside out");
}

// An edge was split on one side only.
TEST(CheckMeshTest, S4_TJunction) {
  Mesh mesh = TwoTriangles();
  mesh.points.push_back(Vec3(.5, .5, 0));
  mesh.face_size.pop_back();
  mesh.face_vertex.resize(3);
  mesh.AddFace(Triangle{0, 4, 3});
  mesh.AddFace(Triangle{4, 2, 3});
  Expect(Only(mesh), Kind::kTJunction, 5, 1, "vertex 5 lies inside edge 1-3 of face 1");
}

// Triangles that share no vertices, as a stream makes them: the gap is found by place.
TEST(CheckMeshTest, S4_TJunctionBetweenUnweldedTriangles) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 0, 0}, {3, 3, 0}, {1.5, .5, 0}};
  mesh.AddFace(Triangle{0, 1, 2});
  mesh.AddFace(Triangle{3, 4, 5});
  size_t found = 0;
  for (const MeshDefect& d : CheckMesh(mesh)) {
    if (d.kind != Kind::kTJunction) continue;
    ++found;
    Expect(d, Kind::kTJunction, 6, 1, "edge 2-3");
  }
  EXPECT_EQ(found, 1u);
}

TEST(CheckMeshTest, DefectsComeInOrderAndAtMostAsAsked) {
  Mesh mesh = TwoTriangles();
  for (int i = 0; i < 50; ++i) mesh.points.push_back(Vec3(i, 7, 7));
  mesh.AddFace(Triangle{0, 1, 99});
  const std::vector<MeshDefect> all = CheckMesh(mesh);
  ASSERT_EQ(all.size(), 51u);
  for (uint32_t i = 0; i < 50; ++i) EXPECT_EQ(all[i].vertex, i + 5);
  EXPECT_EQ(all[50].kind, Kind::kBadIndex);
  const std::vector<MeshDefect> few = CheckMesh(mesh, 3);
  ASSERT_EQ(few.size(), 3u);
  EXPECT_EQ(few[2].vertex, 7u);
}

TEST(CheckMeshTest, CountsOfKnownMeshes) {
  Mesh mesh = Tetrahedron();
  MeshCounts counts = CountMesh(mesh);
  EXPECT_EQ(counts.edges, 6u);
  EXPECT_EQ(counts.euler, 2);
  EXPECT_TRUE(counts.closed);
  mesh.points.push_back(Vec3(9));  // lonely: no part of the surface
  counts = CountMesh(mesh);
  EXPECT_EQ(counts.vertices, 5u);
  EXPECT_EQ(counts.euler, 2);
  EXPECT_EQ(counts.components, 1u);
  EXPECT_FALSE(CountMesh(Mesh{}).closed);
}

// 200,000 faces stand for a million (five times as many take about five times as long).
TEST(CheckMeshTest, S28_LargeMeshesTakeSeconds) {
  Mesh mesh = MakeGrid({9, 9, 0}, 320, 320).value();
  mesh.points[5'000].z = 1;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(CheckMesh(mesh).empty());
  const Mesh closed = MakeTorus(3, 1, 300, 300).value();
  EXPECT_TRUE(CheckMesh(closed).empty());
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  EXPECT_LT(spent.count(), 30);  // generous: a sanitizer build on a busy machine
  RecordProperty("seconds", std::to_string(spent.count()));
}

}  // namespace
}  // namespace fjord
