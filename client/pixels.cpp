#include "client/pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

namespace fjord {
namespace {

float LinearOfSrgb(double encoded) {
  return static_cast<float>(encoded <= .04045 ? encoded / 12.92
                                              : std::pow((encoded + .055) / 1.055, 2.4));
}

const std::vector<float>& LinearTable(size_t codes) {
  static const auto make = [](size_t count) {
    std::vector<float> table(count);
    for (size_t i = 0; i < count; ++i)
      table[i] = LinearOfSrgb(static_cast<double>(i) / static_cast<double>(count - 1));
    return table;
  };
  static const std::vector<float> of_8_bits = make(256);
  static const std::vector<float> of_16_bits = make(65536);
  return codes == 256 ? of_8_bits : of_16_bits;
}

float FloatOfHalf(uint16_t half) {
  const double sign = (half & 0x8000) != 0 ? -1 : 1;
  const int exponent = half >> 10 & 31;
  const int mantissa = half & 1023;
  if (exponent == 31) return static_cast<float>(sign * 65504);  // infinite: as bright as can be
  if (exponent == 0) return static_cast<float>(sign * std::ldexp(mantissa, -24));
  return static_cast<float>(sign * std::ldexp(1024 + mantissa, exponent - 25));
}

template <typename Sample>
Sample SampleAt(const Picture& picture, size_t index) {
  Sample sample;
  std::memcpy(&sample, picture.bytes.data() + index * sizeof(Sample), sizeof(Sample));
  return sample;
}

// A sample as a number: colours in linear light.
float NumberAt(const Picture& picture, size_t index, bool is_alpha) {
  float number = 0;
  switch (picture.format) {
    case PixelFormat::kPng8: {
      const uint8_t code = picture.bytes[index];
      number = is_alpha ? static_cast<float>(code) / 255 : LinearTable(256)[code];
      break;
    }
    case PixelFormat::kPng16: {
      const auto code = SampleAt<uint16_t>(picture, index);
      number = is_alpha ? static_cast<float>(code) / 65535 : LinearTable(65536)[code];
      break;
    }
    case PixelFormat::kExrHalf:
      number = FloatOfHalf(SampleAt<uint16_t>(picture, index));
      break;
    case PixelFormat::kExrFloat:
      number = SampleAt<float>(picture, index);
      break;
  }
  return std::isfinite(number) ? number : 0;
}

// Squares of a twelfth of the picture's height.
float SquareAt(const Picture& picture, size_t pixel) {
  const size_t side = std::max<size_t>(1, picture.height / 12);
  const size_t x = pixel % picture.width / side, y = pixel / picture.width / side;
  return (x + y) % 2 == 0 ? .6f : .32f;
}

}  // namespace

std::vector<float> LinearSamples(const Picture& picture, Behind behind) {
  const size_t channels = picture.channels();
  const size_t pixels = size_t{picture.width} * picture.height;
  const bool straight = FileEnding(picture.format) == std::string_view("png");
  std::vector<float> linear(pixels * 3);
  for (size_t i = 0; i < pixels; ++i) {
    const float alpha = picture.alpha ? NumberAt(picture, channels * i + 3, true) : 1;
    const float bare = behind == Behind::kChecker ? SquareAt(picture, i) : 0;
    for (size_t k = 0; k < 3; ++k) {
      const float color = NumberAt(picture, channels * i + k, false);
      linear[3 * i + k] = color * (straight ? alpha : 1) + (1 - alpha) * bare;
    }
  }
  return linear;
}

std::vector<uint8_t> DisplaySamples(const Picture& picture) {
  if (picture.format == PixelFormat::kPng8 && !picture.alpha) return picture.bytes;
  if (picture.format == PixelFormat::kPng16 && !picture.alpha) {
    std::vector<uint8_t> bytes(size_t{picture.width} * picture.height * 3);
    for (size_t i = 0; i < bytes.size(); ++i)
      bytes[i] = static_cast<uint8_t>((SampleAt<uint16_t>(picture, i) + 128u) / 257u);
    return bytes;
  }
  return Quantise(picture.width, picture.height, PixelFormat::kPng8, LinearSamples(picture)).bytes;
}

}  // namespace fjord
