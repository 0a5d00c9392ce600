// Ordered dither for 8-bit pictures: a smooth gradient becomes a mixture of two codes instead of
// bands. What is added before rounding down is a function of the absolute pixel place and the
// channel alone, so it knows no tile, thread or frame, and a still picture stays still.
//
// Along a column sixteen offsets follow one another in bit-reversed order; along a row an offset
// stays for 64 pixels, staggered like bricks, so that PNG's runs survive: pictures grow by some per
// cent, where a square pattern doubles them. Channels have the offsets in different rows.
//
// Offsets stay below a code's width: what a code stands for exactly stays that code everywhere.
// Thread-safe.
#pragma once

#include <cstdint>
#include <span>

namespace fjord {

// Added to a 16-bit sRGB code before it is divided by 257: 8, 24 .. 248.
uint32_t DitherOffset(uint32_t x, uint32_t y, uint32_t channel);

// Pixels x.. of row y of the picture, RGB: each sample's 16-bit sRGB code plus its offset, divided
// by 257. Values as for EncodeSrgb8. With 4 channels a pixel the fourth code is left as it is.
void EncodeDithered8(uint32_t x, uint32_t y, std::span<const float> linear,
                     std::span<uint8_t> codes, uint32_t channels = 3);

}  // namespace fjord
