// Draws a region of a built frame, tile by tile, in parallel. The pixels depend on nothing but the
// frame: not on the region, the tile size, the threads or the patch size.
#pragma once

#include "engine/base/result.h"
#include "engine/render/built_frame.h"
#include "engine/render/frame_renderer.h"
#include "engine/render/tile_buffer.h"

namespace fjord {

Result<RenderedFrame> RenderRegion(const BuiltFrame& frame, const TileRect& region,
                                   const RenderOptions& options);

}  // namespace fjord
