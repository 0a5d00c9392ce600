// Which axis of a file points up. In scenes that is z.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/geometry/vec.h"

namespace fjord {

enum class UpAxis : uint32_t { kZ, kY, kX };

// The axis becomes z by a quarter turn, so that nothing is mirrored.
inline void TurnUp(UpAxis up, std::vector<Vec3>* points) {
  if (up == UpAxis::kZ) return;
  for (Vec3& p : *points) p = up == UpAxis::kY ? Vec3(p.x, 0 - p.z, p.y) : Vec3(0 - p.z, p.y, p.x);
}

}  // namespace fjord
