// Triangles sorted by how many long edges they have, turned so that the long ones come first; those
// with none are leaves, or, under ADAPTIVE, wait with an edge for its stage. Compiled once per SIMD
// target.

#if defined(FJORD_ENGINE_FRACTAL_PATCH_SORT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FJORD_ENGINE_FRACTAL_PATCH_SORT_INL_H_
#undef FJORD_ENGINE_FRACTAL_PATCH_SORT_INL_H_
#else
#define FJORD_ENGINE_FRACTAL_PATCH_SORT_INL_H_
#endif

#include <cstring>

#include "engine/fractal/patch_lanes-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {

constexpr size_t kBlock = 256;  // triangles sorted at a time
constexpr int kLeaves = 3;      // cases: one, two, three long edges, leaves, those that wait
constexpr int kWaiting = 4;

// Triangles of one case: corners, edges, slots of the long edges, site.
struct CaseList {
  HWY_ALIGN uint32_t corner[3][kBlock + 16];
  HWY_ALIGN uint32_t edge[3][kBlock + 16];
  HWY_ALIGN uint32_t slot[3][kBlock + 16];
  HWY_ALIGN uint32_t site[kBlock + 16];
  size_t count;
};

#if HWY_TARGET == HWY_SCALAR
// One at a time: which case, and which edge comes first, looked up by the three flags.
HWY_INLINE void SortBlock(const SurfaceRules& rules, Patch& patch, size_t begin, size_t end,
                          CaseList* lists) {
  static constexpr uint8_t kCase[8] = {kLeaves, 0, 0, 1, 0, 1, 1, 2};
  static constexpr uint8_t kTurn[8] = {0, 0, 1, 0, 2, 2, 1, 0};
  const PatchTriangles& from = patch.triangles;
  const uint32_t* slots = patch.edges.slot.data();
  size_t count[5] = {};
  for (size_t t = begin; t < end; ++t) {
    uint32_t v[5], e[5], s[5];
    uint32_t flags = 0;
    bool waits = false;
    for (uint32_t k = 0; k < 3; ++k) {
      v[k] = from.corner[k][t];
      e[k] = from.edge[k][t];
      s[k] = slots[e[k] & ~Patch::kFlip];
      flags |= (s[k] < PatchEdges::kWaits ? 1u : 0u) << k;
      waits |= s[k] == PatchEdges::kWaits;
    }
    for (uint32_t k = 0; k < 2; ++k) {
      v[3 + k] = v[k];
      e[3 + k] = e[k];
      s[3 + k] = s[k];
    }
    const int which = flags == 0 && waits ? kWaiting : kCase[flags];
    CaseList& list = lists[which];
    const size_t at = count[which]++;
    const uint32_t turn = kTurn[flags];
    for (uint32_t k = 0; k < 3; ++k) {
      list.corner[k][at] = v[k + turn];
      list.edge[k][at] = e[k + turn];
      list.slot[k][at] = s[k + turn];
    }
    if (rules.sites) list.site[at] = from.site[t];
  }
  for (int i = 0; i < 5; ++i) lists[i].count = count[i];
  for (int k = 0; k < 3; ++k) {
    std::memcpy(&patch.leaves.corner[k][patch.leaves.count], lists[kLeaves].corner[k],
                count[kLeaves] * sizeof(uint32_t));
  }
  patch.leaves.count += count[kLeaves];
}
#else
HWY_INLINE V32 Turned(V32 by0, V32 by1, V32 by2, M32 turn1, M32 turn2) {
  return hn::IfThenElse(turn2, by2, hn::IfThenElse(turn1, by1, by0));
}

// Triangles t.. of the mask, as they are.
HWY_INLINE void Append(M32 mask, const V32* v, const V32* e, const Patch& patch, size_t t,
                       const SurfaceRules& rules, CaseList& list) {
  const D32 d;
  const Compactor front(mask);
  for (int k = 0; k < 3; ++k) {
    hn::StoreU(front(v[k]), d, &list.corner[k][list.count]);
    hn::StoreU(front(e[k]), d, &list.edge[k][list.count]);
  }
  if (rules.sites) {
    hn::StoreU(front(hn::LoadU(d, &patch.triangles.site[t])), d, &list.site[list.count]);
  }
  list.count += hn::CountTrue(d, mask);
}

