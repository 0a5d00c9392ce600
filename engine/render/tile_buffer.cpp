#include "engine/render/tile_buffer.h"

#include <algorithm>
#include <limits>

namespace fjord {

void TileBuffer::Reset(const TileRect& rect, uint32_t samples, const ViewPlane* sea) {
  rect_ = rect;
  places_ = SamplePlaces(samples);
  const size_t row = static_cast<size_t>(rect.width) * places_.size();
  const size_t count = row * static_cast<size_t>(rect.height);
  constexpr size_t kPadding = 64;  // SIMD lanes may read past the end
  sample_x_.resize(row + kPadding);
  sample_y_.resize(row + kPadding);
  for (size_t at = 0; at < row; ++at) {
    const int32_t pixel = rect.x + static_cast<int32_t>(at / places_.size());
    const SamplePlace& place = places_[at % places_.size()];
    sample_x_[at] = static_cast<double>(pixel * kFixedOne + place.x);
    sample_y_[at] = static_cast<double>(place.y);
  }
  depth_.resize(count + kPadding);
  if (sea == nullptr) {
    std::fill_n(depth_.begin(), count, -std::numeric_limits<double>::infinity());
  } else {
    for (int32_t y = 0; y < rect.height; ++y) {
      LayPlane(*sea, sample_x_.data(), sample_y_.data(),
               static_cast<double>((rect.y + y) * kFixedOne), row,
               depth_.data() + static_cast<size_t>(y) * row);
    }
  }
  hit_.assign(count + kPadding, kNoHit);
  records_.clear();
  corners_.clear();
  LimitRecords(0);
}

void TileBuffer::ResetBefore(const TileBuffer& solid) {
  rect_ = solid.rect_;
  places_ = solid.places_;
  sample_x_ = solid.sample_x_;
  sample_y_ = solid.sample_y_;
  depth_ = solid.depth_;
  hit_.assign(solid.hit_.size(), kNoHit);
  records_.clear();
  corners_.clear();
  LimitRecords(0);
}

bool TileBuffer::Hides(int32_t left, int32_t top, int32_t right, int32_t bottom,
                       double depth) const {
  left = std::max(left, rect_.x);
  right = std::min(right, rect_.right() - 1);
  top = std::max(top, rect_.y);
  bottom = std::min(bottom, rect_.bottom() - 1);
  if (left > right || top > bottom) return false;
  for (int32_t y = top; y <= bottom; ++y) {
    const double* there = depth_.data() + Index(left, y, 0);
    const double* end = there + static_cast<size_t>(right - left + 1) * places_.size();
    for (; there != end; ++there) {
      if (!(*there > depth)) return false;
    }
  }
  return true;
}

// No more can stay than there are samples, and half as many are made from one compaction to the
// next: it costs a constant per record on average.
void TileBuffer::LimitRecords(size_t kept) {
  const size_t samples = hit_.size();
  record_limit_ = std::max({samples, kept + samples / 2, size_t{4096}});
  records_.reserve(record_limit_ + kLargestBatch);
}

void TileBuffer::CompactIfLarge() {
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
  LimitRecords(kept);
  corners_.resize(kept_corners);
  for (uint32_t& hit : hit_) {
    if (hit != kNoHit) hit = moved_[hit];
  }
}

size_t TileBuffer::Bytes() const {
  return depth_.capacity() * sizeof(double) + hit_.capacity() * sizeof(uint32_t) +
         records_.capacity() * sizeof(HitRecord) + corners_.capacity() * sizeof(CornerPlaces) +
         moved_.capacity() * sizeof(uint32_t) + 2 * sample_x_.capacity() * sizeof(double);
}

}  // namespace fjord
