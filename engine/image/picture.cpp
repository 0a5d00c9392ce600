#include "engine/image/picture.h"

#include <bit>
#include <cstring>
#include <map>
#include <string_view>

#include "engine/base/check.h"
#include "engine/image/alpha.h"
#include "engine/image/half.h"
#include "engine/image/srgb.h"

namespace fjord {
namespace {

const char* TypeName(PixelFormat format) {
  switch (format) {
    case PixelFormat::kPng8:
      return "uint8";
    case PixelFormat::kPng16:
      return "uint16";
    case PixelFormat::kExrHalf:
      return "half";
    case PixelFormat::kExrFloat:
      return "float";
  }
  return "";
}

// A float sample of -0 becomes +0: equal numbers must not give unequal digests.
uint32_t FloatSample(float value) {
  FJORD_CHECK(value == value, "a NaN reached the picture");
  return std::bit_cast<uint32_t>(value == 0 ? 0.f : value);
}

}  // namespace

const char* FileEnding(PixelFormat format) {
  return format == PixelFormat::kPng8 || format == PixelFormat::kPng16 ? "png" : "exr";
}

uint32_t BytesPerSample(PixelFormat format) {
  switch (format) {
    case PixelFormat::kPng8:
      return 1;
    case PixelFormat::kPng16:
      return 2;
    case PixelFormat::kExrHalf:
      return 2;
    case PixelFormat::kExrFloat:
      return 4;
  }
  FJORD_CHECK(false, "pixel format", static_cast<uint32_t>(format));
  return 0;
}

Picture Quantise(uint32_t width, uint32_t height, PixelFormat format, std::span<const float> linear,
                 Channels channels) {
  Picture picture{width, height, format, {}, {}, channels == Channels::kRgba};
  const size_t samples = size_t{width} * height * picture.channels();
  FJORD_CHECK(linear.size() == samples, width, height, linear.size());
  picture.bytes.resize(samples * BytesPerSample(format));
  std::vector<float> straight;
  if (picture.alpha && FileEnding(format) == std::string_view("png")) {
    ToStraight(linear, &straight);
    linear = straight;
  }
  switch (format) {
    case PixelFormat::kPng8:
      EncodeSrgb8(linear, picture.bytes);
      if (picture.alpha) EncodeAlpha8(linear, picture.bytes);
      break;
    case PixelFormat::kPng16: {
      std::vector<uint16_t> codes(samples);
      EncodeSrgb16(linear, codes);
      if (picture.alpha) EncodeAlpha16(linear, codes);
      std::memcpy(picture.bytes.data(), codes.data(), picture.bytes.size());
      break;
    }
    case PixelFormat::kExrHalf:
      for (size_t i = 0; i < samples; ++i) {
        const uint16_t half = FloatToHalf(std::bit_cast<float>(FloatSample(linear[i])));
        std::memcpy(&picture.bytes[2 * i], &half, 2);
      }
      break;
    case PixelFormat::kExrFloat:
      for (size_t i = 0; i < samples; ++i) {
        const uint32_t bits = FloatSample(linear[i]);
        std::memcpy(&picture.bytes[4 * i], &bits, 4);
      }
      break;
  }
  return picture;
}

namespace {

// Of samples of one type, `row` bytes a row.
Digest LayerDigest(const Picture& picture, std::span<const uint8_t> bytes, uint32_t channels,
                   uint32_t size, const char* type) {
  Sha256 sha;
  sha.Update("fjord-pixels 1 " + std::to_string(picture.width) + ' ' +
             std::to_string(picture.height) + ' ' + std::to_string(channels) + ' ' + type + '\n');
  if (size == 1 || std::endian::native == std::endian::big) {
    sha.Update(bytes);
    return sha.Finish();
  }
  const size_t row = size_t{picture.width} * channels * size;
  std::vector<uint8_t> swapped(row);
  for (uint32_t y = 0; y < picture.height; ++y) {
    const uint8_t* from = bytes.data() + y * row;
    for (size_t i = 0; i < row; ++i) swapped[i] = from[(i / size) * size + (size - 1 - i % size)];
    sha.Update(swapped);
  }
  return sha.Finish();
}

}  // namespace

Digest PixelDigest(const Picture& picture) {
  const Digest color = LayerDigest(picture, picture.bytes, picture.channels(),
                                   BytesPerSample(picture.format), TypeName(picture.format));
  if (picture.layers.empty()) return color;
  std::map<std::string, Digest> digests = {{"color", color}};
  for (const PictureLayer& layer : picture.layers) {
    const std::span<const uint8_t> bytes(reinterpret_cast<const uint8_t*>(layer.samples.data()),
                                         layer.samples.size() * sizeof(float));
    digests[layer.name] = LayerDigest(picture, bytes, 1, sizeof(float), "float");
  }
  Sha256 sha;
  for (const auto& [name, digest] : digests) sha.Update(digest.bytes);
  return sha.Finish();
}

}  // namespace fjord
