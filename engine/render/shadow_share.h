// How much of a light with a shadow map arrives at a run of samples. The same bits at every SIMD
// level.
#pragma once

#include "engine/render/shade.h"
#include "engine/render/shadow_map.h"

namespace fjord {

// Fills `arrives`, with room as hits' arrays have: 0..1 for each sample, 0 where the light stands
// behind the surface, 1 outside the map. Reads normal, to_eye and position.
void ShareOfLight(const Surface& surface, const ShadowMap& map, const SurfaceHits& hits,
                  float* arrives);

}  // namespace fjord
