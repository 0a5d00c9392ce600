// Coasts made of triangles (S16, S17).
#include "engine/fractal/coast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "engine/fractal/coast_pieces.h"
#include "engine/fractal/measure.h"
#include "engine/geometry/check_mesh.h"
#include "tests/fractal/collect.h"

namespace fjord {
namespace {

using test::OutlineMesh;
using test::Prepare;
using test::Weld;

FractalSettings Coast(double H, double epsilon, uint64_t seed = 1) {
  FractalSettings s = test::SettingsOf("coast", epsilon);
  s.H = H;
  s.seed = seed;
  return s;
}

std::vector<FractalSettings> ManySettings() {
  std::vector<FractalSettings> all;
  const MethodInfo& method = *FindFractalMethod("coast");
  for (const Law law : test::LawsOf(method)) {
    for (const Direction direction : test::DirectionsOf(method)) {
      for (const Variant variant : test::VariantsOf(method)) {
        for (const double H : {.3, .7}) {
          FractalSettings s = Coast(H, .02, 5);
          s.law = law;
          s.direction = direction;
          s.variant = variant;
          s.amplitude = .5;
          all.push_back(s);
        }
      }
    }
  }
  return all;
}

// The border of a welded flat mesh, as one closed line per component, following the faces' winding.
std::vector<Polyline> Borders(const Mesh& mesh) {
  std::set<std::pair<uint32_t, uint32_t>> halves;
  for (size_t i = 0; i < mesh.face_vertex.size(); ++i) {
    const size_t next = i % 3 == 2 ? i - 2 : i + 1;
    EXPECT_TRUE(halves.insert({mesh.face_vertex[i], mesh.face_vertex[next]}).second);
  }
  std::map<uint32_t, uint32_t> follows;
  for (const auto& [a, b] : halves) {
    if (!halves.contains({b, a})) {
      EXPECT_TRUE(follows.emplace(a, b).second);
    }
  }
  std::vector<Polyline> borders;
  while (!follows.empty()) {
    Polyline line;
    line.closed = true;
    for (uint32_t at = follows.begin()->first; follows.contains(at);) {
      line.points.push_back(mesh.points[at]);
      const uint32_t next = follows[at];
      follows.erase(at);
      at = next;
    }
    borders.push_back(line);
  }
  return borders;
}

double SmallestTurn(const Mesh& mesh) {
  double smallest = 1e300;
  for (size_t i = 0; i < mesh.face_vertex.size(); i += 3) {
    const Vec3& a = mesh.points[mesh.face_vertex[i]];
    const Vec3& b = mesh.points[mesh.face_vertex[i + 1]];
    const Vec3& c = mesh.points[mesh.face_vertex[i + 2]];
    smallest = std::min(smallest, glm::cross(b - a, c - a).z);
  }
  return smallest;
}

TEST(CoastTest, S16_TrianglesFillTheFractalOutline) {
  for (const FractalSettings& s : ManySettings()) {
    const Mesh mesh = Weld(*Prepare(OutlineMesh(), s)).mesh;
    const std::vector<Polyline> borders = Borders(mesh);
    ASSERT_EQ(borders.size(), 1u);
    EXPECT_GT(borders[0].points.size(), 300u);
    const double area = MeshArea(mesh);  // of absolute areas: a flipped triangle would add
    EXPECT_NEAR(area, LineArea(borders[0]), 1e-9 * area)
        << LawName(s.law) << DirectionName(s.direction) << VariantName(s.variant) << s.H;
  }
}

TEST(CoastTest, S16_NoTriangleIsFlipped) {
  for (FractalSettings s : ManySettings()) {
    for (s.seed = 1; s.seed <= 5; ++s.seed) {
      EXPECT_GT(SmallestTurn(Weld(*Prepare(OutlineMesh(), s)).mesh), 0)
          << LawName(s.law) << DirectionName(s.direction) << VariantName(s.variant) << s.H;
    }
  }
}

TEST(CoastTest, S16_OutputHasNoDefect) {
  const Mesh mesh = Weld(*Prepare(OutlineMesh(), Coast(.7, .05))).mesh;
  for (const MeshDefect& defect : CheckMesh(mesh)) {
    ADD_FAILURE() << defect.message;
  }
  EXPECT_EQ(CountMesh(mesh).euler, 1);
}

// Outward: four pieces. Inward: two.
TEST(CoastTest, S16_OneCutMakesFourOrTwo) {
  std::set<size_t> seen;
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    CoarseShape shape;
    shape.now = {{0, 0, 0}, {1, 0, 0}, {.5, .8, 0}, {-.5, .9, 0}, {1.5, .9, 0}};
    shape.rest = shape.now;
    shape.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}};
    FractalSettings s = Coast(.6, .6, seed);
    s.variant = Variant::kCurrent;
    s.max_level = 1;
    const auto coast = Prepare(shape, s);
    test::CollectSink sink;
    coast->Stream(0, sink, 256);
    double lowest = 0;
    for (const Vec3& p : sink.points) {
      lowest = std::min(lowest, p.y);
    }
    EXPECT_EQ(sink.leaves.size(), lowest < 0 ? 4u : 2u) << lowest;
    seen.insert(sink.leaves.size());
  }
  EXPECT_EQ(seen, (std::set<size_t>{2, 4}));
}

