#include "engine/geometry/edges.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace fjord {

struct EdgeTable::HalfEdge {
  uint32_t a;
  uint32_t b;
  uint32_t following;  // the vertex after the edge in its face
  uint32_t face;
  uint32_t corner;
  bool forward;

  auto Order() const { return std::tuple(a, b, !forward, following, face, corner); }
};

EdgeTable::EdgeTable(const Mesh& mesh) {
  std::vector<HalfEdge> halves;
  halves.reserve(mesh.face_vertex.size());
  size_t begin = 0;
  for (size_t f = 0; f < mesh.face_size.size(); ++f) {
    const size_t n = mesh.face_size[f];
    for (size_t k = 0; k < n; ++k) {
      const uint32_t u = mesh.face_vertex[begin + k];
      const uint32_t v = mesh.face_vertex[begin + (k + 1) % n];
      if (u == v) continue;
      halves.push_back({std::min(u, v), std::max(u, v), mesh.face_vertex[begin + (k + 2) % n],
                        static_cast<uint32_t>(f), static_cast<uint32_t>(begin + k), u < v});
    }
    begin += n;
  }
  Build(std::move(halves), mesh.face_vertex.size());
}

EdgeTable::EdgeTable(std::span<const Triangle> triangles) {
  std::vector<HalfEdge> halves;
  halves.reserve(triangles.size() * 3);
  for (size_t f = 0; f < triangles.size(); ++f) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t u = triangles[f][k];
      const uint32_t v = triangles[f][(k + 1) % 3];
      if (u == v) continue;
      halves.push_back({std::min(u, v), std::max(u, v), triangles[f][(k + 2) % 3],
                        static_cast<uint32_t>(f), static_cast<uint32_t>(3 * f + k), u < v});
    }
  }
  Build(std::move(halves), triangles.size() * 3);
}

void EdgeTable::Build(std::vector<HalfEdge> halves, size_t corners) {
  std::sort(halves.begin(), halves.end(),
            [](const HalfEdge& l, const HalfEdge& r) { return l.Order() < r.Order(); });
  of_corner_.assign(corners, kNone);
  uses_.reserve(halves.size());
  for (const HalfEdge& half : halves) {
    if (edges_.empty() || edges_.back().a != half.a || edges_.back().b != half.b) {
      edges_.push_back({half.a, half.b, static_cast<uint32_t>(uses_.size()), 0});
    }
    ++edges_.back().use_count;
    of_corner_[half.corner] = static_cast<uint32_t>(edges_.size() - 1);
    uses_.push_back({half.face, half.corner, half.forward});
  }
}

uint32_t EdgeTable::Find(uint32_t u, uint32_t v) const {
  const std::pair<uint32_t, uint32_t> wanted(std::min(u, v), std::max(u, v));
  const auto at = std::lower_bound(edges_.begin(), edges_.end(), wanted,
                                   [](const Edge& edge, const std::pair<uint32_t, uint32_t>& key) {
                                     return std::pair(edge.a, edge.b) < key;
                                   });
  if (at == edges_.end() || std::pair(at->a, at->b) != wanted) return kNone;
  return static_cast<uint32_t>(at - edges_.begin());
}

}  // namespace fjord
