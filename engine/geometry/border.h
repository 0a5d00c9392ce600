// The border of a mesh: the edges that one face alone has, joined into outlines. Pure.
#pragma once

#include <vector>

#include "engine/geometry/join_edges.h"
#include "engine/geometry/mesh.h"

namespace fjord {

// In the order of the faces they come first in, each in the direction of that face; the numbers are
// of mesh.points. Empty where the mesh is closed. Needs in-range indices. O(corners log corners).
std::vector<Chain> BorderOf(const Mesh& mesh);

}  // namespace fjord
