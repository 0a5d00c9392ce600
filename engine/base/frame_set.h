// A set of frame numbers, as people write it ("1-10,12,20-40x2") and as messages and the journal
// carry it: spans in rising order. A million frames in steps are one span.
//
// F1 Spans do not overlap: each begins behind the end of the one before it.
// F2 Equal sets have equal spans, however they were written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace fjord {

struct FrameSpan {
  uint32_t first = 0;
  uint32_t last = 0;  // is itself a frame of the span
  uint32_t step = 1;

  uint32_t count() const { return (last - first) / step + 1; }
  friend bool operator==(const FrameSpan&, const FrameSpan&) = default;
};

class FrameSet {
 public:
  static constexpr uint32_t kMostNumber = 1'000'000;
  static constexpr size_t kMostSpans = 10'000;  // of one job

  FrameSet() = default;  // no frame
  FrameSet(uint32_t first, uint32_t last);

  // Frames count from 1; what is named twice is there once. kUsage with the column otherwise.
  static Result<FrameSet> Parse(std::string_view text);
  // In any order, doubled or not; each from 1 to kMostNumber.
  static FrameSet Of(const std::vector<uint32_t>& numbers);
  // None: not the spans of a set (F1), or a number out of bounds.
  static std::optional<FrameSet> FromSpans(std::span<const FrameSpan> spans);

  bool empty() const { return spans_.empty(); }
  uint32_t size() const { return begins_.empty() ? 0 : begins_.back() + spans_.back().count(); }
  // Of a set that is not empty.
  uint32_t first() const { return spans_.front().first; }
  uint32_t last() const { return spans_.back().last; }
  // The frame at a place from 0 to size() - 1.
  uint32_t operator[](uint32_t index) const;
  std::optional<uint32_t> IndexOf(uint32_t number) const;
  bool Contains(uint32_t number) const { return IndexOf(number).has_value(); }
  // The place of the first frame from `number` on; size() where there is none.
  uint32_t IndexFrom(uint32_t number) const;

  const std::vector<FrameSpan>& spans() const { return spans_; }
  // "1-10,12,20-40x2"; beyond `most` spans " ..." stands for the rest.
  std::string ToString(size_t most = kMostSpans) const;

  friend bool operator==(const FrameSet& a, const FrameSet& b) { return a.spans_ == b.spans_; }

 private:
  void Add(FrameSpan span);

  std::vector<FrameSpan> spans_;
  std::vector<uint32_t> begins_;  // the place of each span's first frame
};

}  // namespace fjord