// A point that would pass the apex stops before it.
TEST(CoastTest, S17_DeepInwardOffsetsAreHeldBack) {
  int held = 0;
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    CoarseShape shape;  // a low triangle, its upper sides joined to others
    shape.now = {{0, 0, 0}, {1, 0, 0}, {.5, .2, 0}, {-.5, .9, 0}, {1.5, .9, 0}};
    shape.rest = shape.now;
    shape.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}};
    FractalSettings s = Coast(.4, .6, seed);
    s.max_level = 1;
    test::CollectSink sink;
    Prepare(shape, s)->Stream(0, sink, 256);
    for (const Vec3& p : sink.points) {
      const bool apex = p == shape.now[2];
      EXPECT_TRUE(apex || p.y < .2 * 7 / 8 + 1e-12) << p.y;
      held += !apex && p.y > .1 ? 1 : 0;
    }
  }
  EXPECT_GT(held, 10);
}

TEST(CoastTest, S17_EveryPieceHasAtMostOneBorderEdge) {
  CoarseShape shape;  // one triangle with three border edges; two joined ones with two each
  shape.now = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {3, 0, 0}, {4, 0, 0}, {4, 1, 0}, {3, 1, 0}};
  shape.rest = shape.now;
  shape.triangles = {{0, 1, 2}, {3, 4, 5}, {3, 5, 6}};
  const CoastMesh mesh = *MakeCoastMesh(shape, Coast(.7, .1));
  double area = 0;
  size_t borders = 0;
  for (size_t t = 0; t < 3; ++t) {
    const std::vector<CoastPiece> pieces = mesh.Pieces(t);
    EXPECT_EQ(pieces.size(), 3u);
    for (const CoastPiece& p : pieces) {
      const Vec3& s = p.s.line.position;
      const double turn = glm::cross(p.e.line.position - s, p.o.line.position - s).z;
      EXPECT_GT(turn, 0);
      area += .5 * turn;
      borders += p.coast ? 1 : 0;
      if (p.coast) {
        EXPECT_GT(p.rest2, 0);
      }
    }
  }
  EXPECT_NEAR(area, 1.5, 1e-15);
  EXPECT_EQ(borders, 7u);
  EXPECT_EQ(Borders(Weld(*Prepare(shape, Coast(.7, .1))).mesh).size(), 2u);
}

// An inner triangle stays one piece, and no inner edge moves or is cut.
TEST(CoastTest, S17_InnerEdgesStay) {
  const CoarseShape shape = OutlineMesh();
  const WeldedShape welded = Weld(*Prepare(shape, Coast(.6, .03)));
  std::set<std::pair<uint32_t, uint32_t>> halves;
  for (size_t i = 0; i < welded.mesh.face_vertex.size(); ++i) {
    const size_t next = i % 3 == 2 ? i - 2 : i + 1;
    halves.insert({welded.mesh.face_vertex[i], welded.mesh.face_vertex[next]});
  }
  for (uint32_t i = 0; i < 12; ++i) {
    EXPECT_TRUE(halves.contains({i, 12}));
    EXPECT_TRUE(halves.contains({12, i}));
  }
}

