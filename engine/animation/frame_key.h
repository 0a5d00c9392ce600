// The frame key: SHA-256 over Fjord's own walk of a frame scene. Same key, same picture. The walk
// is ours, not Protobuf's serialization, so that the key never changes with a library
// (docs/frame_key.md gives it byte by byte; tests hold known answers).
#pragma once

#include <cstdint>
#include <string>

#include "engine/base/digest.h"
#include "engine/base/result.h"
#include "fjord/v1/frame.pb.h"

namespace fjord {

// Raised with any change that alters the picture of an unchanged frame scene outside the
// registries.
inline constexpr uint32_t kCoreShapeVersion = 2;

// What FrameOutput.dither says where the dither of engine/image/dither.h is on. Raised with any
// change of its pattern.
inline constexpr uint32_t kDitherVersion = 1;

// What FrameMaterial.fading says of strokes that are thinner than a pixel. Raised with any change
// of how they are drawn.
inline constexpr uint32_t kFadingVersion = 1;

// The bytes that are digested: a header with the core shape version and the version of each
// registry entry used, then the walk. NaN anywhere, or an unknown registry entry: kInvalid.
Result<std::string> FrameKeyBytes(const v1::FrameScene& frame);
Result<Digest> FrameKey(const v1::FrameScene& frame);

}  // namespace fjord
