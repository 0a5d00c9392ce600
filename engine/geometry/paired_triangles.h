// Triangles that know their neighbours, for work that turns and halves edges. Private to this
// folder; owns its arrays, one thread at a time.
//
// An edge is named by a corner: edge h runs from corner h to corner Next(h) of triangle h / 3, and
// Twin(h) is the same edge in the triangle on its other side.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/geometry/mesh.h"

namespace fjord {

class PairedTriangles {
 public:
  static constexpr uint32_t kNone = 0xffffffffu;

  // Faces are triangulated. Edges of three faces and more, or of two that turn against each other,
  // have no twin and are Shared.
  explicit PairedTriangles(const Mesh& mesh);
  Mesh Take();

  static uint32_t Next(uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static uint32_t Before(uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

  size_t PointCount() const { return points_.size(); }
  uint32_t TriangleCount() const { return static_cast<uint32_t>(plane_.size()); }
  uint32_t EdgeCount() const { return static_cast<uint32_t>(corners_.size()); }
  uint32_t Twin(uint32_t h) const { return twin_[h]; }
  bool Shared(uint32_t h) const { return shared_[h]; }
  // Neither border nor crease: its triangles lie in one plane.
  bool IsInner(uint32_t h) const {
    return twin_[h] != kNone && plane_[h / 3] == plane_[twin_[h] / 3];
  }

  const Vec3& From(uint32_t h) const { return points_[corners_[h]]; }
  const Vec3& To(uint32_t h) const { return points_[corners_[Next(h)]]; }
  const Vec3& Apex(uint32_t h) const { return points_[corners_[Before(h)]]; }
  double Length2(uint32_t h) const {
    const Vec3 along = To(h) - From(h);
    return glm::dot(along, along);
  }
  // A total order: of two of one length that with the smaller numbers, from either side alike.
  bool IsLonger(uint32_t g, uint32_t h) const;
  uint32_t LongestOf(uint32_t triangle) const;
  // Twice the area of a, b, c as seen from the front of the triangle's plane.
  double Area(uint32_t triangle, const Vec3& a, const Vec3& b, const Vec3& c) const {
    return glm::dot(glm::cross(b - a, c - a), normal_[plane_[triangle]]);
  }

  // Can the inner edge h run the other way, between the apexes of its triangles? Not where they do
  // not fill a convex quad, or have an edge already.
  bool CanTurn(uint32_t h) const;
  // Makes it so; the edges around both triangles.
  std::array<uint32_t, 4> Turn(uint32_t h);
  // Puts a point into the middle of edge h. The edges around what were its triangles: two, or four.
  std::vector<uint32_t> Halve(uint32_t h);

 private:
  void FindTwins(const std::vector<Triangle>& triangles);
  void FindPlanes();
  void Join(uint32_t h, uint32_t twin);
  bool HasEdgeFromApex(uint32_t h, uint32_t vertex) const;
  uint32_t HalveSide(uint32_t h, uint32_t middle);

  std::vector<Vec3> points_;
  std::vector<Rgb> colors_;
  std::vector<uint32_t> corners_;
  std::vector<uint32_t> twin_;
  std::vector<bool> shared_;
  std::vector<uint32_t> plane_;  // one a triangle: a triangle that lies in it
  std::vector<Vec3> normal_;     // of a plane
};

}  // namespace fjord
