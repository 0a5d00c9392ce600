// The edges of a mesh, each once, with the faces that use it.
//
// Edges come sorted by (a, b), a < b. The uses of an edge come in an order that does not depend on
// the order in which the mesh lists its faces: by direction, then by the vertex that follows the
// edge in the face, then by face number. Owns its arrays; immutable once built, safe to read from
// any thread.
//
// Needs in-range indices (CheckMesh says so); an edge from a vertex to itself is left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/geometry/mesh.h"

namespace fjord {

struct EdgeUse {
  uint32_t face = 0;
  uint32_t corner = 0;   // entry of face_vertex where the edge starts; 3 * face + k for triangles
  bool forward = false;  // the face runs from a to b
};

struct Edge {
  uint32_t a = 0;  // a < b
  uint32_t b = 0;
  uint32_t first_use = 0;
  uint32_t use_count = 0;  // 1: a boundary edge
};

class EdgeTable {
 public:
  static constexpr uint32_t kNone = 0xffffffffu;

  explicit EdgeTable(const Mesh& mesh);
  explicit EdgeTable(std::span<const Triangle> triangles);

  std::span<const Edge> edges() const { return edges_; }
  std::span<const EdgeUse> Uses(const Edge& edge) const {
    return std::span<const EdgeUse>(uses_).subspan(edge.first_use, edge.use_count);
  }
  // The number of the edge between two vertices in either order, or kNone.
  uint32_t Find(uint32_t u, uint32_t v) const;
  // The number of the edge that starts at an entry of face_vertex (3 * triangle + k), or kNone.
  uint32_t OfCorner(uint32_t corner) const { return of_corner_[corner]; }

 private:
  struct HalfEdge;
  void Build(std::vector<HalfEdge> halves, size_t corners);

  std::vector<Edge> edges_;
  std::vector<EdgeUse> uses_;
  std::vector<uint32_t> of_corner_;
};

}  // namespace fjord
