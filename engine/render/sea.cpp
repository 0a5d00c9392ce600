#include "engine/render/sea.h"

#include <limits>

#include "engine/render/rays.h"

namespace fjord {

std::optional<SeaPlane> MakeSeaPlane(const View& view, double level) {
  const Rays rays = MakeRays(view);
  SeaPlane plane;
  if (view.orthographic) {
    // (origin + x along_x + y along_y - forward depth).z = level
    if (view.forward.z == 0) return std::nullopt;
    plane.depth = (rays.origin.z - level) / view.forward.z;
    plane.along_x = rays.along_x.z / view.forward.z;
    plane.along_y = rays.along_y.z / view.forward.z;
    plane.least = -std::numeric_limits<double>::infinity();
    plane.most = -view.near;
  } else {
    // eye.z + direction.z / depth = level
    const double below = level - view.eye.z;
    if (below == 0) return std::nullopt;
    plane.depth = rays.direction.z / below;
    plane.along_x = rays.along_x.z / below;
    plane.along_y = rays.along_y.z / below;
    plane.least = 0;
    plane.most = 1 / view.near;
  }
  const auto size = [](double v) { return v < 0 ? -v : v; };
  plane.behind = size(plane.along_x) + size(plane.along_y);
  return plane;
}

}  // namespace fjord
