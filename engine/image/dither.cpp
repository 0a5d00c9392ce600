#include "engine/image/dither.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "engine/base/check.h"
#include "engine/image/srgb.h"

namespace fjord {
namespace {

constexpr uint32_t kOffsets = 16;
constexpr uint32_t kBrick = 64;  // pixels that share an offset along a row
constexpr uint32_t kStep = 257;  // 16-bit codes an 8-bit code

constexpr uint32_t Reversed(uint32_t four_bits) {
  return (four_bits & 1) << 3 | (four_bits & 2) << 1 | (four_bits & 4) >> 1 | (four_bits & 8) >> 3;
}
constexpr uint32_t OffsetOf(uint32_t number) { return 8 + 16 * Reversed(number); }

// How far the bricks of a row are pushed: odd times the row, so that no two rows of a brick's width
// part at the same places.
constexpr uint32_t PushOf(uint32_t y) { return y * 37 % kBrick; }
constexpr uint32_t NumberOf(uint32_t brick, uint32_t y, uint32_t channel) {
  return (y + 5 * (brick + channel)) % kOffsets;
}

// For each offset, from which float on an 8-bit code is reached; and where to begin, by a float's
// exponent and the leading bits of its mantissa: a code spans more floats than an entry of that
// table, so there is at most one step within an entry.
class Steps {
 public:
  Steps() {
    const std::vector<float> starts = Srgb16Starts();
    for (uint32_t number = 0; number < kOffsets; ++number) {
      for (uint32_t code = 1; code < 256; ++code) {
        from_[number][code] = starts[kStep * code - OffsetOf(number)];
      }
      from_[number][256] = 2;
    }
    const uint32_t entries = ((std::bit_cast<uint32_t>(1.f) - kFirstBits) >> kShift) + 1;
    std::vector<float> lowest(entries);
    for (uint32_t entry = 0; entry < entries; ++entry) {
      lowest[entry] = std::bit_cast<float>(kFirstBits + (entry << kShift));
    }
    code16_.resize(entries);
    EncodeSrgb16(lowest, code16_);
  }

  uint8_t Encode(float linear, uint32_t number) const {
    if (!(linear > 0)) {
      FJORD_CHECK(linear == linear, "a NaN reached the picture");
      return 0;
    }
    if (linear >= 1) return 255;
    const uint32_t bits = std::bit_cast<uint32_t>(linear);
    uint32_t code = 0;
    if (bits >= kFirstBits) {
      code = (code16_[(bits - kFirstBits) >> kShift] + OffsetOf(number)) / kStep;
    }
    return static_cast<uint8_t>(code + (linear >= from_[number][code + 1] ? 1 : 0));
  }

 private:
  static constexpr uint32_t kShift = 15;
  static constexpr uint32_t kFirstBits = 0x39000000;  // 2^-13, less than the first step

  std::array<std::array<float, 257>, kOffsets> from_{};
  std::vector<uint16_t> code16_;
};

}  // namespace

uint32_t DitherOffset(uint32_t x, uint32_t y, uint32_t channel) {
  return OffsetOf(NumberOf((x + PushOf(y)) / kBrick, y, channel));
}

void EncodeDithered8(uint32_t x, uint32_t y, std::span<const float> linear,
                     std::span<uint8_t> codes, uint32_t channels) {
  static const Steps kSteps;
  FJORD_CHECK(linear.size() == codes.size() && linear.size() % channels == 0, linear.size(),
              codes.size());
  const uint32_t pixels = static_cast<uint32_t>(linear.size() / channels);
  for (uint32_t i = 0; i < pixels;) {
    const uint32_t place = x + i + PushOf(y);
    const uint32_t end = std::min(pixels, i + kBrick - place % kBrick);
    for (uint32_t channel = 0; channel < 3; ++channel) {
      const uint32_t number = NumberOf(place / kBrick, y, channel);
      for (uint32_t at = channels * i + channel; at < channels * end; at += channels) {
        codes[at] = kSteps.Encode(linear[at], number);
      }
    }
    i = end;
  }
}

}  // namespace fjord
