#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/geometry/primitive_parts.h"
#include "engine/geometry/primitives.h"

namespace fjord {

using namespace primitive;  // NOLINT(google-build-using-namespace): this folder's own parts

namespace {

constexpr uint32_t kMostSteps = 1264;  // 10 steps^2 + 2 points

// An icosahedron with two corners on the z axis, its triangles outward counter-clockwise.
struct Icosahedron {
  std::array<Vec3, 12> corners;
  std::array<Triangle, 20> faces;
};

Icosahedron MakeIcosahedron() {
  const double root = std::sqrt(5.);
  const double height = 1 / root, around = 2 / root;
  const double cos72 = (root - 1) / 4, sin72 = std::sqrt(10 + 2 * root) / 4;
  const double cos36 = (root + 1) / 4, sin36 = std::sqrt(10 - 2 * root) / 4;
  const std::array<Vec2, 5> ring = {
      {{1, 0}, {cos72, sin72}, {-cos36, sin36}, {-cos36, -sin36}, {cos72, -sin72}}};
  Icosahedron made;
  made.corners[0] = Vec3(0, 0, 1);
  made.corners[11] = Vec3(0, 0, -1);
  for (uint32_t k = 0; k < 5; ++k) {
    const uint32_t next = (k + 1) % 5;
    made.corners[1 + k] = {around * ring[k].x, around * ring[k].y, height};
    // Turned by half a turn against the upper ring, which the signs of both places do.
    made.corners[6 + k] = {-around * ring[k].x, -around * ring[k].y, -height};
    const uint32_t below = 6 + (k + 3) % 5, before = 6 + (k + 2) % 5;
    made.faces[k] = {0, 1 + k, 1 + next};
    made.faces[5 + k] = {1 + k, below, 1 + next};
    made.faces[10 + k] = {1 + k, before, below};
    made.faces[15 + k] = {11, 6 + next, 6 + k};
  }
  return made;
}

// The weight of a corner at a share of the way to it. A straight share would crowd the points near
// the corners; with this one edges stay within 1.19 times each other, and so do areas.
double Weight(uint32_t i, uint32_t steps) {
  const double share = 1. * i / steps;
  return share * (1.25 - .25 * share * share);
}

class EvenSphere {
 public:
  EvenSphere(const Vec3& radii, uint32_t steps) : radii_(radii), steps_(steps) {
    for (const Vec3& corner : solid_.corners) mesh_.points.push_back(radii * corner);
    for (auto& row : first_on_edge_) row.fill(0);
  }

  Mesh Make() {
    for (const Triangle& face : solid_.faces) AddFace(face);
    return std::move(mesh_);
  }

 private:
  void AddPoint(const Triangle& face, const std::array<uint32_t, 3>& shares) {
    Vec3 sum(0);
    for (int k = 0; k < 3; ++k) sum += Weight(shares[k], steps_) * solid_.corners[face[k]];
    mesh_.points.push_back(radii_ * Unit(sum));
  }

  // Point i of the way from a to b, one for both faces of the edge.
  uint32_t OnEdge(uint32_t a, uint32_t b, uint32_t i) {
    if (i == 0) return a;
    if (i == steps_) return b;
    if (a > b) return OnEdge(b, a, steps_ - i);
    uint32_t& first = first_on_edge_[a][b];
    if (first == 0) {
      first = static_cast<uint32_t>(mesh_.points.size());
      for (uint32_t k = 1; k < steps_; ++k) AddPoint({a, b, 0}, {steps_ - k, k, 0});
    }
    return first + i - 1;
  }

  // Rows run from the first corner to the opposite side; row r has r + 1 points.
  void AddFace(const Triangle& face) {
    std::vector<uint32_t> above = {face[0]}, row;
    for (uint32_t r = 1; r <= steps_; ++r) {
      row.clear();
      for (uint32_t i = 0; i <= r; ++i) {
        if (i == 0) {
          row.push_back(OnEdge(face[0], face[1], r));
        } else if (i == r) {
          row.push_back(OnEdge(face[0], face[2], r));
        } else if (r == steps_) {
          row.push_back(OnEdge(face[1], face[2], i));
        } else {
          row.push_back(static_cast<uint32_t>(mesh_.points.size()));
          AddPoint(face, {steps_ - r, r - i, i});
        }
      }
      for (uint32_t i = 0; i < r; ++i) {
        AddTriangle({above[i], row[i], row[i + 1]});
        if (i + 1 < r) AddTriangle({above[i], row[i + 1], above[i + 1]});
      }
      std::swap(above, row);
    }
  }

  void AddTriangle(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    mesh_.AddFace(t);
  }

  const Icosahedron solid_ = MakeIcosahedron();
  const Vec3 radii_;
  const uint32_t steps_;
  Mesh mesh_;
  // [a][b], a < b: the first of the points between two corners; 0: not made yet.
  std::array<std::array<uint32_t, 12>, 12> first_on_edge_;
};

}  // namespace

uint32_t EvenSteps(uint64_t points) {
  uint32_t steps = 1;
  // 10 steps^2 + 2 points; the next is taken from half way on.
  while (steps < kMostSteps && 10 * uint64_t{steps} * (steps + 1) + 2 < points) ++steps;
  return steps;
}

Result<Mesh> MakeEvenEllipsoid(const Vec3& radii, uint32_t steps) {
  if (!IsLength(radii.x) || !IsLength(radii.y) || !IsLength(radii.z)) return BadLength("radii");
  if (auto ok = CheckCount("steps", steps, 1); !ok) return ok.error();
  if (steps > kMostSteps) return CheckPoints(uint64_t{10} * steps, steps).error();
  return EvenSphere(radii, steps).Make();
}

}  // namespace fjord
