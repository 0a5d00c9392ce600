// Records of micro-triangles that won a sample, many in lock-step. The same bits at every SIMD
// level as one by one (raster_source.h's FacetNormal).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/fractal/method.h"
#include "engine/render/coverage.h"
#include "engine/render/tile_buffer.h"

namespace fjord {

// Triangles of a block that won, by the vertices of their batch, the leading corner first.
struct MicroWinners {
  static constexpr size_t kPadding = 16;  // whole vectors are read

  uint32_t corner[3][kCoverageBlock + kPadding] = {};
  size_t count = 0;

  void Add(const Triangle& triangle, size_t lead) {
    for (size_t k = 0; k < 3; ++k)
      corner[k][count] = triangle[lead + k < 3 ? lead + k : lead + k - 3];
    ++count;
  }
  // Before MakeRecords: what is read beyond the last is the batch's first vertex.
  void Pad() {
    for (auto& column : corner) std::fill_n(&column[count], kPadding, 0u);
  }
  Triangle At(size_t i) const { return {corner[0][i], corner[1][i], corner[2][i]}; }
};

// Writes winners.count records of padded winners; none has corner values.
void MakeRecords(std::span<const StreamVertex> vertices, const MicroWinners& winners,
                 uint32_t object, HitRecord* out);

}  // namespace fjord
