#pragma once

#include <cstdint>

namespace fjord {

// a / b towards minus infinity; b > 0.
inline int64_t FloorDivide(int64_t a, int64_t b) {
  const int64_t q = a / b;
  return a % b < 0 ? q - 1 : q;
}

}  // namespace fjord
