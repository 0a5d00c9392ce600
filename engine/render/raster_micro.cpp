// Micro-triangles: coverage and depths come from the SIMD kernels; here the nearest stay.
#include <algorithm>

#include "engine/render/raster.h"
#include "engine/render/raster_source.h"

namespace fjord {

uint32_t Raster::AddHit(const StreamBatch& batch, const Triangle& triangle, uint32_t lead) {
  constexpr size_t kNext[] = {0, 1, 2, 0, 1};
  const uint32_t a = triangle[lead], b = triangle[kNext[lead + 1]], c = triangle[kNext[lead + 2]];
  HitRecord record = MakeRecord(batch, a, b, c);
  if (attributes_.any()) {
    record.corners = tile_->AddCorners(
        MakeCornerValues(to_, MakeCorner(batch, a), MakeCorner(batch, b), MakeCorner(batch, c)));
  }
  return tile_->AddRecord(record);
}

void Raster::DrawBlock(const StreamBatch& batch, size_t first, size_t count) {
  const std::span<const Triangle> triangles = batch.triangles.subspan(first, count);
  FindCoverage(triangles, projected_, tile_->rect(), tile_->places(), &coverage_);
  FindDepths(triangles, projected_, &coverage_);
  std::fill_n(hit_of_.begin(), count, kNoHit);
  double* depths = tile_->depth();
  for (size_t i = 0; i < coverage_.hits; ++i) {
    const uint32_t sample = coverage_.sample[i];
    const double depth = coverage_.depth[i];
    if (!(depth >= depths[sample])) continue;
    const Triangle& triangle = triangles[coverage_.triangle[i]];
    if (depth == depths[sample]) {
      uint64_t tie = 0;
      for (const uint32_t v : triangle) tie += batch.vertices[v].id;
      if (!tile_->WinsTie(sample, object_, tie)) continue;
    }
    uint32_t& hit = hit_of_[coverage_.triangle[i]];
    if (hit == kNoHit) hit = AddHit(batch, triangle, coverage_.lead[i]);
    depths[sample] = depth;
    tile_->hit()[sample] = hit;
  }
  for (size_t i = 0; i < coverage_.larges; ++i) {
    const Triangle& triangle = triangles[coverage_.large[i]];
    bool clipped = false;
    for (const uint32_t v : triangle) clipped |= projected_.xy[2 * v] == kOutOfGuard;
    clipped ? DrawClipped(batch, triangle) : DrawWhole(batch, triangle);
  }
}

}  // namespace fjord
