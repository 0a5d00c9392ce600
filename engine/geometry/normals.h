// Normals of coarse shapes (S18-S20). Sums run in an order that depends on vertex numbers alone:
// the order of a mesh's faces and the corner each face starts at change no bit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/geometry/mesh.h"

namespace fjord {

// The area vector of a polygon (Newell): normal to it, as long as twice its area, summed from the
// smallest vertex number. For a triangle: the cross product of its two edges from that vertex.
Vec3 AreaVector(std::span<const Vec3> points, std::span<const uint32_t> polygon);

// One a point: the unit sum of the area vectors of its faces; +z for a point without a face or
// whose faces cancel out. Needs in-range indices.
std::vector<Vec3> VertexNormals(std::span<const Vec3> points, std::span<const Triangle> triangles);
std::vector<Vec3> VertexNormals(const Mesh& mesh);

}  // namespace fjord
