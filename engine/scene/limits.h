// The bounds on what a scene may ask for. At a bound the answer is an error that names it.
#pragma once

#include <cstdint>

#include "engine/knobs/range.h"

namespace fjord::limits {

inline constexpr uint64_t kSceneBytes = 256u << 20;  // a scene file, any form
inline constexpr uint64_t kAssetBytes = 1u << 30;    // one file that a scene names
inline constexpr int kMessageDepth = 32;             // nesting, a scene needs less than 10
inline constexpr int kErrors = 100;                  // reported at once
inline constexpr double kLargest = kLargestNumber;
inline constexpr double kFarthest = 1e15;             // the eye, where it is worked out
inline constexpr uint64_t kFilePoints = 16'000'000;   // one shape from a file or a primitive
inline constexpr uint64_t kInlinePoints = 1'000'000;  // all shapes written in the scene together
inline constexpr int kObjects = 10'000;
inline constexpr int kPlacements = 1'000'000;  // of all objects together
inline constexpr int kLights = 1'000;
inline constexpr int kTracks = 10'000;
inline constexpr int kKeys = 100'000;      // key pictures, and track keys, together each
inline constexpr int kControlPoints = 32;  // of one path
inline constexpr int kRampStops = 256;
inline constexpr int kNameBytes = 200;
inline constexpr uint32_t kPictureSide = 16384;
inline constexpr uint32_t kFrames = 1'000'000;
inline constexpr uint32_t kMaxLevel = 40;

}  // namespace fjord::limits
