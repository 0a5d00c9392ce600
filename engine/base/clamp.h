// The only places where a floating value becomes an integer (D1), or a large one a float. Out of
// range saturates, NaN gives 0: a plain cast would be undefined there, and differ between
// processors.
#pragma once

#include <cstdint>
#include <limits>

namespace fjord {

// Towards zero.
constexpr int64_t ClampToInt64(double x) {
  if (x >= 9223372036854775808.0) return std::numeric_limits<int64_t>::max();
  if (x <= -9223372036854775808.0) return std::numeric_limits<int64_t>::min();
  return x == x ? static_cast<int64_t>(x) : 0;
}

constexpr int32_t ClampToInt32(double x) {
  if (x >= 2147483647.0) return std::numeric_limits<int32_t>::max();
  if (x <= -2147483648.0) return std::numeric_limits<int32_t>::min();
  return x == x ? static_cast<int32_t>(x) : 0;
}

// To the nearest float.
constexpr float ClampToFloat(double x) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  if (x >= kLargest) return std::numeric_limits<float>::max();
  if (x <= -kLargest) return -std::numeric_limits<float>::max();
  return x == x ? static_cast<float>(x) : 0;
}

// Towards minus infinity.
constexpr int64_t FloorToInt64(double x) {
  const int64_t whole = ClampToInt64(x);
  const bool above = static_cast<double>(whole) > x;
  return above && whole > std::numeric_limits<int64_t>::min() ? whole - 1 : whole;
}

constexpr int32_t FloorToInt32(double x) {
  const int32_t whole = ClampToInt32(x);
  const bool above = static_cast<double>(whole) > x;
  return above && whole > std::numeric_limits<int32_t>::min() ? whole - 1 : whole;
}

// To the nearest; a half goes up.
constexpr int32_t RoundToInt32(double x) {
  const int32_t below = FloorToInt32(x);
  const bool up = x - static_cast<double>(below) >= .5;
  return up && below < std::numeric_limits<int32_t>::max() ? below + 1 : below;
}

constexpr int64_t RoundToInt64(double x) {
  const int64_t below = FloorToInt64(x);
  const bool up = x - static_cast<double>(below) >= .5;
  return up && below < std::numeric_limits<int64_t>::max() ? below + 1 : below;
}

// 0..most, to the nearest: quantising a sample.
constexpr uint32_t RoundToUint32(double x, uint32_t most) {
  const int64_t whole = RoundToInt64(x);
  if (whole <= 0) return 0;
  return whole >= int64_t{most} ? most : static_cast<uint32_t>(whole);
}

// The largest whole number <= x, as a double: std::floor may be a libm call.
constexpr double Floor(double x) {
  const bool has_fraction = x > -4503599627370496.0 && x < 4503599627370496.0;
  return has_fraction ? static_cast<double>(FloorToInt64(x)) : x;
}

}  // namespace fjord
