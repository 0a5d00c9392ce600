// A plane through three points (G51): Ax + By + Cz = D. The source prints D with a minus sign [T];
// with the plus sign D = A x1 + B y1 + C z1 the three points satisfy the equation.
#pragma once

#include "engine/geometry/vec.h"

namespace fjord {

struct Plane {
  Vec3 normal{0};  // (A, B, C), not of unit length; 0 where the points lie on one line
  double d = 0;    // D

  // A x + B y + C z - D: 0 on the plane, positive on the side the normal points to; in units of
  // |normal|.
  double Value(const Vec3& p) const { return glm::dot(normal, p) - d; }
};

// Counter-clockwise p1, p2, p3 are seen from the side that the normal points to.
inline Plane PlaneThrough(const Vec3& p1, const Vec3& p2, const Vec3& p3) {
  const Vec3 normal = glm::cross(p2 - p1, p3 - p1);
  return {normal, glm::dot(normal, p1)};
}

}  // namespace fjord
