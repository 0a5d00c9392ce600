// Samples of decoded pictures as the client's own tools want them. Not for pictures that are
// digested: those come from the engine alone.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/image/picture.h"

namespace fjord {

// What transparent pictures are laid over where they must be opaque: black, or grey squares, which
// say that nothing is there.
enum class Behind : uint8_t { kBlack, kChecker };

// Linear light, 3 floats a pixel, top row first.
std::vector<float> LinearSamples(const Picture& picture, Behind behind = Behind::kBlack);

// sRGB, 3 bytes a pixel, top row first; clamped. Transparent pictures over black.
std::vector<uint8_t> DisplaySamples(const Picture& picture);

}  // namespace fjord
