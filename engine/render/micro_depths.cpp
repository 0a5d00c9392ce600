// Where the samples are that micro-triangles cover, and how near the triangles are there.
#include "engine/base/simd.h"
#include "engine/render/coverage.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/micro_depths.cpp"
#include "hwy/cache_control.h"
#include "hwy/foreach_target.h"  // NOLINT: compiles this file once per target
#include "hwy/highway.h"
// after highway.h: compiled per target
#include "engine/fractal/stream_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {
namespace {

HWY_INLINE VI GatherSigned(const int32_t* from, V32 index) {
  return Signed(Gather(reinterpret_cast<const uint32_t*>(from), index));
}

// Which corner leads is said by two masks; neither: the first.
HWY_INLINE V32 Turned(const V32* by, M32 second, M32 third) {
  return hn::IfThenElse(third, by[2], hn::IfThenElse(second, by[1], by[0]));
}

HWY_INLINE VF Promoted(const int32_t* from) {
  return hn::PromoteTo(DF(), hn::Load(hn::RebindToSigned<DN>(), from));
}

// Corners of N triangles, turned so that the one with the smallest (x, y) leads, as differences.
struct Led {
  static constexpr size_t kSize = kLanes32;
  HWY_ALIGN uint32_t vertex[3][kSize];
  HWY_ALIGN int32_t bx[kSize], by[kSize], cx[kSize], cy[kSize], dx[kSize], dy[kSize];

