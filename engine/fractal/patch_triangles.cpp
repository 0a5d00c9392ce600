// Triangles by how many long edges they have (S21), N in lock-step: sorted first, so that no lane
// waits for another case.
//
// Templates, corners 0 1 2 turned so that the long edges come first, m_k the midpoint of edge k:
//   one     (0 m0 2) (m0 1 2)
//   two     (m0 1 m1), and of the rest the diagonal from the midpoint of the longer edge; equal
//           edges: from the one with the smaller sum of identities
//   three   (0 m0 m2) (m0 1 m1) (m2 m1 2) (m0 m1 m2)
#include <bit>

#include "engine/fractal/patch.h"

// The order matters.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/fractal/patch_triangles.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep

#include "hwy/highway.h"
#include "engine/fractal/patch_lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {

constexpr size_t kLanes = hn::MaxLanes(DF());
constexpr size_t kBlock = 256;  // triangles sorted at a time

// Triangles of one case: corners, edges, slots of the long edges, site.
struct CaseList {
  HWY_ALIGN uint32_t corner[3][kBlock + 16];
  HWY_ALIGN uint32_t edge[3][kBlock + 16];
  HWY_ALIGN uint32_t slot[3][kBlock + 16];
  HWY_ALIGN uint32_t site[kBlock + 16];
  size_t count;
};

HWY_INLINE V32 Turned(V32 by0, V32 by1, V32 by2, M32 turn1, M32 turn2) {
  return hn::IfThenElse(turn2, by2, hn::IfThenElse(turn1, by1, by0));
}

