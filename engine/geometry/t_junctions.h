// T-junctions: vertices that lie inside an edge they are no end of. They open cracks as soon as the
// edge is displaced (S4).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/geometry/mesh.h"

namespace fjord {

struct TJunction {
  uint32_t vertex = 0;
  uint32_t edge = 0;  // index into `edges`
};

// All pairs of one of `vertices` and one of `edges` (both numbers of points) where the vertex is
// nearer to the edge than `tolerance` and further than that from both ends; by vertex, then edge;
// at most `most` of them. Near-linear for meshes as they occur (a k-d tree over the vertices).
std::vector<TJunction> FindTJunctions(std::span<const Vec3> points,
                                      std::span<const uint32_t> vertices,
                                      std::span<const std::array<uint32_t, 2>> edges,
                                      double tolerance, size_t most);

}  // namespace fjord
