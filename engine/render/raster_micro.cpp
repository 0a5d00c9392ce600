// Micro-triangles: coverage and depths come from the SIMD kernels; here the nearest stay.
#include <algorithm>

#include "engine/render/raster.h"
#include "engine/render/raster_source.h"

namespace fjord {
namespace {

uint64_t TieOf(const StreamBatch& batch, const Triangle& triangle) {
  return batch.vertices[triangle[0]].id + batch.vertices[triangle[1]].id +
         batch.vertices[triangle[2]].id;
}

}  // namespace

void Raster::AddWinners(const StreamBatch& batch) {
  winners_.Pad();
  HitRecord* records = tile_->AddRecords(winners_.count);
  MakeRecords(batch.vertices, winners_, object_, records);
  if (keep_ != Keep::kPlaces) return;
  for (size_t i = 0; i < winners_.count; ++i) {
    const Triangle t = winners_.At(i);
    records[i].corners =
        tile_->AddCorners(MakeCornerPlaces(to_, batch.element, MakeCorner(batch, t[0]),
                                           MakeCorner(batch, t[1]), MakeCorner(batch, t[2])));
  }
}

void Raster::KeepDepths() {
  for (size_t i = 0; i < coverage_.hits; ++i) {
    double& there = tile_->depth()[coverage_.sample[i]];
    if (!(coverage_.depth[i] > there)) continue;
    there = coverage_.depth[i];
    tile_->hit()[coverage_.sample[i]] = 0;
  }
}

void Raster::KeepWinners(const StreamBatch& batch, std::span<const Triangle> triangles) {
  std::fill_n(hit_of_.begin(), triangles.size(), kNoHit);
  winners_.count = 0;
  const auto made = static_cast<uint32_t>(tile_->records());  // hits from here on: winners_
  double* depths = tile_->depth();
  uint32_t* hits = tile_->hit();
  for (size_t i = 0; i < coverage_.hits; ++i) {
    const uint32_t sample = coverage_.sample[i];
    const double depth = coverage_.depth[i];
    if (!(depth >= depths[sample])) continue;
    const Triangle& triangle = triangles[coverage_.triangle[i]];
    if (depth == depths[sample]) {
      const uint64_t tie = TieOf(batch, triangle);
      const uint32_t there = hits[sample];
      // A winner's record is not made yet.
      const bool wins = there != kNoHit && there >= made
                            ? tie < TieOf(batch, winners_.At(there - made))
                            : tile_->WinsTie(sample, object_, tie);
      if (!wins) continue;
    }
    uint32_t& hit = hit_of_[coverage_.triangle[i]];
    if (hit == kNoHit) {
      hit = made + static_cast<uint32_t>(winners_.count);
      winners_.Add(triangle, coverage_.lead[i]);
    }
    depths[sample] = depth;
    hits[sample] = hit;
  }
  AddWinners(batch);
}

void Raster::DrawBlock(const StreamBatch& batch, size_t first, size_t count) {
  const std::span<const Triangle> triangles = batch.triangles.subspan(first, count);
  FindCoverage(triangles, projected_, tile_->rect(), tile_->places(), &coverage_);
  FindDepths(triangles, projected_, tile_->rect(), tile_->places(), tile_->depth(), &coverage_);
  if (keep_ == Keep::kDepth) {
    KeepDepths();
  } else {
    KeepWinners(batch, triangles);
  }
  for (size_t i = 0; i < coverage_.larges; ++i) {
    const Triangle& triangle = triangles[coverage_.large[i]];
    bool clipped = false;
    for (const uint32_t v : triangle) clipped |= projected_.xy[2 * v] == kOutOfGuard;
    clipped ? DrawClipped(batch, triangle) : DrawWhole(batch, triangle);
  }
}

}  // namespace fjord
