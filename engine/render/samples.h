// Where in a pixel its samples lie, in 1/256 pixel: the same in every pixel of every picture.
#pragma once

#include <cstdint>
#include <span>

namespace fjord {

struct SamplePlace {
  int32_t x, y;
};

namespace internal {
inline constexpr SamplePlace kOneSample[] = {{128, 128}};
// A rotated grid: four rows and four columns, one sample in each.
inline constexpr SamplePlace kFourSamples[] = {{96, 32}, {224, 96}, {32, 160}, {160, 224}};
// 4x4 cells and a Latin square: each of 16 rows and columns holds one sample.
inline constexpr SamplePlace kSixteenSamples[] = {
    {8, 56},   {72, 40},   {136, 24},  {200, 8},   {24, 120}, {88, 104},  {152, 88},  {216, 72},
    {40, 184}, {104, 168}, {168, 152}, {232, 136}, {56, 248}, {120, 232}, {184, 216}, {248, 200}};
}  // namespace internal

// count is 1, 4 or 16.
inline std::span<const SamplePlace> SamplePlaces(uint32_t count) {
  if (count == 1) return internal::kOneSample;
  if (count == 4) return internal::kFourSamples;
  return internal::kSixteenSamples;
}

}  // namespace fjord
