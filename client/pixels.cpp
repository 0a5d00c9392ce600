#include "client/pixels.h"

#include <array>
#include <cmath>
#include <cstring>

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

}  // namespace

std::vector<float> LinearSamples(const Picture& picture) {
  const size_t count = size_t{picture.width} * picture.height * 3;
  std::vector<float> linear(count);
  for (size_t i = 0; i < count; ++i) {
    switch (picture.format) {
      case PixelFormat::kPng8:
        linear[i] = LinearTable(256)[picture.bytes[i]];
        break;
      case PixelFormat::kPng16:
        linear[i] = LinearTable(65536)[SampleAt<uint16_t>(picture, i)];
        break;
      case PixelFormat::kExrHalf:
        linear[i] = FloatOfHalf(SampleAt<uint16_t>(picture, i));
        break;
      case PixelFormat::kExrFloat:
        linear[i] = SampleAt<float>(picture, i);
        break;
    }
    if (!std::isfinite(linear[i])) linear[i] = 0;
  }
  return linear;
}

std::vector<uint8_t> DisplaySamples(const Picture& picture) {
  if (picture.format == PixelFormat::kPng8) return picture.bytes;
  if (picture.format == PixelFormat::kPng16) {
    std::vector<uint8_t> bytes(size_t{picture.width} * picture.height * 3);
    for (size_t i = 0; i < bytes.size(); ++i)
      bytes[i] = static_cast<uint8_t>((SampleAt<uint16_t>(picture, i) + 128u) / 257u);
    return bytes;
  }
  return Quantise(picture.width, picture.height, PixelFormat::kPng8, LinearSamples(picture)).bytes;
}

}  // namespace fjord
