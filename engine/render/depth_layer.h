// The depth layer of a picture: how far along the view the nearest sample of each pixel lies.
#pragma once

#include <span>

#include "engine/render/fragments.h"
#include "engine/render/frame_setup.h"
#include "engine/render/tile_buffer.h"

namespace fjord {

// `distance` holds a float for each pixel of the tile; infinity where the sky is. `drawn` holds
// rows of the tile, in its full width; nothing opaque was drawn in the others. What is translucent
// counts as what is opaque does, however little it covers.
void MeasureDepth(const FrameSetup& setup, const TileRect& tile, const TileBuffer& drawn,
                  std::span<const Fragment> fragments, std::span<float> distance);

}  // namespace fjord
