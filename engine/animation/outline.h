// Arc length along a curve.
#pragma once

#include <span>
#include <vector>

#include "engine/geometry/vec.h"

namespace fjord {

// at[i]: the length from point 0 to point i; for closed curves one entry more, the whole way round.
std::vector<double> ArcLengths(std::span<const Vec3> points, bool closed);

// Where each entry of `lengths` lies between the first (0) and the last (1). Where all lengths are
// equal the entries are spread evenly.
std::vector<double> Shares(std::span<const double> lengths);

// The place at a length from point 0, going on from the start past the end of a closed curve.
Vec3 PointAtLength(std::span<const Vec3> points, std::span<const double> lengths, double length);

}  // namespace fjord
