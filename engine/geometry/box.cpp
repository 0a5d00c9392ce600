#include <algorithm>
#include <array>
#include <iterator>

#include "engine/geometry/primitive_parts.h"
#include "engine/geometry/primitives.h"

namespace fjord {
namespace {

using Lattice = std::array<uint32_t, 3>;

// One side: corner + i * u + j * v, counter-clockwise from outside when u x v points outwards.
struct Side {
  Lattice corner;
  int u;
  int v;
};

uint64_t Key(const Lattice& at) {
  return (uint64_t{at[2]} << 42) | (uint64_t{at[1]} << 21) | uint64_t{at[0]};
}

}  // namespace

Result<Mesh> MakeBox(const Vec3& size, uint32_t along_x, uint32_t along_y) {
  using namespace primitive;  // NOLINT(google-build-using-namespace)
  if (!IsLength(size.x) || !IsLength(size.y) || !IsLength(size.z)) return BadLength("size");
  if (auto ok = CheckCount("segments along x", along_x, 1); !ok) return ok.error();
  if (auto ok = CheckCount("rings along y", along_y, 1); !ok) return ok.error();
  const uint32_t along_z = std::max(along_x, along_y);
  if (auto ok = CheckPoints(6 * (uint64_t{along_z} + 1), uint64_t{along_z} + 1); !ok) {
    return ok.error();
  }

  const Lattice n = {along_x, along_y, along_z};
  const std::array<Side, 6> sides = {{
      {{0, 0, 0}, 1, 0},     // bottom
      {{0, 0, n[2]}, 0, 1},  // top
      {{0, 0, 0}, 0, 2},     // front, -y
      {{0, n[1], 0}, 2, 0},  // back, +y
      {{0, 0, 0}, 2, 1},     // left, -x
      {{n[0], 0, 0}, 1, 2},  // right, +x
  }};
  const auto at = [](const Side& side, uint32_t i, uint32_t j) {
    Lattice place = side.corner;
    place[static_cast<size_t>(side.u)] += i;
    place[static_cast<size_t>(side.v)] += j;
    return place;
  };

  std::vector<uint64_t> keys;  // of the points, sorted: z, then y, then x
  for (const Side& side : sides) {
    for (uint32_t j = 0; j <= n[static_cast<size_t>(side.v)]; ++j) {
      for (uint32_t i = 0; i <= n[static_cast<size_t>(side.u)]; ++i) {
        keys.push_back(Key(at(side, i, j)));
      }
    }
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());

  Mesh mesh;
  for (const uint64_t key : keys) {
    Vec3 point(0);
    for (int axis = 0; axis < 3; ++axis) {
      const uint32_t step = static_cast<uint32_t>(key >> (21 * axis)) & 0x1fffff;
      point[axis] = Between(-.5 * size[axis], .5 * size[axis], step, n[static_cast<size_t>(axis)]);
    }
    mesh.points.push_back(point);
  }
  const auto number = [&](const Lattice& place) {
    const auto found = std::lower_bound(keys.begin(), keys.end(), Key(place));
    return static_cast<uint32_t>(std::distance(keys.begin(), found));
  };
  for (const Side& side : sides) {
    for (uint32_t j = 0; j < n[static_cast<size_t>(side.v)]; ++j) {
      for (uint32_t i = 0; i < n[static_cast<size_t>(side.u)]; ++i) {
        AddQuad(number(at(side, i, j)), number(at(side, i + 1, j)), number(at(side, i + 1, j + 1)),
                number(at(side, i, j + 1)), (i + j) % 2 == 1, &mesh);
      }
    }
  }
  return mesh;
}

}  // namespace fjord
