// From picture coordinates back to the world, as linear forms.
#pragma once

#include "engine/render/view.h"

namespace fjord {

// x, y in 1/256 pixel.
// Perspective: the point at `depth` is eye + (direction + x along_x + y along_y) / depth.
// Orthographic: it is origin + x along_x + y along_y - forward depth.
struct Rays {
  Vec3 direction{0};
  Vec3 origin{0};
  Vec3 along_x{0}, along_y{0};
};

inline Rays MakeRays(const View& view) {
  const double scale = 1 / (view.focal * kFixedOne);
  Rays rays;
  rays.along_x = view.right * scale;
  rays.along_y = view.up * -scale;
  const Vec3 corner =
      view.right * (-view.center_x / view.focal) + view.up * (view.center_y / view.focal);
  rays.direction = view.orthographic ? view.forward : view.forward + corner;
  rays.origin = view.eye + corner;
  return rays;
}

}  // namespace fjord
