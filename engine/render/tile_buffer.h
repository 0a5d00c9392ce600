// The visibility buffer of one tile: per sample the nearest depth and which triangle it belongs to.
//
// Layout: rows of pixels, in each the samples of one pixel after those of the one before:
// [y][x][sample], so that a micro-triangle touches few cache lines and four samples are one vector.
//
// Invariants
// V1 What a sample keeps does not depend on the order of arrival: the larger depth wins, a tie
//    goes to the smaller (object, tie).
// V2 The sea is there from the start: what lies under it never gets a record.
// V3 A record is made only for a triangle that won a sample when it came; records that no sample
//    refers to any more are dropped when there are too many, so memory is bounded by the samples.
//
// Not for sharing between threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/geometry/vec.h"
#include "engine/render/samples.h"
#include "engine/render/view_plane.h"

namespace fjord {

struct TileRect {
  int32_t x = 0, y = 0, width = 0, height = 0;  // pixels

  int32_t right() const { return x + width; }
  int32_t bottom() const { return y + height; }
};

// Where the three corners of a triangle lie on the picture and in their coarse element
// (fractal/method.h), in canonical order: what shading needs to find a sample's own place there.
struct CornerPlaces {
  int32_t x[3], y[3];          // 24.8
  double weight[3];            // 1 / distance for perspective, 1 for orthographic views
  double second[3], third[3];  // weights of the element's second and third corner
  uint32_t element = 0;
};

inline constexpr uint32_t kNoHit = 0xffffffff;
inline constexpr uint32_t kNoCorners = 0xffffffff;

struct HitRecord {
  Rgb normal{0};  // facet's area vector, object space, any length; 0: faces the eye (strokes)
  uint32_t object = 0;
  uint64_t tie = 0;  // sum of the corners' identities
  uint32_t corners = kNoCorners;
};

class TileBuffer {
 public:
  // Empties it for another tile. sea: null, or what must be passed to be seen.
  void Reset(const TileRect& rect, uint32_t samples, const ViewPlane* sea);

  // Empties it for what is seen before `solid`, whose samples keep their depth and have no hits.
  void ResetBefore(const TileBuffer& solid);

  const TileRect& rect() const { return rect_; }
  std::span<const SamplePlace> places() const { return places_; }
  int32_t samples() const { return static_cast<int32_t>(places_.size()); }

  // Of the sample `s` of pixel (x, y), picture coordinates.
  size_t Index(int32_t x, int32_t y, int32_t s) const {
    return (static_cast<size_t>(y - rect_.y) * static_cast<size_t>(rect_.width) +
            static_cast<size_t>(x - rect_.x)) *
               places_.size() +
           static_cast<size_t>(s);
  }
  // Places of a row's samples, 1/256 pixel; y within the row of pixels. Padded for SIMD lanes.
  const double* sample_x() const { return sample_x_.data(); }
  const double* sample_y() const { return sample_y_.data(); }
  double* depth() { return depth_.data(); }
  const double* depth() const { return depth_.data(); }
  uint32_t* hit() { return hit_.data(); }
  const uint32_t* hit() const { return hit_.data(); }
  const HitRecord& record(uint32_t hit) const { return records_[hit]; }
  const CornerPlaces& corners(uint32_t index) const { return corners_[index]; }

  uint32_t AddRecord(const HitRecord& record) {
    records_.push_back(record);
    return static_cast<uint32_t>(records_.size() - 1);
  }
  // Room for `count` more, the first of which is number records().
  HitRecord* AddRecords(size_t count) {
    records_.resize(records_.size() + count);
    return records_.data() + (records_.size() - count);
  }
  size_t records() const { return records_.size(); }
  uint32_t AddCorners(const CornerPlaces& corners) {
    corners_.push_back(corners);
    return static_cast<uint32_t>(corners_.size() - 1);
  }

  // V1 at equal depth: does (object, tie) go before what is there?
  bool WinsTie(size_t index, uint32_t object, uint64_t tie) const {
    const uint32_t there = hit_[index];
    if (there == kNoHit) return true;
    const HitRecord& record = records_[there];
    return object != record.object ? object < record.object : tie < record.tie;
  }

  // Does every sample of pixels left..right, top..bottom that lies in the tile have something
  // nearer than `depth`? Of what lies outside it nothing is known: false where none does.
  bool Hides(int32_t left, int32_t top, int32_t right, int32_t bottom, double depth) const;

  // Call between batches: no record index may be held across it.
  void CompactIfLarge();

  size_t Bytes() const;

 private:
  // About the most records a batch adds; larger ones only cost a reallocation.
  static constexpr size_t kLargestBatch = 16384;

  void Compact();
  void LimitRecords(size_t kept);

  TileRect rect_;
  std::span<const SamplePlace> places_;
  std::vector<double> sample_x_, sample_y_;
  std::vector<double> depth_;
  std::vector<uint32_t> hit_;
  std::vector<HitRecord> records_;
  size_t record_limit_ = 0;
  std::vector<CornerPlaces> corners_;
  std::vector<uint32_t> moved_;
};

}  // namespace fjord