HWY_INLINE void SortBlock(const SurfaceRules& rules, Patch& patch, size_t begin, size_t end,
                          CaseList* lists) {
  const D32 d;
  constexpr size_t kLanes32 = hn::MaxLanes(D32());
  const V32 index_bits = hn::Set(d, ~Patch::kFlip), short_slot = hn::Set(d, Patch::kShort);
  for (int i = 0; i < 3; ++i) lists[i].count = 0;
  const PatchTriangles& from = patch.triangles;
  for (size_t t = begin; t < end; t += kLanes32) {
    const M32 valid = hn::FirstN(d, end - t);
    V32 v[3], e[3], s[3];
    M32 split[3];
    for (int k = 0; k < 3; ++k) {
      v[k] = hn::LoadU(d, &from.corner[k][t]);
      e[k] = hn::IfThenElseZero(valid, hn::LoadU(d, &from.edge[k][t]));
      const V32 index = hn::And(e[k], index_bits);
      s[k] = Gather(patch.edge_slot.data(), index);
      split[k] = hn::And(valid, hn::Ne(s[k], short_slot));
    }
    const M32 any = hn::Or(split[0], hn::Or(split[1], split[2]));
    const M32 leaf = hn::AndNot(any, valid);
    const Compactor leaf_front(leaf);
    for (int k = 0; k < 3; ++k) hn::StoreU(leaf_front(v[k]), d, &patch.leaf[k][patch.leaf_count]);
    patch.leaf_count += hn::CountTrue(d, leaf);

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

// N triangles of one case on their way to children.
class Expander {
 public:
  Expander(const SurfaceRules& rules, Patch& patch)
      : rules_(rules),
        patch_(patch),
        edge_a_(patch.edge_a.data()),
        edge_b_(patch.edge_b.data()),
        edge_length2_(patch.edge_length2.data()),
        edges_(patch.edge_count),
        triangles_(patch.next.count) {
    for (int k = 0; k < 3; ++k) {
      corner_[k] = patch.next.corner[k].data();
      edge_[k] = patch.next.edge[k].data();
    }
    along_ = hn::Set(DN(), static_cast<uint32_t>(patch.halves[0]));
    against_ = hn::Set(DN(), static_cast<uint32_t>(patch.halves[1]));
    midpoints_ = hn::Set(DN(), static_cast<uint32_t>(patch.midpoints));
  }
  // What was appended.
  void Finish() {
    patch_.edge_count = edges_;
    patch_.next.count = triangles_;
  }

  void One(const CaseList& list) {
    for (size_t i = 0; i < list.count; i += kLanes) {
      Load(list, i, 1);
      const VF median = Median(length_[1], length_[2], length_[0]);
      const VN inner = AddEdge(m_[0], v_[2], median);
      AddTriangle(v_[0], m_[0], v_[2], First(0), inner, e_[2]);
      AddTriangle(m_[0], v_[1], v_[2], Second(0), e_[1], Back(inner));
    }
  }

  void Two(const CaseList& list) {
    for (size_t i = 0; i < list.count; i += kLanes) {
      Load(list, i, 2);
      const MF first_longer = FirstLonger();
      const hn::Mask<DN> first = Narrow(first_longer);
      const VF cut2 = length_[2] * hn::Set(DF(), .25);
      const VF diagonal2 = hn::IfThenElse(first_longer, Median(length_[1], length_[2], length_[0]),
                                          Median(length_[0], length_[2], length_[1]));
      const VN cut = AddEdge(m_[0], m_[1], cut2);
      const VN from = hn::IfThenElse(first, m_[0], v_[0]);
      const VN to = hn::IfThenElse(first, v_[2], m_[1]);
      const VN diagonal = AddEdge(from, to, diagonal2);
      const VN first0 = First(0), second1 = Second(1);
      AddTriangle(m_[0], v_[1], m_[1], Second(0), First(1), Back(cut));
      AddTriangle(from, hn::IfThenElse(first, m_[1], m_[0]), to, hn::IfThenElse(first, cut, first0),
                  hn::IfThenElse(first, second1, cut), Back(diagonal));
      AddTriangle(v_[0], hn::IfThenElse(first, m_[0], m_[1]), v_[2],
                  hn::IfThenElse(first, first0, diagonal), hn::IfThenElse(first, diagonal, second1),
                  e_[2]);
    }
  }

  void Three(const CaseList& list) {
    const VF quarter = hn::Set(DF(), .25);
    for (size_t i = 0; i < list.count; i += kLanes) {
      Load(list, i, 3);
      const VN p0 = AddEdge(m_[0], m_[1], length_[2] * quarter);
      const VN p1 = AddEdge(m_[1], m_[2], length_[0] * quarter);
      const VN p2 = AddEdge(m_[2], m_[0], length_[1] * quarter);
      AddTriangle(v_[0], m_[0], m_[2], First(0), Back(p2), Second(2));
      AddTriangle(m_[0], v_[1], m_[1], Second(0), First(1), Back(p0));
      AddTriangle(m_[2], m_[1], v_[2], Back(p1), Second(1), First(2));
      AddTriangle(m_[0], m_[1], m_[2], p0, p1, p2);
    }
  }

 private:
  void Load(const CaseList& list, size_t i, int long_edges) {
    const DN dn;
    lanes_ = list.count - i < kLanes ? list.count - i : kLanes;
    const hn::Mask<DN> valid = hn::FirstN(dn, lanes_);
    for (int k = 0; k < 3; ++k) {
      v_[k] = hn::IfThenElseZero(valid, hn::LoadU(dn, &list.corner[k][i]));
      e_[k] = hn::IfThenElseZero(valid, hn::LoadU(dn, &list.edge[k][i]));
      flip_[k] = hn::And(e_[k], hn::Set(dn, Patch::kFlip));
      index_[k] = hn::AndNot(flip_[k], e_[k]);
      length_[k] = hn::Abs(Gather(edge_length2_, index_[k]));
      if (k < long_edges) {
        slot_[k] = hn::IfThenElseZero(valid, hn::LoadU(dn, &list.slot[k][i]));
        m_[k] = slot_[k] + midpoints_;
      }
    }
    if (rules_.sites) site_ = hn::LoadU(dn, &list.site[i]);
  }

  static hn::Mask<DN> Narrow(MF mask) {
    const DU du;
    const VU bits = hn::BitCast(du, hn::VecFromMask(DF(), mask));
    return hn::Ne(hn::TruncateTo(DN(), bits), hn::Zero(DN()));
  }

  static VN Back(VN edge) { return hn::Xor(edge, hn::Set(DN(), Patch::kFlip)); }

  // The halves of long edge k as the triangle runs along them.
  VN First(int k) const { return Half(k, along_, against_); }
  VN Second(int k) const { return Half(k, against_, along_); }
  VN Half(int k, VN along, VN against) const {
    const hn::Mask<DN> flipped = hn::Ne(flip_[k], hn::Zero(DN()));
    return hn::Or(slot_[k] + hn::IfThenElse(flipped, against, along), flip_[k]);
  }

  // Squared median to the middle of side c of a triangle with squared sides a, b, c.
  static VF Median(VF a2, VF b2, VF c2) {
    const DF d;
    const VF sum = a2 + b2;
    const VF median2 = ((sum + sum) - c2) * hn::Set(d, .25);
    return hn::IfThenElseZero(hn::Gt(median2, hn::Zero(d)), median2);
  }

  // Edge 0 longer than edge 1, or equal with the smaller sum of identities.
  MF FirstLonger() const {
    const DF d;
    const bool current = rules_.current();
    const VF a = current ? Gather(patch_.edge_current2.data(), index_[0]) : length_[0];
    const VF b = current ? Gather(patch_.edge_current2.data(), index_[1]) : length_[1];
    const MF longer = hn::Gt(a, b);
    const MF equal = hn::Eq(a, b);
    if (hn::AllFalse(d, equal)) return longer;
    HWY_ALIGN uint32_t corner[3][kLanes];
    HWY_ALIGN uint64_t smaller[kLanes];
    for (int k = 0; k < 3; ++k) hn::Store(v_[k], DN(), corner[k]);
    for (size_t i = 0; i < kLanes; ++i) {
      const uint64_t middle = patch_.vertex[corner[1][i]].id;
      const uint64_t first = patch_.vertex[corner[0][i]].id + middle;
      const uint64_t second = middle + patch_.vertex[corner[2][i]].id;
      smaller[i] = first < second ? ~uint64_t{0} : 0;
    }
    const MF sums = hn::MaskFromVec(hn::BitCast(d, hn::Load(DU(), smaller)));
    return hn::Or(longer, hn::And(equal, sums));
  }

  VN AddEdge(VN a, VN b, VF length2) {
    const DN dn;
    const size_t at = edges_;
    hn::StoreU(a, dn, edge_a_ + at);
    hn::StoreU(b, dn, edge_b_ + at);
    if (!rules_.current()) {
      const VF zero = hn::Zero(DF());
      const bool far = ByDistance(rules_);
      length2 = Flagged(rules_, length2, far ? Distance2(a) : zero, far ? Distance2(b) : zero);
    }
    hn::StoreU(length2, DF(), edge_length2_ + at);
    if (rules_.sites) hn::StoreU(site_, dn, &patch_.edge_site[at]);
    edges_ += lanes_;
    return hn::Iota(dn, static_cast<uint32_t>(at));
  }

  VF Distance2(VN index) const {
    // A vertex is 16 floats.
    const float* floats = &patch_.vertex[0].eye_distance2;
    return hn::PromoteTo(DF(), Gather(floats, hn::ShiftLeft<4>(index)));
  }

  // Runs of lanes_ entries, ascending: what is written beyond a run belongs to the next one.
  void AddTriangle(VN a, VN b, VN c, VN ab, VN bc, VN ca) {
    const DN dn;
    const VN corners[3] = {a, b, c};
    const VN edges[3] = {ab, bc, ca};
    for (int k = 0; k < 3; ++k) {
      hn::StoreU(corners[k], dn, corner_[k] + triangles_);
      hn::StoreU(edges[k], dn, edge_[k] + triangles_);
    }
    if (rules_.sites) hn::StoreU(site_, dn, &patch_.next.site[triangles_]);
    triangles_ += lanes_;
  }

  const SurfaceRules& rules_;
  Patch& patch_;
  uint32_t* edge_a_;
  uint32_t* edge_b_;
  double* edge_length2_;
  uint32_t* corner_[3];
  uint32_t* edge_[3];
  size_t edges_;
  size_t triangles_;
  VN along_, against_, midpoints_;
  size_t lanes_ = 0;
  VN v_[3], e_[3], flip_[3], index_[3], slot_[3], m_[3], site_;
  VF length_[3];
};

void SplitTrianglesLanes(const SurfaceRules& rules, Patch& patch) {
  CaseList lists[3];
  Expander expander(rules, patch);
  for (size_t begin = 0; begin < patch.triangles.count; begin += kBlock) {
    const size_t left = patch.triangles.count - begin;
    SortBlock(rules, patch, begin, begin + (left < kBlock ? left : kBlock), lists);
    expander.One(lists[0]);
    expander.Two(lists[1]);
    expander.Three(lists[2]);
  }
  expander.Finish();
}

// The lanes that are long of edges i..: the sign is in a double's upper word.
HWY_INLINE M32 LongLanes(const double* length2) {
  const D32 d;
#if HWY_TARGET == HWY_SCALAR
  return hn::Eq(hn::Set(d, PatchIsShort(*length2) ? 1 : 0), hn::Zero(d));
#else
  constexpr bool kLittle = std::endian::native == std::endian::little;
  const V32 low = hn::BitCast(d, hn::LoadU(DF(), length2));
  const V32 high = hn::BitCast(d, hn::LoadU(DF(), length2 + hn::MaxLanes(D32()) / 2));
  const V32 word = kLittle ? hn::ConcatOdd(d, high, low) : hn::ConcatEven(d, high, low);
  return hn::Lt(word, hn::Set(d, 0x80000000u));
#endif
}

void CollectLongEdgesLanes(Patch& patch, bool keep_numbers) {
  const D32 d;
  constexpr size_t kLanes32 = hn::MaxLanes(D32());
  const size_t begin = patch.run_begin, end = patch.edge_count;
  double* length2 = patch.edge_length2.data();
  const uint32_t* edge_a = patch.edge_a.data();
  const uint32_t* edge_b = patch.edge_b.data();
  uint32_t* slot = patch.edge_slot.data();
  uint32_t* list = patch.long_edge.data();
  uint32_t* list_a = patch.long_a.data();
  uint32_t* list_b = patch.long_b.data();
  double* list_length2 = patch.long_length2.data();
  for (size_t i = 0; i < kLanes32; ++i) length2[end + i] = -1;
  const V32 none = hn::Set(d, Patch::kShort);
  size_t n = 0;
  for (size_t i = begin; i < end; i += kLanes32) {
    const M32 is_long = LongLanes(length2 + i);
    const Compactor front(is_long);
    const V32 places = front.Ranks() + hn::Set(d, static_cast<uint32_t>(n));
    hn::StoreU(hn::IfThenElse(is_long, places, none), d, slot + i);
    hn::StoreU(front(hn::LoadU(d, edge_a + i)), d, list_a + n);
    hn::StoreU(front(hn::LoadU(d, edge_b + i)), d, list_b + n);
    if (keep_numbers) {
      hn::StoreU(front(hn::Iota(d, static_cast<uint32_t>(i))), d, list + n);
    }
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
    const __mmask16 bits = is_long.raw;
    const auto low = static_cast<__mmask8>(bits), high = static_cast<__mmask8>(bits >> 8);
    const size_t low_count = static_cast<size_t>(__builtin_popcount(low));
    _mm512_storeu_pd(list_length2 + n, _mm512_maskz_compress_pd(low, _mm512_loadu_pd(length2 + i)));
    _mm512_storeu_pd(list_length2 + n + low_count,
                     _mm512_maskz_compress_pd(high, _mm512_loadu_pd(length2 + i + 8)));
    n += low_count + static_cast<size_t>(__builtin_popcount(high));
#else
    for (size_t k = 0, at = n; k < kLanes32; ++k) {
      list_length2[at] = length2[i + k];
      at += PatchIsShort(length2[i + k]) ? 0 : 1;
    }
    n += hn::CountTrue(d, is_long);
#endif
  }
  // Whole vectors may be read.
  hn::StoreU(hn::Zero(d), d, list_a + n);
  hn::StoreU(hn::Zero(d), d, list_b + n);
  hn::StoreU(hn::Set(DF(), 1.0), DF(), list_length2 + n);
  patch.long_count = n;
}

void InterleaveLeavesLanes(Patch& patch) {
  const D32 d;
  constexpr size_t kLanes32 = hn::MaxLanes(D32());
  for (size_t i = 0; i < patch.leaf_count; i += kLanes32) {
    hn::StoreInterleaved3(hn::LoadU(d, &patch.leaf[0][i]), hn::LoadU(d, &patch.leaf[1][i]),
                          hn::LoadU(d, &patch.leaf[2][i]), d, patch.leaf_triangles[i].data());
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fjord {

HWY_EXPORT(SplitTrianglesLanes);
HWY_EXPORT(CollectLongEdgesLanes);
HWY_EXPORT(InterleaveLeavesLanes);

void SplitTriangles(const SurfaceRules& rules, Patch& patch) {
  HWY_DYNAMIC_DISPATCH(SplitTrianglesLanes)(rules, patch);
}

void CollectLongEdges(Patch& patch, bool keep_numbers) {
  HWY_DYNAMIC_DISPATCH(CollectLongEdgesLanes)(patch, keep_numbers);
}

void InterleaveLeaves(Patch& patch) { HWY_DYNAMIC_DISPATCH(InterleaveLeavesLanes)(patch); }

}  // namespace fjord
#endif
