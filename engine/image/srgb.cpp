#include "engine/image/srgb.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "engine/base/check.h"
#include "engine/base/exact_math.h"

namespace fjord {
namespace {

// IEC 61966-2-1, encoded 0..1 to linear.
double SrgbToLinear(double encoded) {
  return encoded <= .04045 ? encoded / 12.92 : exact::Pow((encoded + .055) / 1.055, 2.4);
}

// Where each code starts. The last is never reached by a search.
template <typename Code>
std::vector<float> Starts() {
  constexpr uint32_t kCodes = 1u << (8 * sizeof(Code));
  std::vector<float> starts(kCodes + 1);
  for (uint32_t k = 1; k < kCodes; ++k) {
    starts[k] = static_cast<float>(SrgbToLinear((k - .5) / (kCodes - 1)));
  }
  starts[kCodes] = 2;
  return starts;
}

// Floats between kFirst and 1 are looked up by exponent and the leading bits of the mantissa; below
// kFirst every code is searched for. Codes of one entry of the table lie close together.
template <typename Code>
class Thresholds {
 public:
  Thresholds() : thresholds_(Starts<Code>()) {
    const uint32_t entries = ((std::bit_cast<uint32_t>(1.f) - kFirstBits) >> kShift) + 1;
    for (uint32_t entry = 0; entry < entries; ++entry) {
      const float lowest = std::bit_cast<float>(kFirstBits + (entry << kShift));
      start_.push_back(static_cast<Code>(Search(lowest, 0, kCodes)));
    }
    start_.push_back(kCodes - 1);
  }

  Code Encode(float linear) const {
    if (!(linear > 0)) {
      FJORD_CHECK(linear == linear, "a NaN reached the picture");
      return 0;
    }
    if (linear >= 1) return kCodes - 1;
    const uint32_t bits = std::bit_cast<uint32_t>(linear);
    if (bits < kFirstBits) return static_cast<Code>(Search(linear, 0, start_[0] + 1u));
    const uint32_t entry = (bits - kFirstBits) >> kShift;
    uint32_t code = start_[entry];
    if constexpr (kCodes == 256) {
      // never more than one threshold within an entry (checked by a test)
      return static_cast<Code>(code + (linear >= thresholds_[code + 1] ? 1 : 0));
    } else {
      return static_cast<Code>(Search(linear, code, start_[entry + 1] + 1u));
    }
  }

 private:
  static constexpr uint32_t kCodes = 1u << (8 * sizeof(Code));
  static constexpr uint32_t kShift = 15;
  static constexpr uint32_t kFirstBits = 0x39000000;  // 2^-13

  // The last k in first..last-1 with thresholds_[k] <= linear.
  uint32_t Search(float linear, uint32_t first, uint32_t last) const {
    const auto end = thresholds_.begin() + last;
    return static_cast<uint32_t>(std::upper_bound(thresholds_.begin() + first, end, linear) -
                                 thresholds_.begin()) -
           1;
  }

  std::vector<float> thresholds_;
  std::vector<Code> start_;
};

template <typename Code>
void EncodeAll(std::span<const float> linear, std::span<Code> codes) {
  static const Thresholds<Code> kThresholds;
  FJORD_CHECK(linear.size() == codes.size(), linear.size(), codes.size());
  for (size_t i = 0; i < linear.size(); ++i) codes[i] = kThresholds.Encode(linear[i]);
}

template <typename Code>
std::vector<float> DecodeTable() {
  constexpr uint32_t kCodes = 1u << (8 * sizeof(Code));
  std::vector<float> table(kCodes);
  for (uint32_t k = 0; k < kCodes; ++k) {
    table[k] = static_cast<float>(SrgbToLinear(k / (kCodes - 1.)));
  }
  return table;
}

}  // namespace

void EncodeSrgb8(std::span<const float> linear, std::span<uint8_t> codes) {
  EncodeAll(linear, codes);
}

void EncodeSrgb16(std::span<const float> linear, std::span<uint16_t> codes) {
  EncodeAll(linear, codes);
}

std::vector<float> Srgb16Starts() { return Starts<uint16_t>(); }

float DecodeSrgb8(uint8_t code) {
  static const std::vector<float> kTable = DecodeTable<uint8_t>();
  return kTable[code];
}

float DecodeSrgb16(uint16_t code) {
  static const std::vector<float> kTable = DecodeTable<uint16_t>();
  return kTable[code];
}

}  // namespace fjord
