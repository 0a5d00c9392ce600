// Which way the faces of a mesh are turned. Orientation is checked, never assumed.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/geometry/edges.h"
#include "engine/geometry/mesh.h"

namespace fjord {

// A face that runs along an edge in the same direction as its neighbour there; or one among such
// faces that agrees with all its neighbours (edge = EdgeTable::kNone, neighbour = face).
struct FlippedFace {
  uint32_t face = 0;
  uint32_t neighbour = 0;
  uint32_t edge = 0;  // number in the table
};

// The faces to turn so that neighbours agree: in each connected part the smaller group (at a tie
// the one without the part's first face), by face. Where no turning helps (a Moebius band), one
// face at each edge that cannot be healed.
std::vector<FlippedFace> FindFlippedFaces(const Mesh& mesh, const EdgeTable& table);

enum class Facing {
  kRight,   // or: cannot be told
  kDown,    // open, and every face that faces up or down faces down
  kInward,  // closed, with a negative volume
};
Facing FacingOf(const Mesh& mesh, const EdgeTable& table);

// Turns every face the other way round.
void FlipMesh(Mesh* mesh);

}  // namespace fjord
