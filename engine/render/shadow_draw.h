// Draws the shadow maps of a frame: depth-only tiles seen from each light that has one.
#pragma once

#include <optional>

#include "engine/base/result.h"
#include "engine/render/frame_renderer.h"
#include "engine/render/frame_setup.h"

namespace fjord {

// Fills setup->shadows and the lights' places in it. Meshes throw shadows; curves, which are as
// wide as the picture makes them, do not. Of options: threads, patch_size, cancel. The maps do not
// depend on them. kLimit where a map would be too large; says what would do.
Result<> DrawShadows(FrameSetup* setup, const RenderOptions& options);

// What DrawShadows will say, without drawing.
struct ShadowDefect {
  size_t light = 0;  // from 0
  Error error;
};
std::optional<ShadowDefect> FindShadowDefect(const BuiltFrame& frame);

}  // namespace fjord
