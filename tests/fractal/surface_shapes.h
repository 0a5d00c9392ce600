// Coarse meshes for the tests of the surface method, and what to look for in its output.
#pragma once

#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/check.h"
#include "engine/base/simd.h"
#include "engine/geometry/primitives.h"
#include "engine/geometry/triangulate.h"
#include "tests/fractal/collect.h"

namespace fjord::test {

inline CoarseShape CoarseOf(const Mesh& mesh) {
  CoarseShape shape;
  shape.now = shape.rest = mesh.points;
  shape.triangles = Triangulate(mesh);
  return shape;
}

// The numbers of examples/data/taiwan_relief.std; formats has the reader for people.
inline CoarseShape TaiwanRelief() {
  std::ifstream file(std::string(FJORD_SOURCE_DIR) + "/examples/data/taiwan_relief.std");
  std::string word;
  size_t points = 0, faces = 0;
  while (file >> word && word != "data") {
  }
  file >> points >> faces;
  Mesh mesh;
  for (size_t i = 0; i < points; ++i) {
    Vec3 p(0);
    file >> p.x >> p.y >> p.z;
    mesh.points.push_back(p);
  }
  for (size_t f = 0; f < faces; ++f) {
    size_t size = 0;
    file >> size;
    std::vector<uint32_t> corners(size);
    for (uint32_t& corner : corners) {
      file >> corner;
      --corner;
    }
    mesh.AddFace(corners);
  }
  FJORD_CHECK(file && faces == 167, faces);
  return CoarseOf(mesh);
}

inline CoarseShape Made(Result<Mesh> mesh) {
  FJORD_CHECK(mesh.ok(), mesh.error().message);
  return CoarseOf(*mesh);
}

inline CoarseShape Sphere() { return Made(MakeEllipsoid(Vec3(1, 1, 1), 9, 6)); }
inline CoarseShape Ellipsoid() { return Made(MakeEllipsoid(Vec3(1.5, 1, .6), 10, 5)); }
inline CoarseShape Torus() { return Made(MakeTorus(1, .35, 12, 6)); }

// Two triangles that form a roof, bent along their common edge.
inline CoarseShape Roof() {
  CoarseShape shape;
  shape.now = {{0, 0, 0}, {1, 0, .5}, {0, 1.1, .4}, {1.2, 1, -.2}};
  shape.rest = shape.now;
  shape.triangles = {{0, 1, 2}, {1, 3, 2}};
  return shape;
}

inline FractalSettings SurfaceSettings(double epsilon) { return SettingsOf("surface", epsilon); }

// Runs the rest of a scope at one SIMD level.
class AtSimdLevel {
 public:
  explicit AtSimdLevel(const std::string& level) { FJORD_CHECK(SetSimdLevel(level), level); }
  ~AtSimdLevel() { (void)SetSimdLevel("best"); }
};

// How the edges of a welded mesh meet, by the bits of their ends' places, not by numbers: how many
// have one triangle only, and how many of the vertices lie inside an edge of another triangle.
struct Seams {
  size_t single = 0;     // edges with one triangle
  size_t more = 0;       // edges with three or more
  size_t t_junctions = 0;
};

inline Seams SeamsOf(const std::vector<Leaf>& leaves, const std::vector<std::pair<uint64_t, uint64_t>>& parents = {}) {
  using Place = std::array<uint64_t, 3>;
  std::map<std::pair<Place, Place>, int> uses;
  const auto place = [](const Corner& c) { return Place{c.bits[0], c.bits[1], c.bits[2]}; };
  for (const Leaf& leaf : leaves) {
    for (size_t k = 0; k < 3; ++k) {
      auto ends = std::minmax(place(leaf[k]), place(leaf[(k + 1) % 3]));
      ++uses[{ends.first, ends.second}];
    }
  }
  Seams seams;
  (void)parents;
  for (const auto& [ends, count] : uses) {
    if (count == 1) ++seams.single;
    if (count > 2) ++seams.more;
  }
  return seams;
}

}  // namespace fjord::test
