#include "engine/texture/uv_map.h"

#include <cmath>

#include "engine/base/exact_math.h"

namespace fjord {
namespace {

double Over(double value, double by) { return by != 0 ? value / by : 0; }

UvPoint OnBox(const Vec3& size, const Vec3& rest) {
  const Vec3 p(Over(rest.x, size.x), Over(rest.y, size.y), Over(rest.z, size.z));
  const double x = p.x < 0 ? -p.x : p.x, y = p.y < 0 ? -p.y : p.y, z = p.z < 0 ? -p.z : p.z;
  if (z >= x && z >= y) return {p.x + .5, p.y + .5, Vec3(1, 0, 0)};
  if (x >= y) return {p.y + .5, p.z + .5, Vec3(0, 1, 0)};
  return {p.x + .5, p.z + .5, Vec3(1, 0, 0)};
}

}  // namespace

UvPoint MapUv(const UvMap& map, const Vec3& rest) {
  constexpr double kTurn = 1 / (2 * exact::kPi);
  switch (map.kind) {
    case UvKind::kNone:
      return {};
    case UvKind::kPlane:
      return {Over(rest.x, map.size.x) + .5, Over(rest.y, map.size.y) + .5, Vec3(1, 0, 0)};
    case UvKind::kSphere: {
      const Vec3 p(Over(rest.x, map.size.x), Over(rest.y, map.size.y), Over(rest.z, map.size.z));
      const double level = std::sqrt(p.x * p.x + p.y * p.y);
      return {exact::Atan2(p.y, p.x) * kTurn + .5, exact::Atan2(p.z, level) * (2 * kTurn) + .5,
              Vec3(-p.y * map.size.x, p.x * map.size.y, 0)};
    }
    case UvKind::kTorus: {
      const double level = std::sqrt(rest.x * rest.x + rest.y * rest.y);
      return {exact::Atan2(rest.y, rest.x) * kTurn + .5,
              exact::Atan2(rest.z, level - map.size.x) * kTurn + .5, Vec3(-rest.y, rest.x, 0)};
    }
    case UvKind::kBox:
      return OnBox(map.size, rest);
  }
  return {};
}

}  // namespace fjord
