#include <cstddef>
#include <numeric>

#include "engine/geometry/check_mesh.h"
#include "engine/geometry/edges.h"

namespace fjord {

MeshCounts CountMesh(const Mesh& mesh) {
  const EdgeTable table(mesh);
  MeshCounts counts;
  counts.vertices = mesh.points.size();
  counts.edges = table.edges().size();
  counts.faces = mesh.FaceCount();
  counts.closed = counts.faces > 0;
  for (const Edge& edge : table.edges()) {
    if (edge.use_count == 1) ++counts.boundary_edges;
    if (edge.use_count != 2) counts.closed = false;
  }

  // Union of the vertices of each face; a component is a root that a face uses.
  std::vector<uint32_t> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&parent](uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  std::vector<bool> used(mesh.points.size(), false);
  size_t begin = 0;
  for (const uint32_t size : mesh.face_size) {
    for (size_t k = 0; k < size; ++k) {
      const uint32_t v = mesh.face_vertex[begin + k];
      used[v] = true;
      const uint32_t a = root(mesh.face_vertex[begin]), b = root(v);
      if (a < b) parent[b] = a;
      if (b < a) parent[a] = b;
    }
    begin += size;
  }
  size_t used_count = 0;
  for (uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (!used[v]) continue;
    ++used_count;
    if (root(v) == v) ++counts.components;
  }
  counts.euler = static_cast<int64_t>(used_count) - static_cast<int64_t>(counts.edges) +
                 static_cast<int64_t>(counts.faces);
  return counts;
}

}  // namespace fjord
