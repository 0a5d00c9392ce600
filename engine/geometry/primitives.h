// Coarse shapes by formula: closed meshes of triangles, outward counter-clockwise, poles and seams
// welded. Points come from exact functions, so they have the same bits everywhere. Lengths must be
// greater than 0 and at most 1e12, shapes of at most 16,000,000 points; errors name what is wrong.
#pragma once

#include "engine/base/result.h"
#include "engine/geometry/mesh.h"

namespace fjord {

// segments around (>= 3), rings from pole to pole (>= 2).
Result<Mesh> MakeEllipsoid(const Vec3& radii, uint32_t segments, uint32_t rings);
// The same solid without poles, by dividing each edge of an icosahedron into
// `steps` (>= 1): 10 steps^2 + 2 points, six edges at each but for twelve with five, edges of a
// sphere within 1.19 times each other. Only + - * / and sqrt.
Result<Mesh> MakeEvenEllipsoid(const Vec3& radii, uint32_t steps);
// The steps that give nearest to so many points, at least 1.
uint32_t EvenSteps(uint64_t points);
// Around z: centre line `radius`, tube `tube` < radius; both counts >= 3.
Result<Mesh> MakeTorus(double radius, double tube, uint32_t segments, uint32_t rings);
// Centred, closed; along z as many steps as the larger of the two counts.
Result<Mesh> MakeBox(const Vec3& size, uint32_t along_x, uint32_t along_y);
// In the plane z = 0, centred, alternating diagonals, open; size.z is not used.
Result<Mesh> MakeGrid(const Vec3& size, uint32_t along_x, uint32_t along_y);

}  // namespace fjord
