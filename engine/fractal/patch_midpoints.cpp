// Midpoints and the halves of long edges, N edges in lock-step.
#include "engine/fractal/patch.h"

// The order matters.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/fractal/patch_midpoints.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep

#include "hwy/highway.h"
#include "engine/fractal/patch_lanes-inl.h"
#include "engine/fractal/patch_moves-inl.h"
#include "engine/fractal/patch_shares-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {

void MeasureEdgesLanes(const SurfaceRules& rules, Patch& patch, size_t begin, size_t end) {
  const DF d;
  constexpr size_t kLanes = hn::MaxLanes(DF());
  for (size_t i = 0; i < kPatchPadding / 8; ++i)
    patch.edges.a[end + i] = patch.edges.b[end + i] = 0;
  for (size_t i = begin; i < end; i += kLanes) {
    const VF rest2 = hn::Abs(hn::LoadU(d, &patch.edges.length2[i]));
    const Columns a = LoadVertices(patch.vertices.value.data(), &patch.edges.a[i]);
    const Columns b = LoadVertices(patch.vertices.value.data(), &patch.edges.b[i]);
    if (rules.staged()) {
      const double* distance2 = patch.vertices.distance2.data();
      const VF da = Gather(distance2, hn::LoadU(DN(), &patch.edges.a[i]));
      const VF db = Gather(distance2, hn::LoadU(DN(), &patch.edges.b[i]));
      hn::StoreU(Flagged<true>(rules, rest2, da, db), d, &patch.edges.length2[i]);
    } else if (rules.current()) {
      const Triple e = Between(a, b);
      const VF current2 = Dot(e, e);
      const Sides sides = CurrentSides(rules, a, b, current2);
      hn::StoreU(current2, d, &patch.edges.current2[i]);
      hn::StoreU(WithShortSign(rest2, hn::Gt(sides.left, sides.right)), d, &patch.edges.length2[i]);
    } else {
      const VF flagged = Flagged<false>(rules, rest2, FloatOf<true>(a.v[7]), FloatOf<true>(b.v[7]));
      hn::StoreU(flagged, d, &patch.edges.length2[i]);
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
    const EdgeSite& site = patch.edges.sites[patch.edges.site[edges[i]]];
    column[0][i] = site.direction.x;
    column[1][i] = site.direction.y;
    column[2][i] = site.direction.z;
    column[3][i] = site.coast;
  }
  coast = hn::Load(d, column[3]);
  return {hn::Load(d, column[0]), hn::Load(d, column[1]), hn::Load(d, column[2])};
}

// kPlain: direction VERTEX, variant FIXED, law affine, split SHOT, no coast: what most
// pictures use, with nothing left to ask inside the loop.
// kShared: SurfaceRules::even.
template <bool kPlain, bool kShared>
HWY_INLINE void SplitEdgesBy(const SurfaceRules& rules, Patch& patch, uint32_t level) {
  const DF d;
  const DU du;
  const DN dn;
  constexpr size_t kLanes = hn::MaxLanes(DF());
  const VF half = hn::Set(d, .5), quarter = hn::Set(d, .25), zero = hn::Zero(d);
  const size_t n = patch.long_edges.count;
  const StreamVertex* vertex = patch.vertices.value.data();
  StreamVertex* made = patch.vertices.value.data() + patch.long_edges.midpoints;
  const uint32_t* list_a = patch.long_edges.a.data();
  const uint32_t* list_b = patch.long_edges.b.data();
  uint32_t* edge_a = patch.edges.a.data();
  uint32_t* edge_b = patch.edges.b.data();
  double* edge_length2 = patch.edges.length2.data();
  const size_t halves[2] = {patch.long_edges.halves[0], patch.long_edges.halves[1]};
  const size_t midpoints = patch.long_edges.midpoints;
  const bool current = !kPlain && rules.current();
  const bool sites = !kPlain && rules.sites;
  const bool staged = !kPlain && rules.staged();
  const StageWeight weight(rules, staged ? level + 1 : 1);
  for (size_t k = 0; k < n; k += kLanes) {
    const size_t lanes = n - k < kLanes ? n - k : kLanes;
    const VF rest2 = hn::LoadU(d, &patch.long_edges.length2[k]);
    const Columns a = LoadVertices(vertex, list_a + k);
    const Columns b = LoadVertices(vertex, list_b + k);
    const VU id_a = hn::BitCast(du, a.v[6]), id_b = hn::BitCast(du, b.v[6]);
    const VU id = MixLanes(id_a + id_b);
    VU left = hn::Zero(du), right = left;
    if (kShared) {
      LoadPairs(patch.edges.shares.data(), &patch.long_edges.number[k], left, right);
    }
    const VF g = kShared ? SharedGaussianLanes(rules, left, right, id) : GaussianLanes(rules, id);
    const VF stretch = (FloatOf<false>(a.v[7]) + FloatOf<false>(b.v[7])) * half;

    // The direction that is kept.
    Triple normal{a.v[3] + b.v[3], a.v[4] + b.v[4], a.v[5] + b.v[5]};
    VF coast = zero;
    MF some;
    if (kPlain || rules.direction == Direction::kVertex) normal = UnitOrZero(normal, some);
    if (sites) {
      const Triple site = SiteDirections(patch, &patch.long_edges.number[k], lanes, coast);
      if (rules.direction != Direction::kVertex) normal = site;
    }
    if (!kPlain && rules.direction == Direction::kUp) normal = {zero, zero, hn::Set(d, 1.0)};

    Triple way = normal;
    VF offset = (hn::LoadU(d, &patch.long_edges.amount[k]) * stretch) * g;
    if (!kPlain) Bend(rules, level, a, b, g, coast, way, offset);

    VF da = FloatOf<true>(a.v[7]), db = FloatOf<true>(b.v[7]);
    if (staged) {
      da = Gather(patch.vertices.distance2.data(), hn::LoadU(dn, list_a + k));
      db = Gather(patch.vertices.distance2.data(), hn::LoadU(dn, list_b + k));
    }
    VF distance2 = MiddleDistance2(da, db, rest2);
    if (staged) {
      // Never below 0, and kept as it is: as a float it would move in steps.
      distance2 = hn::IfThenElseZero(hn::Gt(distance2, zero), distance2);
      hn::StoreU(distance2, d, &patch.vertices.distance2[patch.long_edges.midpoints + k]);
      offset = offset * weight(distance2);
    }

    Columns m;
    m.v[0] = (a.v[0] + b.v[0]) * half + way.x * offset;
    m.v[1] = (a.v[1] + b.v[1]) * half + way.y * offset;
    m.v[2] = (a.v[2] + b.v[2]) * half + way.z * offset;
    m.v[3] = normal.x;
    m.v[4] = normal.y;
    m.v[5] = normal.z;
    m.v[6] = hn::BitCast(d, id);
    if (current) {
      const VF x = m.v[0] - hn::Set(d, rules.eye.x), y = m.v[1] - hn::Set(d, rules.eye.y),
               z = m.v[2] - hn::Set(d, rules.eye.z);
      distance2 = (x * x + y * y) + z * z;
    }
    // Never below 0, and within a float.
    const VF most = hn::Set(d, 3e38);
    distance2 = hn::IfThenElseZero(hn::Gt(distance2, zero), distance2);
    distance2 = hn::IfThenElse(hn::Lt(distance2, most), distance2, most);
    const auto distance_float = hn::DemoteTo(DS(), distance2);
    m.v[7] = FloatsWord(hn::DemoteTo(DS(), stretch), distance_float);
    StoreVertices(m, made + k);

    // Both halves: a to midpoint, midpoint to b.
    VF first2 = rest2 * quarter;
    VF second2 = first2;
    if (!current) {
      const VF dm = staged ? distance2 : hn::PromoteTo(d, distance_float);
      second2 =
          staged ? Flagged<true>(rules, first2, dm, db) : Flagged<false>(rules, first2, dm, db);
      first2 =
          staged ? Flagged<true>(rules, first2, da, dm) : Flagged<false>(rules, first2, da, dm);
    }
    const size_t first = halves[0] + k, second = halves[1] + k;
    const VN middle = Counting(dn, midpoints + k);
    hn::StoreU(hn::LoadU(dn, list_a + k), dn, edge_a + first);
    hn::StoreU(middle, dn, edge_b + first);
    hn::StoreU(first2, d, edge_length2 + first);
    hn::StoreU(middle, dn, edge_a + second);
    hn::StoreU(hn::LoadU(dn, list_b + k), dn, edge_b + second);
    hn::StoreU(second2, d, edge_length2 + second);
    if (kShared && (current || AnyLong(first2) || AnyLong(second2))) {
      uint64_t* shares = patch.edges.shares.data();
      hn::StoreInterleaved2(HalfShare(left, false), HalfShare(right, true), du, shares + 2 * first);
      hn::StoreInterleaved2(HalfShare(left, true), HalfShare(right, false), du,
                            shares + 2 * second);
    }
    for (size_t i = 0; sites && i < lanes; ++i) {
      const uint32_t number = patch.edges.site[patch.long_edges.number[k + i]];
      patch.edges.site[first + i] = patch.edges.site[second + i] = number;
    }
  }
  // The gap between the two runs.
  for (size_t i = halves[0] + n; i < halves[1]; ++i) {
    edge_a[i] = edge_b[i] = 0;
    edge_length2[i] = -1;
    if (sites) patch.edges.site[i] = 0;
  }
}

void SplitEdgesLanes(const SurfaceRules& rules, Patch& patch, uint32_t level) {
  const bool plain = rules.direction == Direction::kVertex && rules.variant == Variant::kFixed &&
                     rules.law == Law::kAffine && rules.split == Split::kShot && !rules.sites;
  if (plain && rules.even) {
    SplitEdgesBy<true, true>(rules, patch, level);
  } else if (plain) {
    SplitEdgesBy<true, false>(rules, patch, level);
  } else if (rules.even) {
    SplitEdgesBy<false, true>(rules, patch, level);
  } else {
    SplitEdgesBy<false, false>(rules, patch, level);
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
