// Polygons to triangles. The answer depends on vertex numbers and places alone, not on the corner a
// face starts at: convex faces become a fan from their smallest vertex, concave ones lose ears.
//
// Every polygon of n corners gives exactly n - 2 triangles, also a folded or self-crossing one
// (whose triangles then overlap). To keep one tree for a whole animation, triangulate the rest pose
// and use its triangles for every frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/geometry/mesh.h"

namespace fjord {

// Appends the triangles of one polygon, each turned as the polygon and with its smallest vertex
// first. Near-linear for outlines as they occur (ears are looked up in a grid).
void TriangulatePolygon(std::span<const Vec3> points, std::span<const uint32_t> polygon,
                        std::vector<Triangle>* triangles);

// All faces, in their order. Needs in-range indices; faces of fewer than three corners give none.
std::vector<Triangle> Triangulate(std::span<const Vec3> points, std::span<const uint32_t> face_size,
                                  std::span<const uint32_t> face_vertex);
std::vector<Triangle> Triangulate(const Mesh& mesh);

}  // namespace fjord
