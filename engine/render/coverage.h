// The SIMD half of the rasteriser: projects a batch of vertices and finds which samples its
// micro-triangles cover, many triangles in lock-step. The same bits at every SIMD level.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/fractal/method.h"
#include "engine/geometry/mesh.h"
#include "engine/render/tile_buffer.h"
#include "engine/render/view.h"

namespace fjord {

// A batch on the picture. xy holds x, y pairs; a vertex before the near plane or past the guard has
// x = kOutOfGuard.
struct ProjectedBatch {
  std::vector<int32_t> xy;
  std::vector<double> depth;

  ScreenPoint At(uint32_t vertex) const {
    return {xy[2 * vertex], xy[2 * vertex + 1], depth[vertex]};
  }
};

void ProjectVertices(const Projection& to, std::span<const StreamVertex> vertices,
                     ProjectedBatch* out);

// What micro-triangles cover. Hit i: `triangle` covers samples of the 2x2 pixels whose left upper
// one is (x, y). With n = min(4, samples): bit (2 * row + column) * n + k of the mask is sample 4 *
// group + k of that pixel; group is mask >> 16.
struct CoverageList {
  std::vector<uint32_t> triangle, mask;
  std::vector<int32_t> x, y;
  size_t hits = 0;
  std::vector<uint32_t> large;  // triangles in reach of the tile that are not that small
  size_t larges = 0;
};

// Triangles of zero area, and those that cannot touch the tile, are dropped.
void FindCoverage(std::span<const Triangle> triangles, const ProjectedBatch& batch,
                  const TileRect& tile, std::span<const SamplePlace> places, CoverageList* out);

}  // namespace fjord
