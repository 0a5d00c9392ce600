#include "engine/render/depth_layer.h"

#include <algorithm>
#include <limits>

namespace fjord {

namespace {

float DistanceOf(const FrameSetup& setup, double depth) {
  return static_cast<float>(setup.view.orthographic ? -depth : 1 / depth);
}

}  // namespace

void MeasureDepth(const FrameSetup& setup, const TileRect& tile, const TileBuffer& drawn,
                  std::span<const Fragment> fragments, std::span<float> distance) {
  constexpr double kNothing = -std::numeric_limits<double>::infinity();
  const std::span<const SamplePlace> places = SamplePlaces(setup.frame.samples);
  size_t pixel = 0;
  for (int32_t y = tile.y; y < tile.bottom(); ++y) {
    const bool any = y >= drawn.rect().y && y < drawn.rect().bottom();
    for (int32_t x = tile.x; x < tile.right(); ++x, ++pixel) {
      double nearest = kNothing;
      for (size_t s = 0; s < places.size(); ++s) {
        const size_t at = any ? drawn.Index(x, y, static_cast<int32_t>(s)) : 0;
        double depth = kNothing;
        if (any && drawn.hit()[at] != kNoHit) {
          depth = drawn.depth()[at];
        } else if (setup.sea) {
          const double sea = setup.sea->At(static_cast<double>(x * kFixedOne + places[s].x),
                                           static_cast<double>(y * kFixedOne + places[s].y));
          if (setup.sea->Seen(sea)) depth = sea;
        }
        nearest = std::max(nearest, depth);
      }
      if (nearest == kNothing) {
        distance[pixel] = std::numeric_limits<float>::infinity();
      } else {
        distance[pixel] = DistanceOf(setup, nearest);
      }
    }
  }
  for (const Fragment& fragment : fragments) {
    float& nearest = distance[fragment.sample / places.size()];
    nearest = std::min(nearest, DistanceOf(setup, fragment.depth));
  }
}

}  // namespace fjord
