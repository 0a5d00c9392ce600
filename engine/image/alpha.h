// Transparent pictures: how much of a pixel is covered, its alpha, beside its colour.
//
// Linear light is associated: a colour is what the covered part sends, so it is 0 where nothing is
// covered, and laying a picture over another is colour + (1 - alpha) other. EXR keeps it so. PNG is
// straight: the colour of the covered part alone, colour / alpha, black where alpha is 0; its alpha
// is alpha times the largest code, rounded to nearest and never dithered, so that what is bare or
// wholly covered stays exactly that.
//
// Pixels are R G B A. Thread-safe.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fjord {

// Colours divided by their alpha. Equal sizes, whole pixels.
void ToStraight(std::span<const float> associated, std::vector<float>* straight);

// Puts the code of each pixel's alpha in its place among `codes`, whose colours stay.
void EncodeAlpha8(std::span<const float> pixels, std::span<uint8_t> codes);
void EncodeAlpha16(std::span<const float> pixels, std::span<uint16_t> codes);

}  // namespace fjord
