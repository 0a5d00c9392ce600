// Inside the rasteriser: what a triangle's record is made from, once it wins its first sample.
#pragma once

#include <algorithm>

#include "engine/render/raster.h"
#include "engine/render/tile_buffer.h"

namespace fjord {

// Area vector as floats of moderate size: only its direction is read, and squares must not
// overflow.
inline Rgb FacetNormal(const Vec3& a, const Vec3& b, const Vec3& c) {
  Vec3 n = glm::cross(b - a, c - a);
  const double ax = n.x < 0 ? -n.x : n.x, ay = n.y < 0 ? -n.y : n.y, az = n.z < 0 ? -n.z : n.z;
  const double size = std::max(std::max(ax, ay), az);
  if (!(size > 1e-15 && size < 1e15)) {
    if (!(size > 0)) return Rgb(0);
    n = Vec3(n.x / size, n.y / size, n.z / size);
  }
  return Rgb(static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z));
}

inline CornerPlaces MakeCornerPlaces(const Projection& to, uint32_t element, const Corner& a,
                                     const Corner& b, const Corner& c) {
  CornerPlaces values;
  values.element = element;
  const Corner* corners[3] = {&a, &b, &c};
  for (int i = 0; i < 3; ++i) {
    values.x[i] = corners[i]->screen.x;
    values.y[i] = corners[i]->screen.y;
    values.weight[i] = to.orthographic ? 1 : corners[i]->screen.depth;
    values.second[i] = corners[i]->place.y;
    values.third[i] = corners[i]->place.z;
  }
  return values;
}

// One record, added to the tile when first asked for.
struct HitSource {
  HitRecord record;
  bool has_corners = false;
  CornerPlaces corners;
  uint32_t hit = kNoHit;

  uint32_t Get(TileBuffer* tile) {
    if (hit == kNoHit) {
      if (has_corners) record.corners = tile->AddCorners(corners);
      hit = tile->AddRecord(record);
    }
    return hit;
  }
};

}  // namespace fjord
