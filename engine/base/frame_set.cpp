#include "engine/base/frame_set.h"

#include <algorithm>
#include <charconv>

namespace fjord {
namespace {

constexpr std::string_view kHow = "write frames as 7, 1-48, 1-10,12 or 20-40x2";

// One piece of a list: "7", "1-48", "20-40x2", and where it stands.
class Piece {
 public:
  Piece(std::string_view list, size_t begin, size_t end)
      : list_(list), begin_(begin), end_(end), at_(begin) {}

  Result<FrameSpan> Read() {
    FrameSpan span;
    if (begin_ == end_) return Wrong(begin_, "a frame is missing");
    if (Result<> read = Number("a frame", &span.first); !read.ok()) return read.error();
    span.last = span.first;
    if (at_ == end_) return span;
    if (!Take('-')) return Wrong(at_, Quoted() + " is no frame");
    if (Result<> read = Number("the last frame", &span.last); !read.ok()) return read.error();
    if (span.last < span.first) return Wrong(begin_, Quoted() + " runs backwards");
    if (at_ < end_) {
      if (!Take('x')) return Wrong(at_, Quoted() + " is no range");
      if (Result<> read = Number("the step", &span.step); !read.ok()) return read.error();
      if (at_ < end_) return Wrong(at_, Quoted() + " is no range");
    }
    span.last = span.first + (span.count() - 1) * span.step;
    return span;
  }

 private:
  bool Take(char wanted) {
    if (at_ == end_ || list_[at_] != wanted) return false;
    ++at_;
    return true;
  }
  std::string Quoted() const {
    std::string quoted = "\"";
    quoted.append(list_.substr(begin_, end_ - begin_)).append("\"");
    return quoted;
  }
  Error Wrong(size_t at, const std::string& what) const {
    return MakeError(ErrorCode::kUsage, std::string(list_) + ": character " +
                                            std::to_string(at + 1) + ": " + what + "; " +
                                            std::string(kHow));
  }
  Result<> Number(const std::string& what, uint32_t* number) {
    const char* const begin = list_.data() + at_;
    const auto [stopped, error] = std::from_chars(begin, list_.data() + end_, *number);
    if (stopped == begin) return Wrong(at_, what + " is missing in " + Quoted());
    if (error != std::errc() || *number == 0 || *number > FrameSet::kMostNumber) {
      return Wrong(at_, what + " is outside 1-" + std::to_string(FrameSet::kMostNumber));
    }
    at_ = static_cast<size_t>(stopped - list_.data());
    return Ok{};
  }

  const std::string_view list_;
  const size_t begin_;
  const size_t end_;
  size_t at_;
};

void Mark(const FrameSpan& span, std::vector<bool>* there) {
  if (span.step == 1) {
    std::fill(there->begin() + span.first, there->begin() + span.last + 1, true);
    return;
  }
  for (uint32_t number = span.first; number <= span.last; number += span.step) {
    (*there)[number] = true;
  }
}

std::vector<uint32_t> Marked(const std::vector<bool>& there) {
  std::vector<uint32_t> numbers;
  for (uint32_t number = 1; number < there.size(); ++number) {
    if (there[number]) numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

FrameSet::FrameSet(uint32_t first, uint32_t last) { Add({first, last, 1}); }

void FrameSet::Add(FrameSpan span) {
  begins_.push_back(size());
  spans_.push_back(span);
}

Result<FrameSet> FrameSet::Parse(std::string_view text) {
  std::vector<bool> there(size_t{kMostNumber} + 1);
  for (size_t begin = 0; begin <= text.size();) {
    while (begin < text.size() && text[begin] == ' ') ++begin;
    size_t end = std::min(text.find(',', begin), text.size());
    const size_t next = end + 1;
    while (end > begin && text[end - 1] == ' ') --end;
    const Result<FrameSpan> span = Piece(text, begin, end).Read();
    if (!span.ok()) return span.error();
    Mark(*span, &there);
    begin = next;
  }
  return Of(Marked(there));
}

FrameSet FrameSet::Of(const std::vector<uint32_t>& unordered) {
  std::vector<uint32_t> numbers = unordered;
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  FrameSet set;
  for (size_t i = 0; i < numbers.size();) {
    size_t end = i + 1;  // the longest run of one step from here
    const uint32_t step = end < numbers.size() ? numbers[end] - numbers[i] : 1;
    while (end < numbers.size() && numbers[end] - numbers[end - 1] == step) ++end;
    // Two frames that are not neighbours are no pattern; the second may begin one.
    if (end - i == 2 && step > 1) end = i + 1;
    set.Add({numbers[i], numbers[end - 1], end - i == 1 ? 1 : step});
    i = end;
  }
  return set;
}

std::optional<FrameSet> FrameSet::FromSpans(std::span<const FrameSpan> spans) {
  FrameSet set;
  for (const FrameSpan& span : spans) {
    const uint32_t behind = set.empty() ? 0 : set.last();
    if (span.step == 0 || span.first <= behind || span.last < span.first ||
        span.last > kMostNumber || (span.last - span.first) % span.step != 0) {
      return std::nullopt;
    }
    set.Add(span);
  }
  return set;
}

uint32_t FrameSet::operator[](uint32_t index) const {
  FJORD_CHECK(index < size(), index, size());
  const auto behind = std::upper_bound(begins_.begin(), begins_.end(), index);
  const auto place = static_cast<size_t>(behind - begins_.begin()) - 1;
  return spans_[place].first + (index - begins_[place]) * spans_[place].step;
}

std::optional<uint32_t> FrameSet::IndexOf(uint32_t number) const {
  const uint32_t index = IndexFrom(number);
  if (index == size() || (*this)[index] != number) return std::nullopt;
  return index;
}

uint32_t FrameSet::IndexFrom(uint32_t number) const {
  const auto span = std::lower_bound(spans_.begin(), spans_.end(), number,
                                     [](const FrameSpan& a, uint32_t b) { return a.last < b; });
  if (span == spans_.end()) return size();
  const uint32_t begin = begins_[static_cast<size_t>(span - spans_.begin())];
  if (number <= span->first) return begin;
  return begin + (number - span->first + span->step - 1) / span->step;
}

std::string FrameSet::ToString(size_t most) const {
  std::string text;
  for (size_t i = 0; i < spans_.size(); ++i) {
    if (i == most) return text + " ...";
    const FrameSpan& span = spans_[i];
    if (i > 0) text += ',';
    text += std::to_string(span.first);
    if (span.last == span.first) continue;
    text += '-' + std::to_string(span.last);
    if (span.step > 1) text += 'x' + std::to_string(span.step);
  }
  return text;
}

}  // namespace fjord
