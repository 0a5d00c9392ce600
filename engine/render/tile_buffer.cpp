#include "engine/render/tile_buffer.h"

#include <algorithm>
#include <limits>

namespace fjord {

void TileBuffer::Reset(const TileRect& rect, uint32_t samples) {
  rect_ = rect;
  places_ = SamplePlaces(samples);
  const size_t count =
      static_cast<size_t>(rect.width) * static_cast<size_t>(rect.height) * places_.size();
  depth_.assign(count, -std::numeric_limits<double>::infinity());
  hit_.assign(count, kNoHit);
  records_.clear();
  corners_.clear();
}

void TileBuffer::CompactIfLarge() {
  // At least as many records go as stay, so compaction costs a constant per record on average.
  if (records_.size() > std::max<size_t>(2 * hit_.size(), 4096)) Compact();
}

void TileBuffer::Compact() {
  moved_.assign(records_.size(), kNoHit);
  for (const uint32_t hit : hit_) {
    if (hit != kNoHit) moved_[hit] = 0;
  }
  uint32_t kept = 0;
  uint32_t kept_corners = 0;
  for (size_t i = 0; i < records_.size(); ++i) {
    if (moved_[i] == kNoHit) continue;
    HitRecord record = records_[i];
    if (record.corners != kNoCorners) {  // corners stand in the order of their records
      corners_[kept_corners] = corners_[record.corners];
      record.corners = kept_corners++;
    }
    records_[kept] = record;
    moved_[i] = kept++;
  }
  records_.resize(kept);
  corners_.resize(kept_corners);
  for (uint32_t& hit : hit_) {
    if (hit != kNoHit) hit = moved_[hit];
  }
}

size_t TileBuffer::Bytes() const {
  return depth_.capacity() * sizeof(double) + hit_.capacity() * sizeof(uint32_t) +
         records_.capacity() * sizeof(HitRecord) + corners_.capacity() * sizeof(CornerValues) +
         moved_.capacity() * sizeof(uint32_t);
}

}  // namespace fjord
