#include "engine/fractal/surface_coarse.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/clamp.h"
#include "engine/base/random.h"
#include "engine/geometry/edges.h"
#include "engine/geometry/normals.h"

namespace fjord {
namespace {

double Length2(const Vec3& v) { return glm::dot(v, v); }

Result<Ok> CheckShape(const CoarseShape& shape) {
  if (shape.curve) return Invalid("the method surface takes a mesh of faces, not a curve");
  if (shape.rest.size() != shape.now.size()) {
    return Invalid("the rest pose has " + std::to_string(shape.rest.size()) +
                   " points, the shape " + std::to_string(shape.now.size()));
  }
  if (!shape.colors.empty() && shape.colors.size() != shape.now.size()) {
    return Invalid("the shape has " + std::to_string(shape.colors.size()) + " colours for " +
                   std::to_string(shape.now.size()) + " points");
  }
  for (const Triangle& triangle : shape.triangles) {
    for (const uint32_t corner : triangle) {
      if (corner >= shape.now.size()) {
        return Invalid("a face names point " + std::to_string(corner + uint64_t{1}) + " of " +
                       std::to_string(shape.now.size()));
      }
    }
  }
  return Ok{};
}

std::vector<Triangle> SoundTriangles(const std::vector<Triangle>& given) {
  std::vector<Triangle> triangles;
  triangles.reserve(given.size());
  for (Triangle t : given) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.push_back(t);
  }
  return triangles;
}

// Mean over a vertex's edges of length now / rest length; edges come sorted, so the sum's order
// depends on vertex numbers alone.
std::vector<float> Stretches(const CoarseSurface& coarse, size_t vertices) {
  std::vector<double> sum(vertices);
  std::vector<uint32_t> count(vertices);
  for (const CoarseEdge& edge : coarse.edges) {
    if (!(edge.length2 > 0)) continue;
    const double ratio = std::sqrt(edge.current2) / std::sqrt(edge.length2);
    for (const uint32_t v : {edge.a, edge.b}) {
      sum[v] += ratio;
      ++count[v];
    }
  }
  std::vector<float> stretch(vertices, 1);
  for (size_t v = 0; v < vertices; ++v) {
    if (count[v] == 0) continue;
    const double mean = sum[v] / count[v];
    stretch[v] = static_cast<float>(mean < 1e30 ? mean : 1e30);
  }
  return stretch;
}

}  // namespace

EdgeSite CoarseSurface::SiteOf(const SurfaceRules& rules, size_t triangle, int k) const {
  if (k == 3) return {face_normals[triangle], 0};
  EdgeSite site = edges[triangle_edges[triangle][static_cast<size_t>(k)]].site;
  if (rules.direction == Direction::kFace) site.direction = face_normals[triangle];
  return site;
}

Result<CoarseSurface> MakeCoarseSurface(const CoarseShape& shape, const SurfaceRules& rules,
                                        uint64_t seed, bool stretch) {
  if (const Result<Ok> sound = CheckShape(shape); !sound.ok()) return sound.error();
  CoarseSurface coarse;
  coarse.colors = shape.colors;
  coarse.triangles = SoundTriangles(shape.triangles);
  const std::vector<Vec3>& now = shape.now;
  for (const Triangle& t : coarse.triangles) {
    coarse.face_normals.push_back(Unit(AreaVector(now, t), Vec3(0, 0, 1)));
  }

  const EdgeTable table(coarse.triangles);
  for (const Edge& edge : table.edges()) {
    CoarseEdge made{edge.a,
                    edge.b,
                    Length2(shape.rest[edge.b] - shape.rest[edge.a]),
                    Length2(now[edge.b] - now[edge.a]),
                    {}};
    for (const EdgeUse& use : table.Uses(edge)) {
      made.site.direction += coarse.face_normals[use.face];
    }
    made.site.direction = Unit(made.site.direction);
    made.site.coast = rules.coast && edge.use_count == 1 ? 1 : 0;
    coarse.edges.push_back(made);
  }
  for (size_t t = 0; t < coarse.triangles.size(); ++t) {
    Triangle edges;
    for (uint32_t k = 0; k < 3; ++k) edges[k] = table.OfCorner(static_cast<uint32_t>(3 * t + k));
    coarse.triangle_edges.push_back(edges);
  }

  const std::vector<Vec3> normals = VertexNormals(now, coarse.triangles);
  const std::vector<float> stretches =
      stretch ? Stretches(coarse, now.size()) : std::vector<float>(now.size(), 1);
  for (size_t v = 0; v < now.size(); ++v) {
    const double eye2 = Length2((rules.current() ? now[v] : shape.rest[v]) - rules.eye);
    coarse.eye_distance2.push_back(eye2);
    coarse.vertices.push_back({now[v],
                               rules.direction == Direction::kUp ? Vec3(0, 0, 1) : normals[v],
                               CoarseIdentity(seed, v).lo, stretches[v], ClampToFloat(eye2)});
    for (int i = 0; i < 3; ++i) {
      const double size = now[v][i] < 0 ? -now[v][i] : now[v][i];
      if (size > coarse.largest) coarse.largest = size;
    }
  }
  return coarse;
}

}  // namespace fjord
