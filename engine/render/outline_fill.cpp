#include "engine/render/outline_fill.h"

#include <algorithm>
#include <utility>

#include "engine/render/integer.h"

namespace fjord {

void OutlineFill::Start(const TileBuffer& tile) {
  turns_.assign(static_cast<size_t>(tile.rect().width) * static_cast<size_t>(tile.rect().height) *
                    tile.places().size(),
                0);
}

void OutlineFill::Add(const TileBuffer& tile, const Projection& to, const StreamBatch& batch) {
  for (const auto& [a, b] : batch.segments) {
    AddSegment(tile, ToScreen(to, ToClip(to, batch.vertices[a].position)),
               ToScreen(to, ToClip(to, batch.vertices[b].position)));
  }
}

void OutlineFill::AddSegment(const TileBuffer& tile, ScreenPoint a, ScreenPoint b) {
  int32_t turn = 1;
  if (a.y > b.y) {
    std::swap(a, b);
    turn = -1;
  }
  if (a.y == b.y) return;
  const TileRect& rect = tile.rect();
  const int64_t dx = int64_t{b.x} - a.x, dy = int64_t{b.y} - a.y;
  const int32_t top = std::max(a.y >> 8, rect.y);
  const int32_t bottom = std::min(b.y >> 8, rect.bottom() - 1);
  for (int32_t y = top; y <= bottom; ++y) {
    for (size_t s = 0; s < tile.places().size(); ++s) {
      const SamplePlace& place = tile.places()[s];
      const int32_t sample_y = y * kFixedOne + place.y;
      if (sample_y < a.y || sample_y >= b.y) continue;
      // The first pixel whose sample lies at or right of the crossing.
      const int64_t crossing = (int64_t{sample_y} - a.y) * dx + (int64_t{a.x} - place.x) * dy;
      const int64_t first = std::max<int64_t>(-FloorDivide(-crossing, dy * kFixedOne), rect.x);
      if (first >= rect.right()) continue;
      turns_[tile.Index(static_cast<int32_t>(first), y, static_cast<int32_t>(s))] += turn;
    }
  }
}

void OutlineFill::Finish(const ViewPlane& plane, uint32_t object, TileBuffer* tile) {
  const TileRect& rect = tile->rect();
  uint32_t hit = kNoHit;
  for (int32_t y = rect.y; y < rect.bottom(); ++y) {
    for (size_t s = 0; s < tile->places().size(); ++s) {
      const SamplePlace& place = tile->places()[s];
      size_t index = tile->Index(rect.x, y, static_cast<int32_t>(s));
      int32_t sum = 0;
      for (int32_t x = rect.x; x < rect.right(); ++x, index += tile->places().size()) {
        sum += turns_[index];
        if (sum == 0) continue;
        const double depth = plane.At(static_cast<double>(x * kFixedOne + place.x),
                                      static_cast<double>(y * kFixedOne + place.y));
        if (!plane.Seen(depth) || !(depth >= tile->depth()[index])) continue;
        if (depth == tile->depth()[index] && !tile->WinsTie(index, object, 0)) continue;
        if (hit == kNoHit) {
          HitRecord record;
          record.object = object;
          hit = tile->AddRecord(record);
        }
        tile->depth()[index] = depth;
        tile->hit()[index] = hit;
      }
    }
  }
}

}  // namespace fjord
