#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "engine/geometry/check_mesh.h"
#include "tests/fractal/surface_shapes.h"

namespace fjord::test {
namespace {

size_t SinglesBeyondTheBorder(Direction direction, Variant variant = Variant::kFixed) {
  FractalSettings settings = SurfaceSettings(.1);
  settings.direction = direction;
  settings.variant = variant;
  const Seams seams = SeamsOf(StreamedLeaves(*Prepare(Roof(), settings)));
  EXPECT_EQ(seams.more, 0u);
  return seams.single - BorderPieces(Roof(), .1);
}

TEST(SurfaceSeamsTest, S18_FaceNormalsOpenGaps) {
  EXPECT_GT(SinglesBeyondTheBorder(Direction::kFace), 0u);
  // The same gaps in the welded mesh.
  FractalSettings settings = SurfaceSettings(.1);
  settings.direction = Direction::kFace;
  const MeshCounts counts = CountMesh(Weld(*Prepare(Roof(), settings)).mesh);
  EXPECT_GT(counts.boundary_edges, BorderPieces(Roof(), .1));
}

TEST(SurfaceSeamsTest, S19_SharedEdgeNormalsCloseTheGaps) {
  EXPECT_EQ(SinglesBeyondTheBorder(Direction::kEdge), 0u);
  EXPECT_EQ(SinglesBeyondTheBorder(Direction::kEdge, Variant::kCurrent), 0u);
  // On the shared edge everything moves along the mean of the two faces' normals.
  FractalSettings settings = SurfaceSettings(.1);
  settings.direction = Direction::kEdge;
  const CoarseShape roof = Roof();
  const Places places = PlacesOf(Weld(*Prepare(roof, settings)));
  const auto normal = [&](uint32_t a, uint32_t b, uint32_t c) {
    return Unit(glm::cross(roof.now[b] - roof.now[a], roof.now[c] - roof.now[a]));
  };
  const Vec3 mean = Unit(normal(0, 1, 2) + normal(1, 3, 2));
  const Vec3 middle = places.at(MidpointIdentity(CoarseIdentity(1, 1), CoarseIdentity(1, 2)));
  const Vec3 offset = middle - (roof.now[1] + roof.now[2]) * .5;
  EXPECT_GT(Length(offset), 1e-4);
  EXPECT_LT(Length(glm::cross(offset, mean)), 1e-12);
}

TEST(SurfaceSeamsTest, S20_VertexNormalsCloseTheGaps) {
  for (const Variant variant : {Variant::kFixed, Variant::kCurrent, Variant::kPerturbed}) {
    EXPECT_EQ(SinglesBeyondTheBorder(Direction::kVertex, variant), 0u);
  }
  EXPECT_EQ(SinglesBeyondTheBorder(Direction::kUp), 0u);
}

// Of the very ends, and offsets go along it.
TEST(SurfaceSeamsTest, S20_MidpointsMoveAlongTheMeanOfTheirEndsAndKeepIt) {
  FractalSettings settings = SurfaceSettings(.5);
  settings.max_level = 1;
  const CoarseShape roof = Roof();
  const WeldedShape welded = Weld(*Prepare(roof, settings));
  size_t found = 0;
  for (uint32_t a = 0; a < 4; ++a) {
    for (uint32_t b = a + 1; b < 4; ++b) {
      const Identity id = MidpointIdentity(welded.identity[a], welded.identity[b]);
      const auto at = std::find(welded.identity.begin(), welded.identity.end(), id);
      if (at == welded.identity.end()) continue;
      const auto m = static_cast<size_t>(at - welded.identity.begin());
      const Vec3 mean = Unit(welded.direction[a] + welded.direction[b]);
      EXPECT_LT(Length(welded.direction[m] - mean), 1e-14);
      const Vec3 offset = welded.mesh.points[m] - (roof.now[a] + roof.now[b]) * .5;
      EXPECT_GT(Length(offset), 1e-4);
      EXPECT_LT(Length(glm::cross(offset, mean)), 1e-14);
      ++found;
    }
  }
  EXPECT_EQ(found, 5u);
}

TEST(SurfaceSeamsTest, S20_CurrentOffsetsAreSquareToTheirEdge) {
  FractalSettings settings = SurfaceSettings(.5);
  settings.variant = Variant::kCurrent;
  settings.max_level = 1;
  const CoarseShape roof = Roof();
  const Places places = PlacesOf(Weld(*Prepare(roof, settings)));
  const auto along = [&](uint32_t a, uint32_t b) {
    const Vec3 e = roof.now[b] - roof.now[a];
    const Vec3 m = places.at(MidpointIdentity(CoarseIdentity(1, a), CoarseIdentity(1, b)));
    const Vec3 offset = m - (roof.now[a] + roof.now[b]) * .5;
    EXPECT_GT(Length(offset), 1e-4);
    return glm::dot(offset, e) / Length(offset);
  };
  EXPECT_LT(std::abs(along(0, 1)), 1e-12);
  EXPECT_LT(std::abs(along(1, 2)), 1e-12);
  EXPECT_LT(std::abs(along(2, 3)), 1e-12);
}

// At every fineness, on open and closed shapes, streamed piece by piece: no crack, no T-junction.
TEST(SurfaceSeamsTest, S4_NoCrackAndNoTJunctionAtAnyFineness) {
  for (const double epsilon : {.9, .31, .2, .1, .05}) {
    for (const Variant variant : {Variant::kFixed, Variant::kPerturbed}) {
      FractalSettings settings = SurfaceSettings(epsilon);
      settings.variant = variant;
      const CoarseShape relief = TaiwanRelief();
      const Seams open = SeamsOf(StreamedLeaves(*Prepare(relief, settings), 50));
      EXPECT_EQ(open.single, BorderPieces(relief, epsilon)) << epsilon;
      EXPECT_EQ(open.more, 0u);
      for (const CoarseShape& shape : {Sphere(), Torus()}) {
        const Seams closed = SeamsOf(StreamedLeaves(*Prepare(shape, settings), 50));
        EXPECT_EQ(closed.single, 0u) << epsilon;
        EXPECT_EQ(closed.more, 0u);
      }
    }
  }
}

TEST(SurfaceSeamsTest, S4_NoCrackWherePixelsOrThisFramesLengthsDecide) {
  for (const Split split : {Split::kShot, Split::kAdaptive, Split::kLength}) {
    for (const double radius : {0., .4}) {
      FractalSettings settings = PixelSettings(4, 100, Vec3(0, 0, 5), radius);
      settings.split = split;
      settings.max_level = 12;
      for (const CoarseShape& shape : {Sphere(), Torus()}) {
        const std::vector<Leaf> leaves = StreamedLeaves(*Prepare(shape, settings), 50);
        EXPECT_GT(leaves.size(), 500u);
        const Seams seams = SeamsOf(leaves);
        EXPECT_EQ(seams.single, 0u) << static_cast<int>(split);
        EXPECT_EQ(seams.more, 0u);
      }
    }
  }
}

TEST(SurfaceSeamsTest, S23_ClosedInClosedOut) {
  const std::pair<CoarseShape, int64_t> shapes[] = {{Sphere(), 2}, {Ellipsoid(), 2}, {Torus(), 0}};
  for (const auto& [shape, euler] : shapes) {
    for (const Direction direction : {Direction::kVertex, Direction::kEdge, Direction::kUp}) {
      FractalSettings settings = SurfaceSettings(.15);
      settings.direction = direction;
      settings.variant = Variant::kPerturbed;
      const WeldedShape welded = Weld(*Prepare(shape, settings));
      const MeshCounts counts = CountMesh(welded.mesh);
      EXPECT_TRUE(counts.closed);
      EXPECT_EQ(counts.euler, euler);
      EXPECT_EQ(counts.components, 1u);
      EXPECT_EQ(counts.vertices, welded.mesh.points.size());
      EXPECT_GT(counts.vertices, 4 * shape.now.size());
    }
  }
}

// A border edge's midpoint keeps the exact mean height of its ends, whatever the shape of the
// coast.
TEST(SurfaceSeamsTest, S22_TheCoastStaysLevelAndInlandMoves) {
  for (const Variant variant : {Variant::kFixed, Variant::kPerturbed}) {
    FractalSettings settings = SurfaceSettings(.06);
    settings.variant = variant;
    settings.coast = true;
    const CoarseShape island = Island();
    size_t coasts = 0, inland_moved = 0, coast_moved = 0;
    for (uint32_t level = 0; level < 5; ++level) {
      settings.max_level = level;
      const WeldedShape coarse = Weld(*Prepare(island, settings));
      settings.max_level = level + 1;
      const Places fine = PlacesOf(Weld(*Prepare(island, settings)));
      std::map<std::pair<uint32_t, uint32_t>, int> uses;
      const std::vector<uint32_t>& v = coarse.mesh.face_vertex;
      for (size_t i = 0; i < v.size(); ++i) {
        ++uses[std::minmax(v[i], v[i % 3 == 2 ? i - 2 : i + 1])];
      }
      for (const auto& [ends, count] : uses) {
        const auto [a, b] = ends;
        const auto at = fine.find(MidpointIdentity(coarse.identity[a], coarse.identity[b]));
        if (at == fine.end()) continue;
        const Vec3 mean = (coarse.mesh.points[a] + coarse.mesh.points[b]) * .5;
        if (count == 1) {
          ++coasts;
          EXPECT_TRUE(coarse.coast[a] && coarse.coast[b]);
          EXPECT_EQ(at->second.z, mean.z);
          coast_moved += at->second.x != mean.x ? 1 : 0;
          // Square to the edge, and within the clamp.
          const Vec3 e = coarse.mesh.points[b] - coarse.mesh.points[a];
          const Vec3 offset = at->second - mean;
          EXPECT_LT(std::abs(glm::dot(offset, e)), 1e-12);
          EXPECT_LE(Length(offset), .49 * Length(e) * (1 + 1e-12));
        } else {
          inland_moved += at->second.z != mean.z ? 1 : 0;
        }
      }
    }
    EXPECT_GT(coasts, 100u);
    EXPECT_GT(coast_moved, coasts * 9 / 10);
    EXPECT_GT(inland_moved, 100u);
  }
}

TEST(SurfaceSeamsTest, S22_TaiwansWaterlineStaysAtZero) {
  FractalSettings settings = SurfaceSettings(.03);
  settings.coast = true;
  const WeldedShape welded = Weld(*Prepare(TaiwanRelief(), settings));
  size_t coasts = 0;
  for (size_t v = 0; v < welded.coast.size(); ++v) {
    if (!welded.coast[v]) continue;
    ++coasts;
    EXPECT_EQ(welded.mesh.points[v].z, 0);
    EXPECT_GT(welded.direction[v].z, 0);  // still the land's normal, not the coast's way
  }
  EXPECT_GT(coasts, 400u);
  EXPECT_EQ(SeamsOf(WeldedLeaves(welded)).single, BorderPieces(TaiwanRelief(), .03));
}

// A tile of a plain with hills, from x0 to x0 + 1; its numbers begin at another corner where
// `turned`.
CoarseShape Tile(double x0, bool turned) {
  constexpr uint32_t kCells = 3;
  CoarseShape tile;
  const auto number = [&](uint32_t i, uint32_t j) {
    const uint32_t v = j * (kCells + 1) + i;
    return turned ? (kCells + 1) * (kCells + 1) - 1 - v : v;
  };
  tile.now.resize((kCells + 1) * (kCells + 1));
  for (uint32_t j = 0; j <= kCells; ++j) {
    for (uint32_t i = 0; i <= kCells; ++i) {
      const double x = x0 + i / double{kCells}, y = j / double{kCells};
      tile.now[number(i, j)] = Vec3(x, y, .2 * x * y);
      if (i == kCells || j == kCells) continue;
      tile.triangles.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      tile.triangles.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  }
  tile.rest = tile.now;
  return tile;
}

std::vector<Vec3> PointsAt(const WeldedShape& shape, double x) {
  std::vector<Vec3> points;
  for (const Vec3& p : shape.mesh.points) {
    if (p.x == x) points.push_back(p);
  }
  std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return a.y < b.y; });
  return points;
}

TEST(SurfaceSeamsTest, NeighbouringTilesMeetWhereDetailFollowsPlaces) {
  for (const Increments increments : {Increments::kMidpoint, Increments::kEven}) {
    FractalSettings settings = SurfaceSettings(.02);
    settings.direction = Direction::kUp;
    settings.increments = increments;
    for (const bool turned : {false, true}) {
      const auto borders = [&] {
        return std::pair(PointsAt(Weld(*Prepare(Tile(0, false), settings)), 1),
                         PointsAt(Weld(*Prepare(Tile(1, turned), settings)), 1));
      };
      settings.by_place = true;
      const auto [west, east] = borders();
      EXPECT_GT(west.size(), 40u);
      EXPECT_EQ(west, east);
      settings.by_place = false;
      const auto [other, apart] = borders();
      EXPECT_NE(other, apart);
    }
  }
}

}  // namespace
}  // namespace fjord::test
