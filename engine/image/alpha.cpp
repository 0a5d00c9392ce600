#include "engine/image/alpha.h"

#include <limits>

#include "engine/base/check.h"
#include "engine/base/clamp.h"

namespace fjord {
namespace {

template <typename Code>
void EncodeAlpha(std::span<const float> pixels, std::span<Code> codes) {
  FJORD_CHECK(pixels.size() == codes.size() && pixels.size() % 4 == 0, pixels.size(), codes.size());
  constexpr uint32_t kMost = std::numeric_limits<Code>::max();
  for (size_t i = 3; i < pixels.size(); i += 4) {
    codes[i] = static_cast<Code>(RoundToUint32(double{pixels[i]} * kMost, kMost));
  }
}

}  // namespace

void ToStraight(std::span<const float> associated, std::vector<float>* straight) {
  FJORD_CHECK(associated.size() % 4 == 0, associated.size());
  straight->resize(associated.size());
  for (size_t i = 0; i < associated.size(); i += 4) {
    const float alpha = associated[i + 3];
    for (size_t k = 0; k < 3; ++k) {
      (*straight)[i + k] = alpha > 0 ? associated[i + k] / alpha : 0;
    }
    (*straight)[i + 3] = alpha;
  }
}

void EncodeAlpha8(std::span<const float> pixels, std::span<uint8_t> codes) {
  EncodeAlpha(pixels, codes);
}

void EncodeAlpha16(std::span<const float> pixels, std::span<uint16_t> codes) {
  EncodeAlpha(pixels, codes);
}

}  // namespace fjord
