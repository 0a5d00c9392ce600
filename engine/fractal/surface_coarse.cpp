#include "engine/fractal/surface_coarse.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "engine/base/clamp.h"
#include "engine/base/random.h"
#include "engine/fractal/shares.h"
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

// The side of a triangle that its roles count from, and whether its template is kShareRight's.
struct TriangleRoles {
  uint32_t longest = 0;
  bool right = false;
};

// One and the same for -0 and 0.
uint64_t KeyOfPlace(const Vec3& p) {
  uint64_t key = 0;
  for (int k = 0; k < 3; ++k) key = Mix64(key + kShareStep + std::bit_cast<uint64_t>(p[k] + 0.));
  return key;
}

TriangleRoles RolesOf(const CoarseSurface& coarse, size_t t, bool current, const uint64_t* ids) {
  const auto length2 = [&](uint32_t k) {
    const CoarseEdge& edge = coarse.edges[coarse.triangle_edges[t][k]];
    return current ? edge.current2 : edge.length2;
  };
  const auto sum = [&](uint32_t k) { return ids[k] + ids[(k + 1) % 3]; };
  TriangleRoles roles;
  for (uint32_t k = 1; k < 3; ++k) {
    const double most = length2(roles.longest);
    const bool equal = length2(k) == most;
    if (length2(k) > most || (equal && sum(k) < sum(roles.longest))) roles.longest = k;
  }
  const double c2 = length2(roles.longest);
  const double others2 = length2((roles.longest + 1) % 3) + length2((roles.longest + 2) % 3);
  roles.right = (others2 + others2) - c2 <= kMostRight * c2;
  return roles;
}

// The shares of an edge belong to it, so that whatever uses it reads the same two: those of its
// triangles where two run along it in opposite ways, otherwise two of its own. `by_place`: those
// two do not change sides with the vertices' numbers, so that a neighbouring tile has the same.
void SetShares(const EdgeTable& table, bool current, bool by_place, CoarseSurface* coarse) {
  std::vector<uint64_t> shares;  // three a triangle
  for (size_t t = 0; t < coarse->triangles.size(); ++t) {
    uint64_t ids[3];
    for (size_t k = 0; k < 3; ++k) ids[k] = coarse->identity[coarse->triangles[t][k]].lo;
    const TriangleRoles roles = RolesOf(*coarse, t, current, ids);
    const uint64_t share = CoarseShare(ids[0], ids[1], ids[2]) | (roles.right ? kShareRight : 0);
    for (uint32_t k = 0; k < 3; ++k) shares.push_back(share | (k + 2 + 3 - roles.longest) % 3);
  }
  for (size_t e = 0; e < coarse->edges.size(); ++e) {
    CoarseEdge& made = coarse->edges[e];
    const std::span<const EdgeUse> uses = table.Uses(table.edges()[e]);
    if (uses.size() == 2 && uses[0].forward != uses[1].forward) {
      made.left = shares[uses[uses[0].forward ? 0 : 1].corner];
      made.right = shares[uses[uses[0].forward ? 1 : 0].corner];
      continue;
    }
    const uint64_t a = coarse->identity[made.a].lo, b = coarse->identity[made.b].lo;
    const uint64_t left = by_place && a > b ? 1 : 0;
    made.left = EdgeShare(a, b, left);
    made.right = EdgeShare(a, b, 1 - left);
  }
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
                    0,
                    0,
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

  for (size_t v = 0; v < now.size(); ++v) {
    coarse.identity.push_back(CoarseIdentity(seed, rules.by_place ? KeyOfPlace(shape.rest[v]) : v));
  }
  if (rules.even) SetShares(table, rules.current(), rules.by_place, &coarse);

  const std::vector<Vec3> normals = VertexNormals(now, coarse.triangles);
  const std::vector<float> stretches =
      stretch ? Stretches(coarse, now.size()) : std::vector<float>(now.size(), 1);
  for (size_t v = 0; v < now.size(); ++v) {
    const double eye2 = Length2((rules.current() ? now[v] : shape.rest[v]) - rules.eye);
    coarse.eye_distance2.push_back(eye2);
    coarse.vertices.push_back({now[v],
                               rules.direction == Direction::kUp ? Vec3(0, 0, 1) : normals[v],
                               coarse.identity[v].lo, stretches[v], ClampToFloat(eye2)});
    for (int i = 0; i < 3; ++i) {
      const double size = now[v][i] < 0 ? -now[v][i] : now[v][i];
      if (size > coarse.largest) coarse.largest = size;
    }
  }
  return coarse;
}

}  // namespace fjord