  // Hits at..; lanes from `count` on: those of triangle 0.
  HWY_INLINE Led(const Triangle* triangles, const int32_t* xy, const TileRect& tile,
                 int32_t samples, CoverageList& hits, size_t at, size_t count) {
    const D32 du;
    const I32 d;
    const V32 code =
        hn::IfThenElseZero(FirstLanes(du, count), hn::LoadU(du, hits.code.data() + at));
    const V32 number = hn::And(code, hn::Set(du, HitCode::kTriangle));
    hn::StoreU(number, du, hits.triangle.data() + at);
    const V32 place = number + number + number;
    V32 v[3], x[3], y[3];
    for (int k = 0; k < 3; ++k) {
      v[k] = Gather(triangles->data() + k, place);
      const V32 pair = v[k] + v[k];
      x[k] = Unsigned(GatherSigned(xy, pair));
      y[k] = Unsigned(GatherSigned(xy + 1, pair));
    }
    const auto before = [&](int i, int j) HWY_ATTR {
      const VI xi = Signed(x[i]), xj = Signed(x[j]);
      const MI less =
          hn::Or(hn::Lt(xi, xj), hn::And(hn::Eq(xi, xj), hn::Lt(Signed(y[i]), Signed(y[j]))));
      return hn::RebindMask(du, less);
    };
    const M32 ab = before(0, 1), ac = before(0, 2), bc = before(1, 2);
    const M32 first = hn::And(ab, ac);
    const M32 second = hn::AndNot(ab, bc);
    const M32 third = hn::Not(hn::Or(first, second));
    const V32 one = hn::Set(du, 1), two = hn::Set(du, 2);
    hn::StoreU(hn::IfThenElseZero(hn::Not(first), hn::IfThenElse(third, two, one)), du,
               hits.lead.data() + at);
    VI cornerx[3], cornery[3];
    for (int k = 0; k < 3; ++k) {
      const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      const V32 vs[3] = {v[k], v[k1], v[k2]}, xs[3] = {x[k], x[k1], x[k2]},
                ys[3] = {y[k], y[k1], y[k2]};
      hn::Store(Turned(vs, second, third), du, vertex[k]);
      cornerx[k] = Signed(Turned(xs, second, third));
      cornery[k] = Signed(Turned(ys, second, third));
    }
    hn::Store(cornerx[1] - cornerx[0], d, bx);
    hn::Store(cornery[1] - cornery[0], d, by);
    hn::Store(cornerx[2] - cornerx[0], d, cx);
    hn::Store(cornery[2] - cornery[0], d, cy);
    // coverage.cpp's place of the sample.
    const auto sample_at = [&](const V32* corner, V32 offset, V32 step) HWY_ATTR {
      const VI low = hn::Min(hn::Min(Signed(corner[0]), Signed(corner[1])), Signed(corner[2]));
      const VI within = hn::And(Signed(offset) - low, hn::Set(d, kFixedOne - 1));
      return (low + within) + hn::ShiftLeft<8>(hn::And(Signed(step), hn::Set(d, 1)));
    };
    const V32 byte = hn::Set(du, 0xff);
    const VI sx = sample_at(x, hn::And(hn::ShiftRight<HitCode::kX>(code), byte),
                            hn::ShiftRight<HitCode::kColumn>(code));
    const VI sy = sample_at(y, hn::And(hn::ShiftRight<HitCode::kY>(code), byte),
                            hn::ShiftRight<HitCode::kRow>(code));
    hn::Store(sx - cornerx[0], d, dx);
    hn::Store(sy - cornery[0], d, dy);
    const VI column = hn::ShiftRight<8>(sx) - hn::Set(d, tile.x);
    const VI row = hn::ShiftRight<8>(sy) - hn::Set(d, tile.y);
    const VI pixel = row * hn::Set(d, tile.width) + column;
    const V32 sample = hn::And(hn::ShiftRight<HitCode::kSample>(code), hn::Set(du, 0xf));
    const V32 index = Unsigned(pixel * hn::Set(d, samples)) + sample;
    hn::StoreU(hn::IfThenElseZero(FirstLanes(du, count), index), du, hits.sample.data() + at);
  }
};

void Depths(const Triangle* triangles, const int32_t* xy, const double* depths,
            const TileRect& tile, int32_t samples, const double* nearest, CoverageList* hits) {
  const DF d;
  const DN dn;
  constexpr size_t kLanes = hn::MaxLanes(DF());
  for (size_t at = 0; at < hits->hits; at += kLanes32) {
    const Led led(triangles, xy, tile, samples, *hits, at, hits->hits - at);
    // Soon to be compared with; a tile is too large for the near caches.
    for (size_t i = at; i < at + kLanes32; ++i) hwy::Prefetch(nearest + hits->sample[i]);
    for (size_t i = 0; i < kLanes32; i += kLanes) {
      VF corner[3];
      for (int k = 0; k < 3; ++k) corner[k] = Gather(depths, hn::Load(dn, led.vertex[k] + i));
      const VF bx = Promoted(led.bx + i), by = Promoted(led.by + i);
      const VF cx = Promoted(led.cx + i), cy = Promoted(led.cy + i);
      const VF inverse = hn::Set(d, 1.0) / (bx * cy - cx * by);
      const VF db = corner[1] - corner[0], dc = corner[2] - corner[0];
      const VF along_x = (db * cy - dc * by) * inverse;
      const VF along_y = (dc * bx - db * cx) * inverse;
      VF depth = (corner[0] + along_x * Promoted(led.dx + i)) + along_y * Promoted(led.dy + i);
      const auto smaller = [](VF a, VF b) HWY_ATTR { return hn::IfThenElse(hn::Lt(b, a), b, a); };
      const auto larger = [](VF a, VF b) HWY_ATTR { return hn::IfThenElse(hn::Lt(a, b), b, a); };
      depth = larger(depth, smaller(smaller(corner[0], corner[1]), corner[2]));
      depth = smaller(depth, larger(larger(corner[0], corner[1]), corner[2]));
      hn::StoreU(depth, d, hits->depth.data() + at + i);
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
HWY_EXPORT(Depths);
}  // namespace

void FindDepths(std::span<const Triangle> triangles, const ProjectedBatch& batch,
                const TileRect& tile, std::span<const SamplePlace> places, const double* nearest,
                CoverageList* hits) {
  HWY_DYNAMIC_DISPATCH(Depths)
  (triangles.data(), batch.xy.data(), batch.depth.data(), tile, static_cast<int32_t>(places.size()),
   nearest, hits);
}

}  // namespace fjord
#endif  // HWY_ONCE
