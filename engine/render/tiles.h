// Draws a region of a frame, tile by tile, in parallel. The pixels depend on nothing but the frame:
// not on the region, the tile size, the threads or the patch size.
#pragma once

#include "engine/base/result.h"
#include "engine/render/built_frame.h"
#include "engine/render/frame_renderer.h"
#include "engine/render/frame_setup.h"
#include "engine/render/tile_buffer.h"

namespace fjord {

// `setup` with its shadows drawn (shadow_draw.h).
Result<RenderedFrame> RenderRegion(const FrameSetup& setup, const TileRect& region,
                                   const RenderOptions& options);

// Sets up, draws the shadows, then the region.
Result<RenderedFrame> RenderRegion(const BuiltFrame& frame, const TileRect& region,
                                   const RenderOptions& options);

}  // namespace fjord
