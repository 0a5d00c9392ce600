// Triangles of some pixels, four samples of a pixel at a time: drawn one by one into the visibility
// buffer. The same bits at every SIMD level.
#pragma once

#include <cstdint>

#include "engine/render/raster_source.h"
#include "engine/render/tile_buffer.h"
#include "engine/render/triangle_setup.h"
#include "engine/render/view.h"

namespace fjord {

// Corners of triangles up to so many pixels across fit FillMedium.
inline constexpr int32_t kMediumPixels = 32;

// One triangle whose box touches the tile, p, q, r turned so that its area is positive; 4 or 16
// samples a pixel. Its record is added when a sample is won.
void FillMedium(const ScreenPoint& p, const ScreenPoint& q, const ScreenPoint& r,
                const DepthPlane& plane, HitSource* source, TileBuffer* tile);

}  // namespace fjord
