// Finds what is wrong with a hand-made mesh before it is used (S28). Each defect carries its kind
// and the numbers (from 1) of what it concerns.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/geometry/mesh.h"

namespace fjord {

struct MeshDefect {
  enum class Kind {
    kDuplicateVertex,  // two vertices at one place
    kUnusedVertex,
    kTripleEdge,   // an edge with more than two faces
    kFlippedFace,  // two faces run along an edge in the same direction
    kZeroArea,
    kRepeatedVertex,  // a face names a vertex twice
    kClockwise,       // an open mesh of which every face faces down (-z), a closed one turned
                      // inside out
    kTJunction,       // a vertex lies inside a boundary edge of another face
    kBadIndex,
    kNotFinite,
  };
  Kind kind;
  uint32_t vertex = 0;  // 0: none
  uint32_t face = 0;
  std::string message;  // "vertices 3 and 9 are at one place (0.1, 0, 2)"
};

// At most `most` defects, in order of vertices, then faces, then the mesh as a whole (both numbers
// 0). Takes any mesh, also one whose indices or sizes are wrong; near-linear in its size. Places
// are one where they are equal bit for bit; a vertex lies in an edge where it is nearer than 1e-9
// of the mesh's extent.
std::vector<MeshDefect> CheckMesh(const Mesh& mesh, size_t most = 100);

struct MeshCounts {
  size_t vertices = 0, edges = 0, faces = 0, boundary_edges = 0, components = 0;
  int64_t euler = 0;    // V - E + F, of the vertices that faces use
  bool closed = false;  // every edge has two faces
};
// Needs in-range indices.
MeshCounts CountMesh(const Mesh& mesh);

}  // namespace fjord
