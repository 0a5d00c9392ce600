// Small meshes that many geometry tests start from.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "engine/geometry/mesh.h"

namespace fjord {

// Four corners of the unit square, two triangles over the diagonal 1-3 (from 1).
inline Mesh TwoTriangles() {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.AddFace(Triangle{0, 1, 2});
  mesh.AddFace(Triangle{0, 2, 3});
  return mesh;
}

inline Mesh Tetrahedron() {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.AddFace(Triangle{0, 2, 1});
  mesh.AddFace(Triangle{0, 1, 3});
  mesh.AddFace(Triangle{0, 3, 2});
  mesh.AddFace(Triangle{1, 2, 3});
  return mesh;
}

// The same faces in another order, each starting at another corner.
inline Mesh Shuffled(const Mesh& mesh, uint32_t seed) {
  std::minstd_rand random(seed);
  std::vector<std::vector<uint32_t>> faces;
  size_t begin = 0;
  for (const uint32_t size : mesh.face_size) {
    faces.emplace_back(mesh.face_vertex.begin() + static_cast<long>(begin),
                       mesh.face_vertex.begin() + static_cast<long>(begin + size));
    begin += size;
    std::rotate(faces.back().begin(), faces.back().begin() + static_cast<long>(random() % size),
                faces.back().end());
  }
  std::shuffle(faces.begin(), faces.end(), random);
  Mesh shuffled;
  shuffled.points = mesh.points;
  shuffled.colors = mesh.colors;
  for (const auto& face : faces) shuffled.AddFace(face);
  return shuffled;
}

}  // namespace fjord
