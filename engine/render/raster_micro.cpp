// Micro-triangles: coverage comes from the SIMD kernel as masks; here depth decides.
#include "engine/render/raster.h"
#include "engine/render/raster_source.h"
#include "engine/render/resolve.h"
#include "engine/render/triangle_setup.h"

namespace fjord {

uint32_t Raster::AddHit(const StreamBatch& batch, uint32_t a, uint32_t b, uint32_t c) const {
  HitRecord record = MakeRecord(batch, a, b, c);
  if (attributes_.any()) {
    record.corners = tile_->AddCorners(
        MakeCornerValues(to_, MakeCorner(batch, a), MakeCorner(batch, b), MakeCorner(batch, c)));
  }
  return tile_->AddRecord(record);
}

uint32_t Raster::WonTies(const StreamBatch& batch, const Triangle& triangle, size_t index,
                         uint32_t bits) const {
  uint64_t tie = 0;
  for (const uint32_t v : triangle) tie += batch.vertices[v].id;
  uint32_t won = 0;
  for (uint32_t i = 0; bits >> i != 0; ++i) {
    if (((bits >> i) & 1) != 0 && tile_->WinsTie(index + i, object_, tie)) won |= 1u << i;
  }
  return won;
}

void Raster::DrawMicro(const StreamBatch& batch) {
  if (tile_->places().size() >= 4) {
    ResolveMicro(batch, projected_, coverage_, *this, tile_);
    return;
  }
  const SamplePlace place = tile_->places()[0];
  for (size_t i = 0; i < coverage_.hits; ++i) {
    const Triangle& triangle = batch.triangles[coverage_.triangle[i]];
    const ScreenPoint p[3] = {projected_.At(triangle[0]), projected_.At(triangle[1]),
                              projected_.At(triangle[2])};
    const int lead = LeadingCorner(p[0], p[1], p[2]);
    const int second = lead == 2 ? 0 : lead + 1;
    const int third = second == 2 ? 0 : second + 1;
    const DepthPlane plane(p[lead], p[second], p[third]);
    uint32_t hit = kNoHit;
    for (uint32_t mask = coverage_.mask[i]; mask != 0; mask &= mask - 1) {
      const int32_t pixel = __builtin_ctz(mask);
      const int32_t x = coverage_.x[i] + (pixel & 1), y = coverage_.y[i] + (pixel >> 1);
      const size_t index = tile_->Index(x, y, 0);
      const double depth = plane.At(x * kFixedOne + place.x, y * kFixedOne + place.y);
      double& there = tile_->depth()[index];
      if (!(depth >= there)) continue;
      if (depth == there && WonTies(batch, triangle, index, 1) == 0) continue;
      if (hit == kNoHit) hit = AddHit(batch, triangle[lead], triangle[second], triangle[third]);
      there = depth;
      tile_->hit()[index] = hit;
    }
  }
}

}  // namespace fjord
