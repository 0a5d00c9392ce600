// Value noise: a smooth random function of space. Keyed: a pure function of place and seed (D1).
#pragma once

#include <cstdint>

#include "engine/geometry/vec.h"

namespace fjord {

// -1..1; twice differentiable; the lattice has unit width. Places beyond 2^52 give one value.
double ValueNoise(const Vec3& place, uint64_t seed);

// The sum of `octaves` noises, each of half the width and `gain` times the height of the one
// before, over the sum of the heights: -1..1.
double NoiseSum(const Vec3& place, uint64_t seed, uint32_t octaves, double gain);

}  // namespace fjord