TEST(CoastTest, S4_NoCracksAtAnyFineness) {
  for (const double epsilon : {1.0, .3, .1, .03, .01}) {
    const WeldedShape welded = Weld(*Prepare(OutlineMesh(), Coast(.6, epsilon)));
    const MeshCounts counts = CountMesh(welded.mesh);
    EXPECT_EQ(counts.components, 1u);
    EXPECT_EQ(counts.euler, 1);
    size_t coast = 0;
    for (const uint8_t c : welded.coast) {
      coast += c;
    }
    EXPECT_EQ(counts.boundary_edges, coast);
  }
}

// The coast of a mesh in space stays in the plane of each border triangle.
TEST(CoastTest, S16_BorderStaysInItsTrianglesPlane) {
  const CoarseShape shape = OutlineMesh(.7);
  for (const Direction direction : {Direction::kEdge, Direction::kVertex}) {
    FractalSettings s = Coast(.6, .03);
    s.direction = direction;
    const auto coast = Prepare(shape, s);
    for (size_t root = 0; root < coast->RootCount(); ++root) {
      const Triangle& t = shape.triangles[root];
      const Vec3 a = shape.now[t[0]];
      const Vec3 normal = Unit(glm::cross(shape.now[t[1]] - a, shape.now[t[2]] - a));
      test::CollectSink sink;
      coast->Stream(root, sink, 256);
      EXPECT_GT(sink.leaves.size(), 10u);
      for (const Vec3& p : sink.points) {
        EXPECT_NEAR(glm::dot(p - a, normal), 0, 1e-13);
      }
    }
  }
}

TEST(CoastTest, S24_OrderOfTrianglesDoesNotMatter) {
  CoarseShape shape = OutlineMesh(.3);
  const auto expected = test::StreamedLeaves(*Prepare(shape, Coast(.7, .03)));
  std::reverse(shape.triangles.begin(), shape.triangles.end());
  std::swap(shape.triangles[2], shape.triangles[7]);
  EXPECT_EQ(test::StreamedLeaves(*Prepare(shape, Coast(.7, .03))), expected);
}

// Means over seeds of both variants. What is held back is made up for (HeldBackH).
TEST(CoastTest, S1_CoastsMeasureTheirDimension) {
  const std::vector<double> openings = {.1, .075, .05, .0375, .025, .0175, .0125};
  for (const Variant variant : {Variant::kCurrent, Variant::kPerturbed}) {
    for (const double D : {1.1, 1.15, 1.25, 1.35, 1.4}) {
      double sum = 0;
      constexpr uint64_t kSeeds = 8;
      for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
        FractalSettings s = Coast(2 - D, 2e-3, seed);
        s.variant = variant;
        s.split = Split::kLength;
        const std::vector<Polyline> borders = Borders(Weld(*Prepare(OutlineMesh(), s)).mesh);
        ASSERT_EQ(borders.size(), 1u);
        sum += RulerDimension(borders[0], openings);
      }
      EXPECT_NEAR(sum / kSeeds, D, .04) << VariantName(variant);
    }
  }
}

// The coast of a surface has nothing to hold back.
TEST(CoastTest, S22_CoastsOfSurfacesMeasureTheirDimension) {
  const std::vector<double> openings = {.2, .17, .14, .12, .1, .085, .07, .06};
  for (const double D : {1.15, 1.35}) {
    double sum = 0;
    constexpr uint64_t kSeeds = 6;
    for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
      FractalSettings s = test::SettingsOf("surface", .014);
      s.seed = seed;
      s.amplitude = 0;
      s.coast = true;
      s.coast_H = 2 - D;
      s.split = Split::kLength;
      const std::vector<Polyline> borders = Borders(Weld(*Prepare(OutlineMesh(), s)).mesh);
      ASSERT_EQ(borders.size(), 1u);
      sum += RulerDimension(borders[0], openings);
    }
    EXPECT_NEAR(sum / kSeeds, D, .05);
  }
}

