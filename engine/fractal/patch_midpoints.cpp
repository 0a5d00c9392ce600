// Midpoints and the halves of long edges, N edges in lock-step.
#include "engine/fractal/patch.h"

// The order matters.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/fractal/patch_midpoints.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep

#include "hwy/highway.h"
#include "engine/base/exact_math-inl.h"
#include "engine/base/random.h"
#include "engine/fractal/amount.h"
#include "engine/fractal/patch_lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {

struct Triple {
  VF x, y, z;
};

HWY_INLINE VF Dot(const Triple& a, const Triple& b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
HWY_INLINE Triple Cross(const Triple& a, const Triple& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
HWY_INLINE Triple Scaled(const Triple& a, VF s) { return {a.x * s, a.y * s, a.z * s}; }
HWY_INLINE Triple Select(MF m, const Triple& a, const Triple& b) {
  return {hn::IfThenElse(m, a.x, b.x), hn::IfThenElse(m, a.y, b.y), hn::IfThenElse(m, a.z, b.z)};
}

// a / |a|; `some`: where |a| is not 0, elsewhere the result is 0.
HWY_INLINE Triple UnitOrZero(const Triple& a, MF& some) {
  const DF d;
  const VF length2 = Dot(a, a);
  some = hn::Gt(length2, hn::Zero(d));
  return Scaled(a, hn::IfThenElseZero(some, hn::Set(d, 1.0) / hn::Sqrt(length2)));
}

HWY_INLINE VU MixLanes(VU x) {
  const DU du;
  const VU factor = hn::Set(du, 0xd6e8feb86659fd93u);
  const auto times = [&](VU v) {
#if HWY_TARGET <= HWY_AVX3 || HWY_TARGET == HWY_SCALAR
    return v * factor;
#else
    const hn::Repartition<uint32_t, DU> d32;
    const auto low = hn::BitCast(d32, v);
    const auto high = hn::BitCast(d32, hn::ShiftRight<32>(v));
    const VU cross = hn::MulEven(high, hn::BitCast(d32, factor)) +
                     hn::MulEven(low, hn::BitCast(d32, hn::ShiftRight<32>(factor)));
    return hn::MulEven(low, hn::BitCast(d32, factor)) + hn::ShiftLeft<32>(cross);
#endif
  };
  x = hn::Xor(x, hn::ShiftRight<32>(x));
  x = times(x);
  x = hn::Xor(x, hn::ShiftRight<32>(x));
  x = times(x);
  return hn::Xor(x, hn::ShiftRight<32>(x));
}

// A whole number below 2^52 as a double.
HWY_INLINE VF WholeLanes(VU n) {
  const DF d;
  const VU magic = hn::Set(DU(), uint64_t{0x4330000000000000u});
  return hn::BitCast(d, hn::Or(n, magic)) - hn::BitCast(d, magic);
}

// Gaussian(id, rules.uniforms), bit for bit (random.h).
HWY_INLINE VF GaussianLanes(const SurfaceRules& rules, VU id) {
  const DF d;
  const DU du;
  const VU pieces = hn::Set(du, uint64_t{0x0000ffff0000ffffu});
  VU sum = hn::Zero(du);
  VU bits = id;
  const uint32_t n = rules.uniforms;
  for (uint32_t channel = 0; channel * 4 < n; ++channel) {
    if (channel > 0) bits = MixLanes(id + hn::Set(du, channel * 0x9e3779b97f4a7c15u));
    const uint32_t count = n - channel * 4;
    if (count < 4) bits = hn::And(bits, hn::Set(du, (uint64_t{1} << (16 * count)) - 1));
    const VU halves = hn::And(bits, pieces) + hn::And(hn::ShiftRight<16>(bits), pieces);
    sum = sum + hn::And(halves + hn::ShiftRight<32>(halves), hn::Set(du, uint64_t{0xffffffffu}));
  }
  return (WholeLanes(sum + sum) - hn::Set(d, rules.gaussian_middle)) *
         hn::Set(d, rules.gaussian_scale);
}

// TangentDraw(id), bit for bit.
HWY_INLINE VF TangentLanes(VU id) {
  const DF d;
  const DU du;
  const VU bits = MixLanes(id + hn::Set(du, 7 * 0x9e3779b97f4a7c15u));
  const VU piece = hn::Set(du, uint64_t{0xffff});
  const VU sum = (hn::And(bits, piece) + hn::And(hn::ShiftRight<16>(bits), piece)) +
                 hn::And(hn::ShiftRight<32>(bits), piece);
  return (WholeLanes(sum + sum) - hn::Set(d, 3 * 65535.0)) / hn::Set(d, 6.0 * 65535.0);
}

// Both sides of the split rule where it reads the frame's own lengths (kLength, kAdaptive).
struct Sides {
  VF left, right;
};
HWY_INLINE Sides CurrentSides(const SurfaceRules& rules, const Columns& a, const Columns& b,
                              VF current2) {
  const DF d;
  const VF middle2 = MiddleDistance2(FloatOf<true>(a.v[7]), FloatOf<true>(b.v[7]), current2);
  Sides sides{current2 * hn::Set(d, rules.length_scale), LongSide(rules, middle2)};
  if (rules.split != Split::kAdaptive) return sides;
  const auto row = [&](const Columns& c, int r) {
    const double* m = &rules.view.rows[static_cast<size_t>(r) * 4];
    return ((c.v[0] * hn::Set(d, m[0]) + c.v[1] * hn::Set(d, m[1])) + c.v[2] * hn::Set(d, m[2])) +
           hn::Set(d, m[3]);
  };
  const VF wa = row(a, 2), wb = row(b, 2);
  const VF near = hn::Set(d, rules.view.near);
  const MF before = hn::And(hn::Gt(wa, near), hn::Gt(wb, near));
  const VF u = row(a, 0) * wb - row(b, 0) * wa;
  const VF v = row(a, 1) * wb - row(b, 1) * wa;
  const VF ww = wa * wb;
  sides.left = hn::IfThenElse(before, u * u + v * v, sides.left);
  sides.right = hn::IfThenElse(before, hn::Set(d, rules.pixels2) * (ww * ww), sides.right);
  return sides;
}

HWY_INLINE Triple Between(const Columns& a, const Columns& b) {
  return {b.v[0] - a.v[0], b.v[1] - a.v[1], b.v[2] - a.v[2]};
}

void MeasureEdgesLanes(const SurfaceRules& rules, Patch& patch, size_t begin, size_t end) {
  const DF d;
  constexpr size_t kLanes = hn::MaxLanes(DF());
  for (size_t i = 0; i < kPatchPadding / 8; ++i) patch.edge_a[end + i] = patch.edge_b[end + i] = 0;
  for (size_t i = begin; i < end; i += kLanes) {
    const VF rest2 = hn::Abs(hn::LoadU(d, &patch.edge_length2[i]));
    const Columns a = LoadVertices(patch.vertex.data(), &patch.edge_a[i]);
    const Columns b = LoadVertices(patch.vertex.data(), &patch.edge_b[i]);
    if (rules.current()) {
      const Triple e = Between(a, b);
      const VF current2 = Dot(e, e);
      const Sides sides = CurrentSides(rules, a, b, current2);
      hn::StoreU(current2, d, &patch.edge_current2[i]);
      hn::StoreU(WithShortSign(rest2, hn::Gt(sides.left, sides.right)), d, &patch.edge_length2[i]);
    } else {
      const VF flagged = Flagged(rules, rest2, FloatOf<true>(a.v[7]), FloatOf<true>(b.v[7]));
      hn::StoreU(flagged, d, &patch.edge_length2[i]);
    }
  }
}

// Directions of N edges' sites, and which of them are coasts.
HWY_INLINE Triple SiteDirections(const Patch& patch, const uint32_t* edges, size_t lanes,
                                 VF& coast) {
  const DF d;
  constexpr size_t kLanes = hn::MaxLanes(DF());
  HWY_ALIGN double column[4][kLanes] = {};
  for (size_t i = 0; i < lanes; ++i) {
    const EdgeSite& site = patch.sites[patch.edge_site[edges[i]]];
    column[0][i] = site.direction.x;
    column[1][i] = site.direction.y;
    column[2][i] = site.direction.z;
    column[3][i] = site.coast;
  }
  coast = hn::Load(d, column[3]);
  return {hn::Load(d, column[0]), hn::Load(d, column[1]), hn::Load(d, column[2])};
}

// The offset of N midpoints but for a coast's.
HWY_INLINE VF Offsets(const SurfaceRules& rules, uint32_t level, VF g, VF rest2, VF stretch,
                      VF current2) {
  const DF d;
  if (rules.law == Law::kAffine) {
    const VF power = Pow(d, rest2, hn::Set(d, rules.half_H));
    return ((hn::Set(d, rules.affine_scale) * power) * stretch) * g;
  }
  const VF length = hn::Sqrt(current2);
  if (rules.law == Law::kShih) return (hn::Set(d, rules.shih[level]) * g) * length;
  const VF most = hn::Set(d, kSimilarClamp), least = hn::Set(d, -kSimilarClamp);
  const VF share = hn::Set(d, rules.similar) * g;
  const VF above = hn::IfThenElse(hn::Gt(share, least), share, least);
  return hn::IfThenElse(hn::Lt(above, most), above, most) * length;
}

// How far the last level has faded in: 0 where the edge has just become long, 1 from twice that on.
HWY_INLINE VF Fade(const SurfaceRules& rules, const Columns& a, const Columns& b, VF current2) {
  const DF d;
  const VF one = hn::Set(d, 1.0);
  const Sides sides = CurrentSides(rules, a, b, current2);
  const VF past = hn::Sqrt(sides.left / sides.right) - one;
  const VF t = hn::IfThenElse(hn::Lt(past, one), past, one);
  return (t * t) * (hn::Set(d, 3.0) - (t + t));
}

void SplitEdgesLanes(const SurfaceRules& rules, Patch& patch, uint32_t level) {
  const DF d;
  const DU du;
  const DN dn;
  constexpr size_t kLanes = hn::MaxLanes(DF());
  const VF half = hn::Set(d, .5), quarter = hn::Set(d, .25), zero = hn::Zero(d);
  const size_t n = patch.long_count;
  const StreamVertex* vertex = patch.vertex.data();
  const bool current = rules.current();
  for (size_t k = 0; k < n; k += kLanes) {
    const size_t lanes = n - k < kLanes ? n - k : kLanes;
    HWY_ALIGN uint32_t ia[kLanes] = {}, ib[kLanes] = {};
    HWY_ALIGN double lengths[kLanes];
    for (size_t i = 0; i < kLanes; ++i) {
      const uint32_t edge = patch.long_edge[k + (i < lanes ? i : 0)];
      ia[i] = patch.edge_a[edge];
      ib[i] = patch.edge_b[edge];
      lengths[i] = patch.edge_length2[edge];
    }
    const VF rest2 = hn::Load(d, lengths);
    const Columns a = LoadVertices(vertex, ia);
    const Columns b = LoadVertices(vertex, ib);
    const VU id_a = hn::BitCast(du, a.v[6]), id_b = hn::BitCast(du, b.v[6]);
    const VU id = MixLanes(id_a + id_b);
    const VF g = GaussianLanes(rules, id);
    const VF stretch = (FloatOf<false>(a.v[7]) + FloatOf<false>(b.v[7])) * half;
    const Triple e = Between(a, b);
    const VF current2 = Dot(e, e);

    // The stored direction.
    Triple normal{a.v[3] + b.v[3], a.v[4] + b.v[4], a.v[5] + b.v[5]};
    VF coast = zero;
    Triple site = normal;
    MF some;
    if (rules.sites) site = SiteDirections(patch, &patch.long_edge[k], lanes, coast);
    if (rules.direction == Direction::kVertex) {
      normal = UnitOrZero(normal, some);
    } else if (rules.direction == Direction::kUp) {
      normal = {zero, zero, hn::Set(d, 1.0)};
    } else {
      normal = site;
    }

    // The way the midpoint moves.
    Triple way = normal;
    if (rules.variant != Variant::kFixed) {
      const VF along = hn::IfThenElseZero(hn::Gt(current2, zero), Dot(normal, e) / current2);
      const Triple square{normal.x - e.x * along, normal.y - e.y * along, normal.z - e.z * along};
      const Triple turned = UnitOrZero(square, some);
      way = Select(some, turned, normal);
      if (rules.variant == Variant::kPerturbed) {
        const VF u = hn::Set(d, rules.perturb) * TangentLanes(id);
        const MF first = hn::RebindMask(d, hn::Lt(id_a, id_b));
        const Triple tangent =
            Scaled(UnitOrZero(Cross(e, way), some), hn::IfThenElse(first, u, zero - u));
        way = {way.x + tangent.x, way.y + tangent.y, way.z + tangent.z};
      }
    }
    VF offset = Offsets(rules, level, g, rest2, stretch, current2);
    if (rules.coast) {
      // Horizontal, square to the edge, and outward as seen from the smaller identity (S22).
      const MF is_coast = hn::Gt(coast, zero);
      const MF first = hn::RebindMask(d, hn::Lt(id_a, id_b));
      const Triple level_way = UnitOrZero({e.y, zero - e.x, zero}, some);
      const VF share = hn::Set(d, rules.coast_similar) * g;
      const VF most = hn::Set(d, kSimilarClamp), least = hn::Set(d, -kSimilarClamp);
      const VF above = hn::IfThenElse(hn::Gt(share, least), share, least);
      const VF moved = hn::IfThenElse(hn::Lt(above, most), above, most) * hn::Sqrt(current2);
      way = Select(is_coast, level_way, way);
      offset = hn::IfThenElse(is_coast, hn::IfThenElse(first, moved, zero - moved), offset);
    }
    if (rules.split == Split::kAdaptive) offset = offset * Fade(rules, a, b, current2);

    Columns m;
    m.v[0] = (a.v[0] + b.v[0]) * half + way.x * offset;
    m.v[1] = (a.v[1] + b.v[1]) * half + way.y * offset;
    m.v[2] = (a.v[2] + b.v[2]) * half + way.z * offset;
    m.v[3] = normal.x;
    m.v[4] = normal.y;
    m.v[5] = normal.z;
    m.v[6] = hn::BitCast(d, id);
    const VF da = FloatOf<true>(a.v[7]), db = FloatOf<true>(b.v[7]);
    VF distance2;
    if (current) {
      const VF x = m.v[0] - hn::Set(d, rules.eye.x), y = m.v[1] - hn::Set(d, rules.eye.y),
               z = m.v[2] - hn::Set(d, rules.eye.z);
      distance2 = (x * x + y * y) + z * z;
    } else {
      distance2 = MiddleDistance2(da, db, rest2);
    }
    // Never below 0, and within a float.
    const VF most = hn::Set(d, 3e38);
    distance2 = hn::IfThenElseZero(hn::Gt(distance2, zero), distance2);
    distance2 = hn::IfThenElse(hn::Lt(distance2, most), distance2, most);
    const auto distance_float = hn::DemoteTo(DS(), distance2);
    m.v[7] = FloatsWord(hn::DemoteTo(DS(), stretch), distance_float);
    StoreVertices(m, &patch.vertex[patch.midpoints + k]);

    // Both halves: a to midpoint, midpoint to b.
    VF first2 = rest2 * quarter;
    VF second2 = first2;
    if (!current) {
      const VF dm = hn::PromoteTo(d, distance_float);
      first2 = Flagged(rules, first2, da, dm);
      second2 = Flagged(rules, second2, dm, db);
    }
    const size_t first = patch.halves[0] + k, second = patch.halves[1] + k;
    const VN middle = hn::Iota(dn, static_cast<uint32_t>(patch.midpoints + k));
    hn::StoreU(hn::Load(dn, ia), dn, &patch.edge_a[first]);
    hn::StoreU(middle, dn, &patch.edge_b[first]);
    hn::StoreU(first2, d, &patch.edge_length2[first]);
    hn::StoreU(middle, dn, &patch.edge_a[second]);
    hn::StoreU(hn::Load(dn, ib), dn, &patch.edge_b[second]);
    hn::StoreU(second2, d, &patch.edge_length2[second]);
    if (rules.sites) {
      for (size_t i = 0; i < lanes; ++i) {
        const uint32_t number = patch.edge_site[patch.long_edge[k + i]];
        patch.edge_site[first + i] = patch.edge_site[second + i] = number;
      }
    }
  }
  // The gap between the two runs.
  for (size_t i = patch.halves[0] + n; i < patch.halves[1]; ++i) {
    patch.edge_a[i] = patch.edge_b[i] = 0;
    patch.edge_length2[i] = -1;
    if (rules.sites) patch.edge_site[i] = 0;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fjord {

HWY_EXPORT(MeasureEdgesLanes);
HWY_EXPORT(SplitEdgesLanes);

void MeasureEdges(const SurfaceRules& rules, Patch& patch, size_t begin, size_t end) {
  HWY_DYNAMIC_DISPATCH(MeasureEdgesLanes)(rules, patch, begin, end);
}

void SplitEdges(const SurfaceRules& rules, Patch& patch, uint32_t level) {
  HWY_DYNAMIC_DISPATCH(SplitEdgesLanes)(rules, patch, level);
}

}  // namespace fjord
#endif
