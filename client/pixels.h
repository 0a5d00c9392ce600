// Samples of decoded pictures as the client's own tools want them. Not for pictures that are
// digested: those come from the engine alone.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/image/picture.h"

namespace fjord {

// Linear light, 3 floats a pixel, top row first.
std::vector<float> LinearSamples(const Picture& picture);

// sRGB, 3 bytes a pixel, top row first; clamped.
std::vector<uint8_t> DisplaySamples(const Picture& picture);

}  // namespace fjord
