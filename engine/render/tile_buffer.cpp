#include "engine/render/tile_buffer.h"

#include <algorithm>
#include <limits>

namespace fjord {

void TileBuffer::Reset(const TileRect& rect, uint32_t samples) {
  rect_ = rect;
  places_ = SamplePlaces(samples);
  const size_t count =
      static_cast<size_t>(rect.width) * static_cast<size_t>(rect.height) * places_.size();
  constexpr size_t kPadding = 8;  // SIMD lanes may read past the end
  depth_.assign(count + kPadding, -std::numeric_limits<double>::infinity());
  hit_.assign(count + kPadding, kNoHit);
  records_.clear();
  corners_.clear();
  record_limit_ = std::max<size_t>(count + count / 2, 4096);
  records_.reserve(record_limit_ + kLargestBatch);
}

void TileBuffer::CompactIfLarge() {
  // No more records can stay than there are samples, so at least a third of the limit goes each
  // time: compaction costs a constant per record on average.
  if (records_.size() > record_limit_) Compact();
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
