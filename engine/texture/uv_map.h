// (u,v) of a surface as a function of the rest pose: one rule for a whole shape, so that no mesh
// carries coordinates, poles and seams need no vertices of their own, and what is made fine stays
// exact. Primitives say which rule is theirs. Thread-safe.
#pragma once

#include <cstdint>

#include "engine/geometry/vec.h"

namespace fjord {

enum class UvKind : uint32_t {
  kNone = 0,
  kPlane = 1,   // GRID: u along x, v along y
  kSphere = 2,  // SPHERE, ELLIPSOID: u the longitude, v the latitude
  kTorus = 3,   // TORUS: u round the axis, v round the tube
  kBox = 4,     // BOX: each face 0..1
};

struct UvMap {
  UvKind kind = UvKind::kNone;
  Vec3 size{1};  // kPlane, kBox: whole width; kSphere: radii; kTorus: x the centre line's radius
};

struct UvPoint {
  double u = 0, v = 0;
  Vec3 along_u{0};  // the direction in which u grows, rest pose, any length; 0 at poles
};

// 0..1 over the whole surface.
UvPoint MapUv(const UvMap& map, const Vec3& rest);

}  // namespace fjord
