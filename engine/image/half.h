// IEEE binary16, by integer operations only: the same bits on every machine.
#pragma once

#include <bit>
#include <cstdint>

namespace fjord {

// Rounded to nearest even; too large gives infinity, NaN a quiet NaN.
constexpr uint16_t FloatToHalf(float value) {
  const uint32_t bits = std::bit_cast<uint32_t>(value);
  const uint32_t sign = (bits >> 16) & 0x8000u;
  const uint32_t magnitude = bits & 0x7fffffffu;
  if (magnitude > 0x7f800000u) return static_cast<uint16_t>(sign | 0x7e00u);
  if (magnitude >= 0x477ff000u) return static_cast<uint16_t>(sign | 0x7c00u);
  uint32_t shift = 13;
  uint32_t mantissa = magnitude;
  uint32_t base = 0;
  if (magnitude >= 0x38800000u) {  // normal
    base = 0u - (112u << 10);
  } else {  // the result is denormal: 2^-24 is its unit
    const uint32_t exponent = magnitude >> 23;
    if (exponent < 102) return static_cast<uint16_t>(sign);
    shift = 126 - exponent;
    mantissa = (magnitude & 0x7fffffu) | 0x800000u;
  }
  const uint32_t whole = mantissa >> shift;
  const uint32_t rest = mantissa & ((1u << shift) - 1);
  const uint32_t middle = 1u << (shift - 1);
  const uint32_t up = rest > middle || (rest == middle && (whole & 1)) ? 1 : 0;
  return static_cast<uint16_t>(sign | (base + whole + up));
}

constexpr float HalfToFloat(uint16_t half) {
  const uint32_t sign = (half & 0x8000u) << 16;
  const uint32_t exponent = (half >> 10) & 31u;
  uint32_t mantissa = half & 0x3ffu;
  if (exponent == 31) return std::bit_cast<float>(sign | 0x7f800000u | (mantissa << 13));
  if (exponent != 0)
    return std::bit_cast<float>(sign | ((exponent + 112) << 23) | (mantissa << 13));
  const float magnitude = static_cast<float>(mantissa) * 0x1p-24f;
  return sign ? -magnitude : magnitude;
}

}  // namespace fjord
