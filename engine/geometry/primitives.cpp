#include "engine/geometry/primitives.h"

#include <algorithm>

#include "engine/base/exact_math.h"
#include "engine/geometry/primitive_parts.h"

namespace fjord {

using namespace primitive;  // NOLINT(google-build-using-namespace): this folder's own parts

namespace {

struct Turn {
  double sin = 0;
  double cos = 1;
};

Turn TurnOf(double share) {
  const double radians = 2 * exact::kPi * share;
  return {exact::Sin(radians), exact::Cos(radians)};
}

}  // namespace

Result<Mesh> MakeEllipsoid(const Vec3& radii, uint32_t segments, uint32_t rings) {
  if (!IsLength(radii.x) || !IsLength(radii.y) || !IsLength(radii.z)) return BadLength("radii");
  if (auto ok = CheckCount("segments", segments, 3); !ok) return ok.error();
  if (auto ok = CheckCount("rings", rings, 2); !ok) return ok.error();
  if (auto ok = CheckPoints(segments, rings); !ok) return ok.error();

  Mesh mesh;
  mesh.points.push_back(Vec3(0, 0, radii.z));
  for (uint32_t r = 1; r < rings; ++r) {
    const Turn down = TurnOf(.5 * r / rings);
    for (uint32_t s = 0; s < segments; ++s) {
      const Turn round = TurnOf(1. * s / segments);
      mesh.points.push_back(
          {radii.x * (down.sin * round.cos), radii.y * (down.sin * round.sin), radii.z * down.cos});
    }
  }
  mesh.points.push_back(Vec3(0, 0, -radii.z));

  const auto south = static_cast<uint32_t>(mesh.points.size() - 1);
  const auto at = [&](uint32_t r, uint32_t s) { return 1 + (r - 1) * segments + s % segments; };
  for (uint32_t s = 0; s < segments; ++s) {
    mesh.AddFace(Triangle{0, at(1, s), at(1, s + 1)});
  }
  for (uint32_t r = 1; r + 1 < rings; ++r) {
    for (uint32_t s = 0; s < segments; ++s) {
      AddQuad(at(r, s), at(r + 1, s), at(r + 1, s + 1), at(r, s + 1), (r + s) % 2 == 1, &mesh);
    }
  }
  for (uint32_t s = 0; s < segments; ++s) {
    Triangle t = {at(rings - 1, s), south, at(rings - 1, s + 1)};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    mesh.AddFace(t);
  }
  return mesh;
}

Result<Mesh> MakeTorus(double radius, double tube, uint32_t segments, uint32_t rings) {
  if (!IsLength(radius)) return BadLength("radius");
  if (!IsLength(tube)) return BadLength("tube");
  if (tube >= radius) return Invalid("tube must be smaller than radius, or the torus meets itself");
  if (auto ok = CheckCount("segments", segments, 3); !ok) return ok.error();
  if (auto ok = CheckCount("rings", rings, 3); !ok) return ok.error();
  if (auto ok = CheckPoints(segments, rings); !ok) return ok.error();

  Mesh mesh;
  for (uint32_t s = 0; s < segments; ++s) {
    const Turn round = TurnOf(1. * s / segments);
    for (uint32_t r = 0; r < rings; ++r) {
      const Turn up = TurnOf(1. * r / rings);
      const double from_axis = radius + tube * up.cos;
      mesh.points.push_back({from_axis * round.cos, from_axis * round.sin, tube * up.sin});
    }
  }
  const auto at = [&](uint32_t s, uint32_t r) { return (s % segments) * rings + r % rings; };
  for (uint32_t s = 0; s < segments; ++s) {
    for (uint32_t r = 0; r < rings; ++r) {
      AddQuad(at(s, r), at(s + 1, r), at(s + 1, r + 1), at(s, r + 1), (s + r) % 2 == 1, &mesh);
    }
  }
  return mesh;
}

Result<Mesh> MakeGrid(const Vec3& size, uint32_t along_x, uint32_t along_y) {
  if (!IsLength(size.x) || !IsLength(size.y)) return BadLength("size x and y");
  if (auto ok = CheckCount("segments along x", along_x, 1); !ok) return ok.error();
  if (auto ok = CheckCount("rings along y", along_y, 1); !ok) return ok.error();
  if (auto ok = CheckPoints(uint64_t{along_x} + 1, uint64_t{along_y} + 1); !ok) return ok.error();

  Mesh mesh;
  for (uint32_t j = 0; j <= along_y; ++j) {
    for (uint32_t i = 0; i <= along_x; ++i) {
      mesh.points.push_back({Between(-.5 * size.x, .5 * size.x, i, along_x),
                             Between(-.5 * size.y, .5 * size.y, j, along_y), 0});
    }
  }
  const auto at = [&](uint32_t i, uint32_t j) { return j * (along_x + 1) + i; };
  for (uint32_t j = 0; j < along_y; ++j) {
    for (uint32_t i = 0; i < along_x; ++i) {
      AddQuad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), (i + j) % 2 == 1, &mesh);
    }
  }
  return mesh;
}

}  // namespace fjord
