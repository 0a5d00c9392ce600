// A shape as it is, for objects without a fractal: the same interface, no midpoint. A root is a run
// of consecutive triangles or segments. Identities are CoarseIdentity(seed, number).
#pragma once

#include <memory>

#include "engine/fractal/method.h"

namespace fjord {

// Meshes and curves. kInvalid where the shape's arrays do not fit together.
Result<std::unique_ptr<PreparedFractal>> PreparePlain(CoarseShape shape, uint64_t seed);

}  // namespace fjord
