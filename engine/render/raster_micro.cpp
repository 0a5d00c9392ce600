// Micro-triangles: coverage comes from the SIMD kernel as masks; here depth decides, sample by
// sample.
#include "engine/render/raster.h"
#include "engine/render/raster_source.h"
#include "engine/render/triangle_setup.h"

namespace fjord {

void Raster::DrawMicro(const StreamBatch& batch) {
  const std::span<const SamplePlace> places = tile_->places();
  const uint32_t group = places.size() == 1 ? 1 : 4;
  const uint32_t shift = group == 1 ? 0 : 2;
  double* depths = tile_->depth();
  uint32_t* hits = tile_->hit();
  for (size_t i = 0; i < coverage_.hits; ++i) {
    const Triangle& triangle = batch.triangles[coverage_.triangle[i]];
    const ScreenPoint p[3] = {projected_.At(triangle[0]), projected_.At(triangle[1]),
                              projected_.At(triangle[2])};
    const int lead = LeadingCorner(p[0], p[1], p[2]);
    const int second = lead == 2 ? 0 : lead + 1;
    const int third = second == 2 ? 0 : second + 1;
    const DepthPlane plane(p[lead], p[second], p[third]);
    const uint32_t first_place = (coverage_.mask[i] >> 16) * 4;
    uint32_t hit = kNoHit;
    for (uint32_t mask = coverage_.mask[i] & 0xffff; mask != 0; mask &= mask - 1) {
      const uint32_t bit = static_cast<uint32_t>(__builtin_ctz(mask));
      const uint32_t pixel = bit >> shift;
      const uint32_t place = first_place + (bit & (group - 1));
      const int32_t x = coverage_.x[i] + static_cast<int32_t>(pixel & 1);
      const int32_t y = coverage_.y[i] + static_cast<int32_t>(pixel >> 1);
      const size_t index = tile_->Index(x, y, static_cast<int32_t>(place));
      const double depth =
          plane.At(x * kFixedOne + places[place].x, y * kFixedOne + places[place].y);
      if (!(depth >= depths[index])) continue;
      if (depth == depths[index]) [[unlikely]] {
        uint64_t tie = 0;
        for (const uint32_t v : triangle) tie += batch.vertices[v].id;
        if (!tile_->WinsTie(index, object_, tie)) continue;
      }
      if (hit == kNoHit) {
        HitRecord record = MakeRecord(batch, triangle[lead], triangle[second], triangle[third]);
        if (attributes_.any()) {
          record.corners = tile_->AddCorners(MakeCornerValues(
              to_, MakeCorner(batch, triangle[lead]), MakeCorner(batch, triangle[second]),
              MakeCorner(batch, triangle[third])));
        }
        hit = tile_->AddRecord(record);
      }
      depths[index] = depth;
      hits[index] = hit;
    }
  }
}

}  // namespace fjord