TEST(CoastTest, C16a_MovingTheShapeMovesNoDetail) {
  CoarseShape moved = OutlineMesh();
  for (Vec3& p : moved.now) {
    p = Vec3(-p.y, p.x, 0) + Vec3(3, -7, 0);
  }
  const WeldedShape here = Weld(*Prepare(OutlineMesh(), Coast(.6, .03)));
  const WeldedShape there = Weld(*Prepare(moved, Coast(.6, .03)));
  ASSERT_EQ(here.identity, there.identity);
  for (size_t i = 0; i < here.mesh.points.size(); ++i) {
    const Vec3& p = here.mesh.points[i];
    EXPECT_LT(Length(Vec3(-p.y, p.x, 0) + Vec3(3, -7, 0) - there.mesh.points[i]), 1e-12);
  }
}

// Nor does its size, nor which way a midpoint goes just now, change what is cut and how.
TEST(CoastTest, C16a_TheTreeIsTheSameInEveryFrame) {
  for (const FractalSettings& s : ManySettings()) {
    CoarseShape squeezed = OutlineMesh();
    for (Vec3& p : squeezed.now) {
      p = Vec3(2 * p.x, .1 * p.y, 0);
    }
    EXPECT_EQ(Weld(*Prepare(squeezed, s)).identity, Weld(*Prepare(OutlineMesh(), s)).identity)
        << LawName(s.law) << DirectionName(s.direction) << VariantName(s.variant) << s.H;
  }
}

TEST(CoastTest, S14_HalvingEpsilonKeepsTheCoast) {
  const WeldedShape coarse = Weld(*Prepare(OutlineMesh(), Coast(.6, .06)));
  const WeldedShape fine = Weld(*Prepare(OutlineMesh(), Coast(.6, .03)));
  std::map<Identity, Vec3> places;
  for (size_t i = 0; i < fine.identity.size(); ++i) {
    places[fine.identity[i]] = fine.mesh.points[i];
  }
  for (size_t i = 0; i < coarse.identity.size(); ++i) {
    ASSERT_TRUE(places.contains(coarse.identity[i]));
    EXPECT_EQ(places[coarse.identity[i]], coarse.mesh.points[i]);
  }
}

TEST(CoastTest, BadMeshesAreRefused) {
  const auto message = [](const auto& change) {
    CoarseShape shape = OutlineMesh();
    change(shape);
    const auto prepared = PrepareCoast(shape, Coast(.7, .1));
    return prepared.ok() ? "" : prepared.error().message;
  };
  EXPECT_EQ(message([](auto& s) { s.now[3].z = std::nan(""); }),
            "point 4 of the mesh is not finite");
  EXPECT_EQ(message([](auto& s) {
              s.triangles[1] = {0, 1, 99};
            }),
            "triangle 2 names point 100 of 13");
  EXPECT_EQ(message([](auto& s) { s.triangles.clear(); }), "coast takes a mesh of triangles");
}

TEST(CoastTest, GoldenDigests) {
  const auto digest = [](Direction direction, Variant variant, Law law) {
    FractalSettings s = Coast(.7, .02);
    s.direction = direction;
    s.variant = variant;
    s.law = law;
    return test::DigestOf(test::WeldedLeaves(Weld(*Prepare(OutlineMesh(.3), s))));
  };
  EXPECT_EQ(digest(Direction::kEdge, Variant::kFixed, Law::kAffine), "c1cbc0ea54c44a60");
  EXPECT_EQ(digest(Direction::kEdge, Variant::kPerturbed, Law::kSimilar), "e07424a6c93fc846");
  EXPECT_EQ(digest(Direction::kVertex, Variant::kCurrent, Law::kShih), "fe7bac9a88c9f84e");
}

}  // namespace
}  // namespace fjord
