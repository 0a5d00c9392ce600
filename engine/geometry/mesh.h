// Coarse and welded shapes as plain values: a polygon mesh and a polyline. Vertices count from 0
// here (from 1 in files and messages to people). Copying is deep; reading from many threads is
// safe.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/geometry/vec.h"

namespace fjord {

// Faces are stored one after another: face f has face_size[f] entries of face_vertex.
// Invariant of a checked mesh: sizes >= 3, sum of sizes = face_vertex.size(), entries <
// points.size(), colors empty or one a point, all numbers finite.
struct Mesh {
  std::vector<Vec3> points;
  std::vector<uint32_t> face_size;
  std::vector<uint32_t> face_vertex;
  std::vector<Rgb> colors;

  size_t FaceCount() const { return face_size.size(); }
  void AddFace(std::span<const uint32_t> vertices) {
    face_size.push_back(static_cast<uint32_t>(vertices.size()));
    face_vertex.insert(face_vertex.end(), vertices.begin(), vertices.end());
  }
};

// A chain of points; closed: the last is joined to the first (and not repeated).
struct Polyline {
  std::vector<Vec3> points;
  bool closed = false;
};

using Triangle = std::array<uint32_t, 3>;

}  // namespace fjord
