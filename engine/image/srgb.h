// Linear light to sRGB codes, by thresholds: code k starts where the exact encoding passes k - 1/2.
// Thresholds are made once, at first use, by exact functions; encoding then only compares.
// Thread-safe.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fjord {

// 0..255 and 0..65535. Values below 0 and -inf give 0, above 1 and +inf the largest code. No NaN.
void EncodeSrgb8(std::span<const float> linear, std::span<uint8_t> codes);
void EncodeSrgb16(std::span<const float> linear, std::span<uint16_t> codes);

// The least float of each 16-bit code.
std::vector<float> Srgb16Starts();

// What an 8-bit code stands for in linear light (thumbnails average in it).
float DecodeSrgb8(uint8_t code);
float DecodeSrgb16(uint16_t code);

}  // namespace fjord
