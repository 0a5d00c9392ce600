// A height field made ready to stream: right triangles over its samples, halved by the templates of
// S21, so that fine parts meet coarse ones without a crack. Nothing of it is stored but the
// samples; what lies outside a picture is passed over by their ranges.
//
// Invariants
// H1 An edge is halved where the sample midway exists, and by what its own two ends say: by their
//    rest pose (HeightField::size of it) and Fineness as in frame.proto. With no fineness: wherever
//    it exists.
// H2 A vertex is a sample: its place and identity follow from its index alone.
// H3 The field is cut into squares of 2^k cells, 16 or more along a side. Where these do not go in
//    evenly both ways, every sample is drawn, and what of the last squares lies beyond the border
//    is drawn together onto it; triangles that so lose all their area are left out.
#pragma once

#include <memory>

#include "engine/fractal/method.h"

namespace fjord {

// `rest_size`: size of the field in the rest pose. kLimit where it has 2^31 samples or more.
Result<std::unique_ptr<PreparedFractal>> PrepareHeights(const HeightField& field,
                                                        const Vec3& rest_size,
                                                        const Fineness& fineness, uint64_t seed);

}  // namespace fjord
