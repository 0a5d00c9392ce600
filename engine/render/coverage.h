// The SIMD half of the rasteriser: projects a batch of vertices, finds which samples its
// micro-triangles cover and how near they are there, many triangles in lock-step. The same bits at
// every SIMD level.
//
// A sample's places repeat every pixel, so a triangle less than a pixel wide and high can cover the
// i-th sample of one pixel at most: there is one place a sample to look at, not one a pixel.
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

// How many triangles FindCoverage takes at a time.
inline constexpr size_t kCoverageBlock = 256;

// A sample that a micro-triangle of a block covers, in a word: the number of the triangle, then the
// number of the sample in its pixel and its place there, then whether it lies in the first or
// second column and row of such samples from the corner of the triangle's box on. Where that is
// follows from the triangle, so the loop that looks for samples writes one word only.
struct HitCode {
  static constexpr uint32_t kTriangle = 0xff;
  static constexpr int kSample = 8, kX = 12, kY = 20, kColumn = 28, kRow = 29;
};

// What micro-triangles cover. Hit i: triangles[triangle] covers entry `sample` of the tile buffer,
// at `depth`; its corner `lead` leads.
struct CoverageList {
  std::vector<uint32_t> code;  // HitCode
  std::vector<uint32_t> triangle, sample, lead;
  std::vector<double> depth;
  size_t hits = 0;
  std::vector<uint32_t> large;  // triangles in reach of the tile of two pixels or more
  size_t larges = 0;
  std::vector<uint32_t> wide;  // of one to two pixels; while covering

  size_t Bytes() const {
    return triangle.capacity() * (4 * sizeof(uint32_t) + sizeof(double)) +
           (large.capacity() + wide.capacity()) * sizeof(uint32_t);
  }
};

// Finds hits, as codes. Triangles of zero area, and those that cannot touch the tile, are dropped.
void FindCoverage(std::span<const Triangle> triangles, const ProjectedBatch& batch,
                  const TileRect& tile, std::span<const SamplePlace> places, CoverageList* out);

// Fills in the rest of the hits (depths: triangle_setup.h's DepthPlane, bit for bit). `nearest`:
// the depths of the tile, which are fetched on the way.
void FindDepths(std::span<const Triangle> triangles, const ProjectedBatch& batch,
                const TileRect& tile, std::span<const SamplePlace> places, const double* nearest,
                CoverageList* hits);

}  // namespace fjord
