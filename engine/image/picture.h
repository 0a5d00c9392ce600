// A picture: samples already in their output type, and the digest that names them.
//
// Pixel digest = SHA-256 over "fjord-pixels 1 W H CHANNELS TYPE\n" and the samples, big-endian, top
// row first. TYPE is uint8, uint16, half or float. A picture with layers: SHA-256 over the 32 bytes
// of each layer's digest in the order of their names, where "color" is the name of the picture's
// own samples. Quantising happens here, before any image library sees a sample (D3), by tables and
// integer arithmetic only.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/base/digest.h"

namespace fjord {

// Numbers of scene.proto's Output.Format.
enum class PixelFormat : uint32_t { kPng8, kPng16, kExrHalf, kExrFloat };

// File ending without the dot: "png" or "exr".
const char* FileEnding(PixelFormat format);

// What an EXR holds beside the colours: one float a pixel, row by row from the top.
struct PictureLayer {
  std::string name;  // "depth"
  std::vector<float> samples;
};

// RGB, or RGBA where there is alpha (alpha.h), row by row from the top, in the byte order of this
// machine.
struct Picture {
  uint32_t width = 0;
  uint32_t height = 0;
  PixelFormat format = PixelFormat::kPng8;
  std::vector<uint8_t> bytes;        // width * height * channels() * bytes a sample
  std::vector<PictureLayer> layers;  // by name, each once
  bool alpha = false;

  uint32_t channels() const { return alpha ? 4 : 3; }
};

uint32_t BytesPerSample(PixelFormat format);

enum class Channels : uint8_t { kRgb, kRgba };

// Linear light to the format's samples. `linear` holds 3 floats a pixel, or 4 of associated colour
// and alpha, top row first. PNG: straight, clamped to 0..1, colours sRGB encoded by table; EXR: as
// it is, half rounded to nearest even. A NaN is a broken invariant.
Picture Quantise(uint32_t width, uint32_t height, PixelFormat format, std::span<const float> linear,
                 Channels channels = Channels::kRgb);

Digest PixelDigest(const Picture& picture);

}  // namespace fjord
