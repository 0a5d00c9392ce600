#include "engine/render/coverage.h"

#include <algorithm>
#include <cstring>

#include "engine/base/check.h"
#include "engine/base/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/render/coverage.cpp"
#include "hwy/foreach_target.h"  // NOLINT: compiles this file once per target
#include "hwy/highway.h"
// after highway.h: compiled per target
#include "engine/fractal/stream_lanes-inl.h"

#ifndef FJORD_ENGINE_RENDER_COVERAGE_ONCE
#define FJORD_ENGINE_RENDER_COVERAGE_ONCE
namespace fjord {
namespace {

// Whole vectors are read past the last triangle.
constexpr size_t kMostLanes = 16;

// The corners of up to kCoverageBlock triangles, x y pairs.
struct CornerBlock {
  alignas(64) int64_t corner[3][kCoverageBlock + kMostLanes];

  // Those triangles that `numbers` names; null: all. Kept out of line, out of the code for wide
  // vectors: g++ 12 makes gathers of several shuffles a corner of it there.
  HWY_NOINLINE void Load(const Triangle* triangles, const uint32_t* numbers, size_t count,
                         const int32_t* xy) {
    for (size_t i = 0; i < count; ++i) {
      const Triangle& t = triangles[numbers == nullptr ? i : numbers[i]];
      for (size_t k = 0; k < 3; ++k) std::memcpy(&corner[k][i], xy + 2 * size_t{t[k]}, 8);
    }
    // Beyond: triangles without area.
    for (auto& column : corner) std::fill_n(&column[count], kMostLanes, 0);
  }
};

}  // namespace
}  // namespace fjord
#endif

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {
namespace {

// Highway 1.0 compares integers by < and > only.
HWY_INLINE MI AtLeast(VI a, VI b) { return hn::Not(hn::Lt(a, b)); }

// N triangles on the picture.
struct Lanes {
  VI x[3], y[3];
  VI left, top, right, bottom;

  Lanes(const CornerBlock& block, size_t at) {
    const I32 d;
    for (int k = 0; k < 3; ++k) {
      hn::LoadInterleaved2(d, reinterpret_cast<const int32_t*>(&block.corner[k][at]), x[k], y[k]);
    }
    left = hn::Min(hn::Min(x[0], x[1]), x[2]);
    top = hn::Min(hn::Min(y[0], y[1]), y[2]);
    right = hn::Max(hn::Max(x[0], x[1]), x[2]);
    bottom = hn::Max(hn::Max(y[0], y[1]), y[2]);
  }
};

// Differences within a triangle of two pixels at most fit 16 bits: x in the lower, y in the upper
// half of a lane, and one instruction multiplies and adds both.
HWY_INLINE VI Pack(VI x, VI y) {
  return hn::Or(hn::And(x, hn::Set(I32(), 0xffff)), hn::ShiftLeft<16>(y));
}
#if HWY_TARGET == HWY_SCALAR
HWY_INLINE VI LowHalf(VI v) { return hn::ShiftRight<16>(hn::ShiftLeft<16>(v)); }
HWY_INLINE VI Minus(VI a, VI b) {
  return Pack(LowHalf(a) - LowHalf(b), hn::ShiftRight<16>(a) - hn::ShiftRight<16>(b));
}
HWY_INLINE VI PairDot(VI a, VI b) {
  return LowHalf(a) * LowHalf(b) + hn::ShiftRight<16>(a) * hn::ShiftRight<16>(b);
}
#else
using I16 = hn::Repartition<int16_t, I32>;
HWY_INLINE VI Minus(VI a, VI b) {
  return hn::BitCast(I32(), hn::BitCast(I16(), a) - hn::BitCast(I16(), b));
}
HWY_INLINE VI PairDot(VI a, VI b) {
  const I32 d;
  VI other = hn::Zero(d);
  const VI sum = hn::ReorderWidenMulAccumulate(d, hn::BitCast(I16(), a), hn::BitCast(I16(), b),
                                               hn::Zero(d), other);
  return hn::RearrangeToOddPlusEven(sum, other);
}
#endif

// Of d = (dx, dy): (-dy, dx).
HWY_INLINE VI TurnLeft(VI v) {
  const VI low = hn::Set(I32(), 0xffff);
  const V32 bits = Unsigned(v);
  const VI swapped = Signed(hn::Or(hn::ShiftLeft<16>(bits), hn::ShiftRight<16>(bits)));
  return Minus(hn::Xor(swapped, low), low);
}

// One edge a -> b of a lane's triangle, corners from the upper left corner of its box: >= 0 inside.
struct LaneEdge {
  VI normal, value;

  LaneEdge() = default;
  HWY_INLINE LaneEdge(VI a, VI b) {
    const I32 d;
    const VI way = Minus(b, a);
    normal = TurnLeft(way);
    // Left edges go up (way < 0), top ones to the right (0 < way < 2^15): samples on them belong to
    // the triangle.
    const VI bias = hn::IfThenZeroElse(hn::Lt(way, hn::Set(d, 0x8000)), hn::Set(d, -1));
    value = bias - PairDot(normal, a);
  }
  HWY_INLINE VI At(VI place) const { return value + PairDot(normal, place); }
};

static_assert(kLanes32 <= kMostLanes);

// With many lanes there is nearly always something to do.
constexpr bool kBranch = kLanes32 < 16;

// Appends hits.
class Coverer {
 public:
  Coverer(const TileRect& tile, std::span<const SamplePlace> places, CoverageList* out)
      : places_(places), out_(out) {
    const I32 d;
    tile_left_ = hn::Set(d, tile.x * kFixedOne);
    tile_top_ = hn::Set(d, tile.y * kFixedOne);
    tile_right_ = hn::Set(d, tile.right() * kFixedOne);
    tile_bottom_ = hn::Set(d, tile.bottom() * kFixedOne);
  }

  HWY_INLINE MI Touches(const Lanes& t) const {
    return hn::And(hn::And(AtLeast(t.right, tile_left_), hn::Lt(t.left, tile_right_)),
                   hn::And(AtLeast(t.bottom, tile_top_), hn::Lt(t.top, tile_bottom_)));
  }

  // Of lanes `active`: samples in the `across` by `down` pixels from the corner of the box on.
  // numbers: of the triangles.
  HWY_INLINE void Cover(const Lanes& t, MI active, V32 numbers, int32_t across, int32_t down) {
    const I32 d;
    VI corner[3];
    for (int k = 0; k < 3; ++k) corner[k] = Pack(t.x[k] - t.left, t.y[k] - t.top);
    const VI area = PairDot(TurnLeft(Minus(corner[1], corner[0])), Minus(corner[2], corner[0]));
    active = hn::And(active, hn::Ne(area, hn::Zero(d)));
    if (hn::AllFalse(d, active)) return;
    const MI turned = hn::Lt(area, hn::Zero(d));
    const VI second = hn::IfThenElse(turned, corner[2], corner[1]);
    const VI third = hn::IfThenElse(turned, corner[1], corner[2]);
    const LaneEdge edge[3] = {{corner[0], second}, {second, third}, {third, corner[0]}};
    const VI box_corner = Pack(t.left, t.top);
    const VI size = Pack(t.right - t.left, t.bottom - t.top);
    const bool inside = hn::AllTrue(d, hn::Or(hn::Not(active), Inside(t)));
    const auto samples = static_cast<int32_t>(places_.size());
    for (int32_t s = 0; s < samples; ++s) {
      // The first place of the sample that is not left of, or above, the box.
      const VI first = hn::And(Minus(hn::Set(d, Packed(places_[s].x, places_[s].y)), box_corner),
                               hn::Set(d, Packed(kFixedOne - 1, kFixedOne - 1)));
      for (int32_t j = 0; j < down; ++j) {
        for (int32_t i = 0; i < across; ++i) {
          // No half runs over: this adds to both.
          const VI place = first + hn::Set(d, Packed(i * kFixedOne, j * kFixedOne));
          // Signs of both halves: right of, below the box.
          const VI left_over = Minus(size, place);
          const VI outside = hn::Or(left_over, hn::ShiftLeft<16>(left_over));
          if (kBranch && hn::AllTrue(d, hn::Or(hn::Not(active), hn::Lt(outside, hn::Zero(d))))) {
            continue;
          }
          const VI all = hn::Or(hn::Or(edge[0].At(place), edge[1].At(place)),
                                hn::Or(edge[2].At(place), outside));
          MI covered = hn::And(active, hn::Gt(all, hn::Set(d, -1)));
          if (kBranch && hn::AllFalse(d, covered)) continue;
          if (!inside) covered = hn::And(covered, InTile(t, place));
          Append(covered, numbers, CodeOf(s, i, j));
        }
      }
    }
  }

 private:
  static int32_t Packed(int32_t x, int32_t y) { return y << 16 | x; }

  uint32_t CodeOf(int32_t sample, int32_t column, int32_t row) const {
    const SamplePlace& place = places_[sample];
    return static_cast<uint32_t>(sample) << HitCode::kSample |
           static_cast<uint32_t>(place.x) << HitCode::kX |
           static_cast<uint32_t>(place.y) << HitCode::kY |
           static_cast<uint32_t>(column) << HitCode::kColumn |
           static_cast<uint32_t>(row) << HitCode::kRow;
  }

  // Lanes whose boxes lie in the tile, so that all of their samples do.
  HWY_INLINE MI Inside(const Lanes& t) const {
    return hn::And(hn::And(AtLeast(t.left, tile_left_), hn::Lt(t.right, tile_right_)),
                   hn::And(AtLeast(t.top, tile_top_), hn::Lt(t.bottom, tile_bottom_)));
  }
  HWY_INLINE MI InTile(const Lanes& t, VI place) const {
    const VI x = t.left + hn::And(place, hn::Set(I32(), 0xffff));
    const VI y = t.top + hn::ShiftRight<16>(place);
    return hn::And(hn::And(AtLeast(x, tile_left_), hn::Lt(x, tile_right_)),
                   hn::And(AtLeast(y, tile_top_), hn::Lt(y, tile_bottom_)));
  }

  HWY_INLINE void Append(MI covered, V32 numbers, uint32_t code) {
    const D32 du;
    const M32 mask = hn::RebindMask(du, covered);
    const V32 codes = Compactor(mask)(numbers);
    hn::StoreU(hn::Or(codes, hn::Set(du, code)), du, out_->code.data() + out_->hits);
    out_->hits += hn::CountTrue(du, mask);
  }

  std::span<const SamplePlace> places_;
  CoverageList* out_;
  VI tile_left_, tile_top_, tile_right_, tile_bottom_;
};

HWY_INLINE void AppendNumbers(MI mask, V32 numbers, std::vector<uint32_t>* to, size_t* count) {
  const D32 du;
  const M32 lanes = hn::RebindMask(du, mask);
  hn::StoreU(Compactor(lanes)(numbers), du, to->data() + *count);
  *count += hn::CountTrue(du, lanes);
}

void Cover(const Triangle* triangles, size_t count, const int32_t* xy, const TileRect& tile,
           std::span<const SamplePlace> places, CoverageList* out) {
  const I32 d;
  const D32 du;
  Coverer coverer(tile, places, out);
  const VI one = hn::Set(d, kFixedOne), two = hn::Set(d, 2 * kFixedOne);
  const VI clip = hn::Set(d, kOutOfGuard);
  CornerBlock block;
  block.Load(triangles, nullptr, count, xy);
  size_t wides = 0;
  out->hits = 0;
  out->larges = 0;
  for (size_t first = 0; first < count; first += kLanes32) {
    const Lanes t(block, first);
    const V32 numbers = Counting(du, first);
    const MI valid = hn::RebindMask(d, FirstLanes(du, count - first));
    const MI touches = hn::And(valid, coverer.Touches(t));
    // Differences of clipped corners may wrap: they are asked for by name.
    const MI clipped = hn::And(valid, hn::Eq(t.right, clip));
    const VI width = t.right - t.left, height = t.bottom - t.top;
    const MI small = hn::And(hn::Lt(width, one), hn::Lt(height, one));
    const MI medium = hn::And(hn::Lt(width, two), hn::Lt(height, two));
    const MI is_large = hn::Or(clipped, hn::AndNot(medium, touches));
    const MI is_wide = hn::And(touches, hn::AndNot(small, medium));
    if (!hn::AllFalse(d, is_large)) AppendNumbers(is_large, numbers, &out->large, &out->larges);
    if (!hn::AllFalse(d, is_wide)) AppendNumbers(is_wide, numbers, &out->wide, &wides);
    coverer.Cover(t, hn::And(touches, small), numbers, 1, 1);
  }
  if (wides == 0) return;
  block.Load(triangles, out->wide.data(), wides, xy);
  for (size_t first = 0; first < wides; first += kLanes32) {
    const V32 numbers = hn::LoadU(du, out->wide.data() + first);
    const MI valid = hn::RebindMask(d, FirstLanes(du, wides - first));
    coverer.Cover(Lanes(block, first), valid, numbers, 2, 2);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fjord {
namespace {

// Lanes of the widest level: arrays are padded by so much, and stores may run over.
constexpr size_t kPadding = 64;

template <typename T>
void Grow(std::vector<T>* v, size_t size) {
  if (v->size() < size) v->resize(size);
}

HWY_EXPORT(Cover);

}  // namespace

void FindCoverage(std::span<const Triangle> triangles, const ProjectedBatch& batch,
                  const TileRect& tile, std::span<const SamplePlace> places, CoverageList* out) {
  FJORD_CHECK(triangles.size() <= kCoverageBlock, triangles.size());
  // A wide triangle has four places a sample to cover.
  const size_t most = kCoverageBlock * places.size() * 4 + kPadding;
  Grow(&out->code, most);
  Grow(&out->triangle, most);
  Grow(&out->sample, most);
  Grow(&out->depth, most);
  Grow(&out->lead, most);
  Grow(&out->large, kCoverageBlock + kPadding);
  Grow(&out->wide, kCoverageBlock + kPadding);
  HWY_DYNAMIC_DISPATCH(Cover)
  (triangles.data(), triangles.size(), batch.xy.data(), tile, places, out);
}

}  // namespace fjord
#endif  // HWY_ONCE
