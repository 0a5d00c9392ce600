#include "engine/render/outline_fill.h"

#include <algorithm>
#include <utility>

#include "engine/base/clamp.h"
#include "engine/render/integer.h"

namespace fjord {
namespace {

bool Guarded(double v) { return v > -double{kFixedGuard} && v < double{kFixedGuard}; }

int32_t ToGrid(double v) {
  return FloorToInt32(std::clamp(v, -double{kFixedGuard}, double{kFixedGuard}) + .5);
}

// One segment, a above b, against rows of samples.
class Crossings {
 public:
  Crossings(double ax, double ay, double bx, double by)
      : guarded_(Guarded(ax) && Guarded(ay) && Guarded(bx) && Guarded(by)),
        ax_(ax),
        ay_(ay),
        slope_((bx - ax) / (by - ay)),
        x_(ToGrid(ax)),
        y_(ToGrid(ay)),
        dx_(int64_t{ToGrid(bx)} - x_),
        dy_(int64_t{ToGrid(by)} - y_) {}

  // The first pixel whose sample, `place` of it, lies at or right of the crossing with that row:
  // exact within the guard; beyond, to the precision of doubles.
  int64_t FirstPixel(int32_t sample_y, int32_t place) const {
    if (guarded_) {
      const int64_t crossing = (int64_t{sample_y} - y_) * dx_ + (int64_t{x_} - place) * dy_;
      return -FloorDivide(-crossing, dy_ * kFixedOne);
    }
    const double crossing = ax_ + (sample_y - ay_) * slope_;
    return -int64_t{FloorToInt32((place - crossing) / kFixedOne)};
  }

 private:
  bool guarded_;
  double ax_, ay_, slope_;
  int32_t x_, y_;
  int64_t dx_, dy_;
};

}  // namespace

void OutlineFill::Start(const TileBuffer& tile, OpenSide from) {
  from_ = from;
  turns_.assign(static_cast<size_t>(tile.rect().width) * static_cast<size_t>(tile.rect().height) *
                    tile.places().size(),
                0);
}

void OutlineFill::Add(const TileBuffer& tile, const Projection& to, const StreamBatch& batch) {
  for (const auto& segment : batch.segments) {
    ClipPoint a = ToClip(to, batch.vertices[segment[0]].position);
    ClipPoint b = ToClip(to, batch.vertices[segment[1]].position);
    if (to.orthographic) {
      AddSegment(tile, {a.x, a.y}, {b.x, b.y});
      continue;
    }
    if (a.z < to.near && b.z < to.near) continue;
    if (a.z < to.near || b.z < to.near) {
      const double t = (to.near - a.z) / (b.z - a.z);
      (a.z < to.near ? a : b) = {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, to.near};
    }
    const double inverse_a = 1 / a.z, inverse_b = 1 / b.z;
    AddSegment(tile, {a.x * inverse_a, a.y * inverse_a}, {b.x * inverse_b, b.y * inverse_b});
  }
}

void OutlineFill::AddSegment(const TileBuffer& tile, const Place& a, const Place& b) {
  const int32_t ay = ToGrid(a.y), by = ToGrid(b.y);
  if (ay == by) return;
  const bool down = ay < by;
  const Place& upper = down ? a : b;
  const Place& lower = down ? b : a;
  const int32_t first = std::min(ay, by), end = std::max(ay, by);
  const Crossings crossings(upper.x, upper.y, lower.x, lower.y);
  const TileRect& rect = tile.rect();
  const int32_t bottom = std::min(end >> 8, rect.bottom() - 1);
  for (int32_t y = std::max(first >> 8, rect.y); y <= bottom; ++y) {
    for (size_t s = 0; s < tile.places().size(); ++s) {
      const SamplePlace& place = tile.places()[s];
      const int32_t sample_y = y * kFixedOne + place.y;
      if (sample_y < first || sample_y >= end) continue;
      AddCrossing(tile, crossings.FirstPixel(sample_y, place.x), y, s, down ? 1 : -1);
    }
  }
}

// first: the first pixel right of the crossing. Counted from the right, those left of it change.
void OutlineFill::AddCrossing(const TileBuffer& tile, int64_t first, int32_t y, size_t sample,
                              int32_t turn) {
  const TileRect& rect = tile.rect();
  const bool left = from_ == OpenSide::kLeft;
  const int64_t at =
      left ? std::max<int64_t>(first, rect.x) : std::min<int64_t>(first - 1, rect.right() - 1);
  if (at < rect.x || at >= rect.right()) return;
  turns_[tile.Index(static_cast<int32_t>(at), y, static_cast<int32_t>(sample))] +=
      left ? turn : -turn;
}

void OutlineFill::Finish(const ViewPlane& plane, uint32_t object, TileBuffer* tile) {
  const TileRect& rect = tile->rect();
  const bool left = from_ == OpenSide::kLeft;
  const int32_t start = left ? rect.x : rect.right() - 1, step = left ? 1 : -1;
  uint32_t hit = kNoHit;
  for (int32_t y = rect.y; y < rect.bottom(); ++y) {
    for (size_t s = 0; s < tile->places().size(); ++s) {
      const SamplePlace& place = tile->places()[s];
      int32_t sum = 0;
      for (int32_t x = start; x >= rect.x && x < rect.right(); x += step) {
        const size_t index = tile->Index(x, y, static_cast<int32_t>(s));
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
