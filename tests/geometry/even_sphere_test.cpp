// The base without poles: closed, even in edges, areas and neighbours, as many points as asked.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/geometry/check_mesh.h"
#include "engine/geometry/edges.h"
#include "engine/geometry/orientation.h"
#include "engine/geometry/primitives.h"

namespace fjord {
namespace {

struct Evenness {
  double edges = 0, areas = 0;    // largest over smallest
  uint32_t fewest = 0, most = 0;  // edges at a point
};

Evenness EvennessOf(const Mesh& mesh) {
  std::vector<double> lengths, areas;
  std::vector<uint32_t> valence(mesh.points.size(), 0);
  const EdgeTable table(mesh);
  for (const Edge& edge : table.edges()) {
    lengths.push_back(Length(mesh.points[edge.a] - mesh.points[edge.b]));
    ++valence[edge.a];
    ++valence[edge.b];
  }
  for (size_t f = 0; f < mesh.FaceCount(); ++f) {
    const auto p = [&](size_t k) { return mesh.points[mesh.face_vertex[3 * f + k]]; };
    areas.push_back(Length(glm::cross(p(1) - p(0), p(2) - p(0))));
  }
  const auto [short_edge, long_edge] = std::minmax_element(lengths.begin(), lengths.end());
  const auto [small, large] = std::minmax_element(areas.begin(), areas.end());
  const auto [fewest, most] = std::minmax_element(valence.begin(), valence.end());
  return {*long_edge / *short_edge, *large / *small, *fewest, *most};
}

TEST(EvenSphereTest, S23_EdgesAreasAndNeighboursAreEven) {
  for (const uint32_t steps : {1u, 2u, 3u, 5u, 8u, 13u, 40u}) {
    const Mesh mesh = MakeEvenEllipsoid(Vec3(2), steps).value();
    EXPECT_EQ(mesh.points.size(), 10u * steps * steps + 2);
    EXPECT_EQ(mesh.FaceCount(), 20u * steps * steps);
    const Evenness even = EvennessOf(mesh);
    EXPECT_LT(even.edges, 1.2) << steps;
    EXPECT_LT(even.areas, 1.21) << steps;
    EXPECT_EQ(even.fewest, 5u) << steps;
    EXPECT_LE(even.most, 6u) << steps;
    for (const Vec3& p : mesh.points) EXPECT_NEAR(Length(p), 2, 1e-15 * 4);
  }
  // What it is there for: circles of latitude crowd at the poles.
  const Evenness latitude = EvennessOf(MakeEllipsoid(Vec3(2), 24, 12).value());
  EXPECT_GT(latitude.edges, 5);
  EXPECT_EQ(latitude.most, 24u);
}

TEST(EvenSphereTest, S23_IsClosedAndFacesOutward) {
  for (const uint32_t steps : {1u, 2u, 7u}) {
    const Mesh mesh = MakeEvenEllipsoid({1, 2, 3}, steps).value();
    const MeshCounts counts = CountMesh(mesh);
    EXPECT_TRUE(counts.closed);
    EXPECT_EQ(counts.euler, 2);
    EXPECT_EQ(counts.components, 1u);
    EXPECT_EQ(FacingOf(mesh, EdgeTable(mesh)), Facing::kRight);
    for (const MeshDefect& defect : CheckMesh(mesh)) ADD_FAILURE() << defect.message;
    for (size_t f = 0; f < mesh.FaceCount(); ++f) {
      EXPECT_LT(mesh.face_vertex[3 * f], mesh.face_vertex[3 * f + 1]);
      EXPECT_LT(mesh.face_vertex[3 * f], mesh.face_vertex[3 * f + 2]);
    }
  }
}

TEST(EvenSphereTest, S23_AnEllipsoidKeepsItsFormAndItsPoles) {
  const Mesh mesh = MakeEvenEllipsoid({1, 2, 3}, 6).value();
  for (const Vec3& p : mesh.points) {
    EXPECT_NEAR(p.x * p.x + p.y * p.y / 4 + p.z * p.z / 9, 1, 1e-14);
  }
  EXPECT_EQ(std::count(mesh.points.begin(), mesh.points.end(), Vec3(0, 0, 3)), 1);
  EXPECT_EQ(std::count(mesh.points.begin(), mesh.points.end(), Vec3(0, 0, -3)), 1);
}

TEST(EvenSphereTest, StepsGiveNearestToSoManyPoints) {
  EXPECT_EQ(EvenSteps(0), 1u);
  EXPECT_EQ(EvenSteps(12), 1u);
  EXPECT_EQ(EvenSteps(42), 2u);
  EXPECT_EQ(EvenSteps(24 * 12), 5u);  // 252 of 288
  for (uint32_t steps = 1; steps < 100; ++steps) {
    EXPECT_EQ(EvenSteps(10 * steps * steps + 2), steps);
  }
  EXPECT_EQ(EvenSteps(~uint64_t{0}), 1264u);
}

TEST(EvenSphereTest, RefusesWhatCannotBeMade) {
  EXPECT_FALSE(MakeEvenEllipsoid({1, 0, 1}, 8));
  EXPECT_FALSE(MakeEvenEllipsoid({1, 1, 1e13}, 8));
  EXPECT_FALSE(MakeEvenEllipsoid(Vec3(1), 0));
  for (const uint32_t steps : {1265u, 0xffffffffu}) {
    const auto mesh = MakeEvenEllipsoid(Vec3(1), steps);
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().code, ErrorCode::kLimit);
  }
}

}  // namespace
}  // namespace fjord
