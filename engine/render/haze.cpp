#include "engine/render/haze.h"

#include <cmath>

#include "engine/base/exact_math.h"
#include "engine/render/surface_hits.h"

namespace fjord {

void AddHaze(const Haze& haze, bool orthographic, SurfaceHits* hits) {
  constexpr double kLog2OfE = 1.4426950408889634;
  const double rate = -haze.density * kLog2OfE;
  for (size_t i = 0; i < hits->size; ++i) {
    const Vec3 way(hits->to_eye[0][i], hits->to_eye[1][i], hits->to_eye[2][i]);
    const double depth = hits->depth[i];
    // Perspective: `way` is as long as it is where the distance along the view is 1.
    double distance = orthographic ? -depth : std::sqrt(glm::dot(way, way)) / depth;
    if (!(distance > 0)) distance = 0;
    const double power = rate * distance;
    const auto left = static_cast<float>(exact::Exp2(power));
    for (int k = 0; k < 3; ++k) {
      float& color = hits->color[k][i];
      color = haze.color[k] + (color - haze.color[k]) * left;
    }
  }
}

}  // namespace fjord
