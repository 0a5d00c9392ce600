// Coarse meshes for the tests of the surface method, and what to look for in its output.
#pragma once

#include <cmath>
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

// Two triangles, bent along their common edge.
inline CoarseShape Roof() {
  CoarseShape shape;
  shape.now = {{0, 0, 0}, {1, 0, .5}, {0, 1.1, .4}, {1.2, 1, -.2}};
  shape.rest = shape.now;
  shape.triangles = {{0, 1, 2}, {1, 3, 2}};
  return shape;
}

// An island of a few triangles that is bent, tilted and lifted against its rest pose.
inline CoarseShape Island() {
  CoarseShape shape = OutlineMesh(.7);
  for (size_t i = 0; i < shape.now.size(); ++i) {
    const double wave = .1 * static_cast<double>(i % 4);
    shape.now[i] = shape.now[i] * 1.2 + Vec3(.3, wave, .2 + wave * .5 + .1 * shape.now[i].x);
  }
  return shape;
}

inline FractalSettings SurfaceSettings(double epsilon) {
  FractalSettings settings = SettingsOf("surface", epsilon);
  settings.increments = Increments::kEven;
  return settings;
}

// By pixels: `pixels` of `focal` from an eye.
inline FractalSettings PixelSettings(double pixels, double focal, const Vec3& eye,
                                     double eye_radius = 0) {
  FractalSettings settings = SurfaceSettings(0);
  settings.fineness = {0, pixels, focal, .01, eye, eye_radius};
  return settings;
}

// Runs the rest of a scope at one SIMD level.
class AtSimdLevel {
 public:
  explicit AtSimdLevel(const std::string& level) { FJORD_CHECK(SetSimdLevel(level), level); }
  ~AtSimdLevel() { (void)SetSimdLevel("best"); }
  AtSimdLevel(const AtSimdLevel&) = delete;
  AtSimdLevel& operator=(const AtSimdLevel&) = delete;
};

// Edges of a soup of triangles by the bits of their ends' places: how many have one triangle and
// how many more than two. A crack or a T-junction leaves single edges on both of its sides.
struct Seams {
  size_t single = 0;
  size_t more = 0;
};

inline Seams SeamsOf(const std::vector<Leaf>& leaves) {
  using Place = std::array<uint64_t, 3>;
  const auto place = [](const Corner& c) { return Place{c.bits[0], c.bits[1], c.bits[2]}; };
  std::vector<std::pair<Place, Place>> edges;
  for (const Leaf& leaf : leaves) {
    for (size_t k = 0; k < 3; ++k) {
      edges.push_back(std::minmax(place(leaf[k]), place(leaf[(k + 1) % 3])));
    }
  }
  std::sort(edges.begin(), edges.end());
  Seams seams;
  for (size_t i = 0; i < edges.size();) {
    size_t end = i;
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    seams.single += end - i == 1 ? 1 : 0;
    seams.more += end - i > 2 ? 1 : 0;
    i = end;
  }
  return seams;
}

// Into how many pieces the border of a shape is cut by halving all that is longer than epsilon.
inline size_t BorderPieces(const CoarseShape& shape, double epsilon) {
  std::map<std::pair<uint32_t, uint32_t>, int> uses;
  for (const Triangle& t : shape.triangles) {
    for (size_t k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
  }
  size_t pieces = 0;
  for (const auto& [ends, count] : uses) {
    if (count != 1) continue;
    size_t cuts = 1;
    for (double length = Length(shape.rest[ends.second] - shape.rest[ends.first]); length > epsilon;
         length *= .5) {
      cuts *= 2;
    }
    pieces += cuts;
  }
  return pieces;
}

using Places = std::map<Identity, Vec3>;
inline Places PlacesOf(const WeldedShape& welded) {
  Places places;
  for (size_t v = 0; v < welded.identity.size(); ++v) {
    places[welded.identity[v]] = welded.mesh.points[v];
  }
  return places;
}

using EdgePairs = std::vector<std::pair<uint32_t, uint32_t>>;
inline EdgePairs EdgesOf(const WeldedShape& welded) {
  EdgePairs edges;
  const std::vector<uint32_t>& v = welded.mesh.face_vertex;
  for (size_t i = 0; i < v.size(); i += 3) {
    for (size_t k = 0; k < 3; ++k) edges.push_back(std::minmax(v[i + k], v[i + (k + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace fjord::test
