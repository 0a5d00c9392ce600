#include "engine/base/random.h"

#include <cmath>

#include "engine/base/check.h"

namespace fjord {

double GaussianScale(int n) {
  FJORD_CHECK(n >= 1 && n <= kMaxUniforms, n);
  // A 16-bit uniform has variance (2^32 - 1) / 12; twice the sum of n has four times n of it.
  return std::sqrt(3.0 / (static_cast<double>(n) * 4294967295.0));
}

double GaussianBound(int n) { return GaussianScale(n) * (static_cast<double>(n) * 65535.0); }

double Gaussian(uint64_t lo, int n) {
  const double scale = GaussianScale(n);
  int32_t sum = 0;
  uint64_t bits = 0;
  for (int i = 0; i < n; ++i) {
    if (i % 4 == 0) bits = DrawBits(lo, static_cast<uint64_t>(i / 4));
    sum += static_cast<int32_t>(bits & 0xffff);
    bits >>= 16;
  }
  return static_cast<double>(2 * sum - n * 65535) * scale;
}

double TangentDraw(uint64_t lo) {
  const uint64_t bits = DrawBits(lo, 7);
  const int32_t sum = static_cast<int32_t>(bits & 0xffff) +
                      static_cast<int32_t>((bits >> 16) & 0xffff) +
                      static_cast<int32_t>((bits >> 32) & 0xffff);
  return static_cast<double>(2 * sum - 3 * 65535) / (6.0 * 65535.0);
}

}  // namespace fjord