HWY_INLINE void SortBlock(const SurfaceRules& rules, Patch& patch, size_t begin, size_t end,
                          CaseList* lists) {
  const D32 d;
  const V32 index_bits = hn::Set(d, ~Patch::kFlip), short_slot = hn::Set(d, PatchEdges::kShort);
  const V32 waiting_slot = hn::Set(d, PatchEdges::kWaits);
  const bool staged = rules.staged();
  for (const int i : {0, 1, 2, kWaiting}) lists[i].count = 0;
  const PatchTriangles& from = patch.triangles;
  for (size_t t = begin; t < end; t += kLanes32) {
    const M32 valid = FirstLanes(d, end - t);
    V32 v[3], e[3], s[3];
    M32 split[3];
    for (int k = 0; k < 3; ++k) {
      v[k] = hn::LoadU(d, &from.corner[k][t]);
      e[k] = hn::IfThenElseZero(valid, hn::LoadU(d, &from.edge[k][t]));
      const V32 index = hn::And(e[k], index_bits);
      s[k] = Gather(patch.edges.slot.data(), index);
      split[k] = hn::And(valid, hn::Ne(s[k], short_slot));
    }
    M32 leaf = valid;
    if (staged) {
      M32 its[3];
      for (int k = 0; k < 3; ++k) {
        its[k] = hn::And(valid, hn::Eq(s[k], waiting_slot));
        split[k] = hn::AndNot(its[k], split[k]);
      }
      const M32 waits = hn::Or(its[0], hn::Or(its[1], its[2]));
      leaf = hn::AndNot(waits, valid);
      Append(hn::AndNot(hn::Or(split[0], hn::Or(split[1], split[2])), waits), v, e, patch, t, rules,
             lists[kWaiting]);
    }
    const M32 any = hn::Or(split[0], hn::Or(split[1], split[2]));
    leaf = hn::AndNot(any, leaf);
    const Compactor leaf_front(leaf);
    for (int k = 0; k < 3; ++k)
      hn::StoreU(leaf_front(v[k]), d, &patch.leaves.corner[k][patch.leaves.count]);
    patch.leaves.count += hn::CountTrue(d, leaf);

    const M32 three = hn::And(split[0], hn::And(split[1], split[2]));
    const M32 both01 = hn::And(split[0], split[1]), both12 = hn::And(split[1], split[2]),
              both20 = hn::And(split[2], split[0]);
    const M32 two = hn::AndNot(three, hn::Or(both01, hn::Or(both12, both20)));
    const M32 one = hn::AndNot(hn::Or(two, three), any);
    // Turn by 1 brings edge 1 to the front, by 2 edge 2.
    const M32 turn1 = hn::Or(hn::And(one, split[1]), hn::And(two, both12));
    const M32 turn2 = hn::Or(hn::And(one, split[2]), hn::And(two, both20));
    V32 tv[3], te[3], ts[3];
    for (int k = 0; k < 3; ++k) {
      const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      tv[k] = Turned(v[k], v[k1], v[k2], turn1, turn2);
      te[k] = Turned(e[k], e[k1], e[k2], turn1, turn2);
      ts[k] = Turned(s[k], s[k1], s[k2], turn1, turn2);
    }
    const M32 masks[3] = {one, two, three};
    for (int c = 0; c < 3; ++c) {
      if (hn::AllFalse(d, masks[c])) continue;
      CaseList& list = lists[c];
      const Compactor front(masks[c]);
      for (int k = 0; k < 3; ++k) {
        hn::StoreU(front(tv[k]), d, &list.corner[k][list.count]);
        hn::StoreU(front(te[k]), d, &list.edge[k][list.count]);
        if (k <= c) hn::StoreU(front(ts[k]), d, &list.slot[k][list.count]);
      }
      if (rules.sites) {
        hn::StoreU(front(hn::LoadU(d, &from.site[t])), d, &list.site[list.count]);
      }
      list.count += hn::CountTrue(d, masks[c]);
    }
  }
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
