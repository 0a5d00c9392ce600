#include "engine/render/raster_medium.h"

#include <algorithm>

#include "engine/base/simd.h"
#include "engine/render/raster_source.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/raster_medium.cpp"
#include "hwy/foreach_target.h"  // NOLINT: compiles this file once per target
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<double, 4>;
using U = hn::CappedTag<uint32_t, 4>;
using I = hn::CappedTag<int32_t, 4>;

// Places of four samples, 1/256 pixel.
struct FourPlaces {
  alignas(32) double x[4], y[4];
  alignas(16) int32_t ix[4], iy[4];

  explicit FourPlaces(const SamplePlace* places) {
    for (int i = 0; i < 4; ++i) {
      ix[i] = places[i].x;
      iy[i] = places[i].y;
      x[i] = static_cast<double>(places[i].x);
      y[i] = static_cast<double>(places[i].y);
    }
  }
};

// Depth of the covered ones (bits) of four samples of pixel (x, y) against what is there; returns
// the bits that are strictly nearer, whose depths are stored. Ties are put into *tied, not stored.
HWY_INLINE uint32_t Nearer(const DepthPlane& plane, const FourPlaces& places, int32_t x, int32_t y,
                           uint32_t bits, double* HWY_RESTRICT depth, uint32_t* tied) {
  const F d;
  constexpr uint32_t kLanes = hn::MaxLanes(F());
  const auto left = hn::Set(d, static_cast<double>(int64_t{x} * kFixedOne - plane.x));
  const auto top = hn::Set(d, static_cast<double>(int64_t{y} * kFixedOne - plane.y));
  const auto least = hn::Set(d, plane.least), most = hn::Set(d, plane.most);
  uint32_t won = 0;
  for (uint32_t i = 0; i < 4; i += kLanes) {
    uint8_t part[8] = {static_cast<uint8_t>((bits >> i) & ((1u << kLanes) - 1))};
    if (part[0] == 0) continue;
    const auto covered = hn::LoadMaskBits(d, part);
    const auto dx = hn::Add(left, hn::Load(d, places.x + i));
    const auto dy = hn::Add(top, hn::Load(d, places.y + i));
    auto at = hn::Add(hn::Add(hn::Set(d, plane.depth), hn::Mul(hn::Set(d, plane.along_x), dx)),
                      hn::Mul(hn::Set(d, plane.along_y), dy));
    at = hn::IfThenElse(hn::Lt(at, least), least, at);
    at = hn::IfThenElse(hn::Gt(at, most), most, at);
    const auto there = hn::LoadU(d, depth + i);
    const auto win = hn::And(covered, hn::Gt(at, there));
    const auto tie = hn::And(covered, hn::Eq(at, there));
    if (!hn::AllFalse(d, tie)) {
      hn::StoreMaskBits(d, tie, part);
      *tied |= static_cast<uint32_t>(part[0]) << i;
    }
    if (hn::AllFalse(d, win)) continue;
    hn::BlendedStore(at, win, d, depth + i);
    hn::StoreMaskBits(d, win, part);
    won |= static_cast<uint32_t>(part[0]) << i;
  }
  return won;
}

HWY_INLINE void StoreHit(uint32_t hit, uint32_t bits, uint32_t* HWY_RESTRICT to) {
  const U d;
  constexpr uint32_t kLanes = hn::MaxLanes(U());
  for (uint32_t i = 0; i < 4; i += kLanes) {
    const uint8_t part[8] = {static_cast<uint8_t>((bits >> i) & ((1u << kLanes) - 1))};
    if (part[0] == 0) continue;
    hn::BlendedStore(hn::Set(d, hit), hn::LoadMaskBits(d, part), d, to + i);
  }
}

void Medium(const ScreenPoint& p, const ScreenPoint& q, const ScreenPoint& r,
            const DepthPlane& plane, HitSource* source, TileBuffer* tile) {
  const I d;
  constexpr uint32_t kLanes = hn::MaxLanes(I());
  const TileRect& rect = tile->rect();
  const int32_t left = std::max(std::min({p.x, q.x, r.x}) >> 8, rect.x);
  const int32_t right = std::min(std::max({p.x, q.x, r.x}) >> 8, rect.right() - 1);
  const int32_t top = std::max(std::min({p.y, q.y, r.y}) >> 8, rect.y);
  const int32_t bottom = std::min(std::max({p.y, q.y, r.y}) >> 8, rect.bottom() - 1);
  const ScreenPoint* corner[4] = {&p, &q, &r, &p};
  int32_t a[3], b[3], start[3];
  for (int k = 0; k < 3; ++k) {
    a[k] = corner[k]->y - corner[k + 1]->y;
    b[k] = corner[k + 1]->x - corner[k]->x;
    start[k] = a[k] * (left * kFixedOne - corner[k]->x) + b[k] * (top * kFixedOne - corner[k]->y);
    if (!(a[k] > 0 || (a[k] == 0 && b[k] > 0))) start[k] -= 1;
  }
  for (size_t group = 0; group < tile->places().size(); group += 4) {
    const FourPlaces places(tile->places().data() + group);
    alignas(16) int32_t offset[3][4];
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 4; ++i) offset[k][i] = a[k] * places.ix[i] + b[k] * places.iy[i];
    }
    for (int32_t y = top; y <= bottom; ++y) {
      const int32_t down = (y - top) * kFixedOne;
      int32_t e0 = start[0] + b[0] * down, e1 = start[1] + b[1] * down, e2 = start[2] + b[2] * down;
      for (int32_t x = left; x <= right; ++x) {
        uint32_t bits = 0;
        for (uint32_t i = 0; i < 4; i += kLanes) {
          const auto s0 = hn::Add(hn::Set(d, e0), hn::Load(d, offset[0] + i));
          const auto s1 = hn::Add(hn::Set(d, e1), hn::Load(d, offset[1] + i));
          const auto s2 = hn::Add(hn::Set(d, e2), hn::Load(d, offset[2] + i));
          const auto inside = hn::Gt(hn::Or(hn::Or(s0, s1), s2), hn::Set(d, -1));
          uint8_t part[8] = {};
          hn::StoreMaskBits(d, inside, part);
          bits |= static_cast<uint32_t>(part[0]) << i;
        }
        e0 += a[0] * kFixedOne;
        e1 += a[1] * kFixedOne;
        e2 += a[2] * kFixedOne;
        if (bits == 0) continue;
        const size_t base = tile->Index(x, y, static_cast<int32_t>(group));
        uint32_t tied = 0;
        uint32_t won = Nearer(plane, places, x, y, bits, tile->depth() + base, &tied);
        for (uint32_t i = 0; tied != 0; ++i, tied >>= 1) {
          const HitRecord& record = source->record;
          if ((tied & 1) && tile->WinsTie(base + i, record.object, record.tie)) won |= 1u << i;
        }
        if (won != 0) StoreHit(source->Get(tile), won, tile->hit() + base);
      }
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fjord {
namespace {
HWY_EXPORT(Medium);
}  // namespace

void FillMedium(const ScreenPoint& p, const ScreenPoint& q, const ScreenPoint& r,
                const DepthPlane& plane, HitSource* source, TileBuffer* tile) {
  HWY_DYNAMIC_DISPATCH(Medium)(p, q, r, plane, source, tile);
}

}  // namespace fjord
#endif  // HWY_ONCE
