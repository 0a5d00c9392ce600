// N triangles of one case on their way to children: their corners, edges and lengths, and what the
// triangles share with new edges (shares.h). Compiled once per SIMD target.

#if defined(FJORD_ENGINE_FRACTAL_PATCH_CASE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FJORD_ENGINE_FRACTAL_PATCH_CASE_INL_H_
#undef FJORD_ENGINE_FRACTAL_PATCH_CASE_INL_H_
#else
#define FJORD_ENGINE_FRACTAL_PATCH_CASE_INL_H_
#endif

#include "engine/fractal/patch_shares-inl.h"
#include "engine/fractal/patch_sort-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {

constexpr size_t kLanes = hn::MaxLanes(DF());

// N triangles of one case, and what their edges say: which is the longest, what is shared.
class TriangleLanes {
 protected:
  TriangleLanes(const SurfaceRules& rules, Patch& patch)
      : rules_(rules),
        patch_(patch),
        edge_length2_(patch.edges.length2.data()),
        midpoints_(hn::Set(DN(), static_cast<uint32_t>(patch.long_edges.midpoints))) {}

  // Shares on the left and on the right of a new edge.
  struct Shares {
    VU left, right;
  };

  HWY_INLINE void Load(const CaseList& list, size_t i, int long_edges) {
    const DN dn;
    lanes_ = list.count - i < kLanes ? list.count - i : kLanes;
    const hn::Mask<DN> valid = FirstLanes(dn, lanes_);
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
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
    return hn::Mask<DN>{mask.raw};
#else
    const DU du;
    const VU bits = hn::BitCast(du, hn::VecFromMask(DF(), mask));
    return hn::Ne(hn::TruncateTo(DN(), bits), hn::Zero(DN()));
#endif
  }

  static VN Back(VN edge) { return hn::Xor(edge, hn::Set(DN(), Patch::kFlip)); }

  // Squared median to the middle of side c of a triangle with squared sides a, b, c.
  static VF Median(VF a2, VF b2, VF c2) {
    const DF d;
    const VF sum = a2 + b2;
    const VF median2 = ((sum + sum) - c2) * hn::Set(d, .25);
    return hn::IfThenElseZero(hn::Gt(median2, hn::Zero(d)), median2);
  }

  // The share of the triangles as their edge k knows it.
  VU Inside(int k) const {
    return Gather(patch_.edges.shares.data(),
                  hn::Or(hn::ShiftLeft<1>(e_[k]), hn::ShiftRight<31>(e_[k])));
  }

  // What a triangle's new edges need to know of it.
  struct Sharing {
    VU share;    // as its longest long edge has it
    VU role[3];  // of its edges, counted from that
    hn::Mask<DU> right;
  };

  // The role after this one.
  static VU NextRole(VU role) {
    const DU du;
    return hn::And(hn::Shr(hn::Set(du, uint64_t{1u | 2u << 2}), role + role),
                   hn::Set(du, kShareRole));
  }

  // Not turned as triangles of three long edges are, but with the same outcome: an edge that both
  // make is the same edge. `share0`: the key as edge 0 has it, a long edge.
  Sharing Known(VU share0) const {
    return Known(share0, share0, hn::MaskFromVec(hn::Set(DU(), ~uint64_t{0})));
  }
  // The key as the longer of two long edges has it: edge 0 where `first`, otherwise edge 1.
  Sharing Known(VU share0, VU share1, hn::Mask<DU> first) const {
    const DU du;
    const VU two = hn::Set(du, uint64_t{2}), one = hn::Set(du, uint64_t{1});
    MF is0, is1;
    Sharing known;
    known.right = hn::RebindMask(du, Longest(is0, is1));
    known.share = hn::IfThenElse(first, share0, share1);
    const VU its = hn::And(known.share, hn::Set(du, kShareRole));
    const VU counted = hn::IfThenElse(hn::RebindMask(du, is0), two,
                                      hn::IfThenElseZero(hn::RebindMask(du, is1), one));
    const VU kept = hn::IfThenElse(first, its, NextRole(NextRole(its)));
    known.role[0] = hn::IfThenElse(known.right, counted, kept);
    known.role[1] = NextRole(known.role[0]);
    known.role[2] = NextRole(known.role[1]);
    return known;
  }

  // From the middle of edge 0 to that of edge 1.
  Shares CutShares(const Sharing& known) const {
    const DU du;
    const auto number = [&](uint64_t n) { return hn::Set(du, n); };
    const auto by_role = [&](uint64_t table) {
      return hn::And(hn::Shr(number(table), known.role[2] + known.role[2]), number(3));
    };
    const auto one = [&](VU right_child, VU right_role, VU child) {
      const VU key = ChildShare(known.share, hn::IfThenElse(known.right, right_child, child));
      const VU role = hn::IfThenElse(known.right, right_role, known.role[2]);
      return hn::Or(hn::Or(key, role), hn::IfThenElseZero(known.right, number(kShareRight)));
    };
    return {one(by_role(2u | 1u << 2 | 3u << 4), by_role(1u | 0u << 2 | 2u << 4), number(3)),
            one(by_role(3u | 0u << 2 | 1u << 4), by_role(0u | 1u << 2 | 2u << 4), known.role[1])};
  }

  // From the middle of edge k to the corner opposite.
  Shares MedianShares(const Sharing& known, int k) const {
    const DU du;
    const VU two = hn::Set(du, uint64_t{2});
    const hn::Mask<DU> inner = hn::And(known.right, hn::Eq(known.role[k], two));
    const VU flags = hn::Set(du, kShareRight | 2);
    return {hn::IfThenElse(inner, hn::Or(ChildShare(known.share, 2), flags),
                           ChildShare(known.share, 4)),
            hn::IfThenElse(inner, hn::Or(ChildShare(known.share, 1), flags),
                           ChildShare(known.share, 5))};
  }

  // Which of edges 0 and 1 is the longest, if not edge 2; where the right template is the
  // triangle's.
  HWY_INLINE MF Longest(MF& is_longest0, MF& is_longest1) const {
    const DF d;
    VF size2[3];
    for (int k = 0; k < 3; ++k) {
      size2[k] = rules_.current() ? Gather(patch_.edges.current2.data(), index_[k]) : length_[k];
    }
    const VF most = Larger(size2[0], Larger(size2[1], size2[2]));
    const MF is0 = hn::Eq(size2[0], most), is1 = hn::Eq(size2[1], most),
             is2 = hn::Eq(size2[2], most);
    is_longest0 = is0;
    is_longest1 = is1;
    const MF tied = hn::Or(hn::And(is0, hn::Or(is1, is2)), hn::And(is1, is2));
    if (!hn::AllFalse(d, tied)) LongestOfTied(is0, is1, is2, is_longest0, is_longest1);
    const VF one2 = hn::IfThenElse(is_longest0, size2[1], size2[0]);
    const VF other2 = hn::IfThenElse(hn::Or(is_longest0, is_longest1), size2[2], size2[1]);
    const VF sum = one2 + other2;
    return hn::Le((sum + sum) - most, most * hn::Set(d, kMostRight));
  }

  // Turns the triangles so that edge 2 is the longest; where the right template is theirs.
  HWY_INLINE MF TurnLongestLast() {
    MF turn1, turn2;
    const MF right = Longest(turn1, turn2);
    if (hn::AllFalse(DF(), hn::Or(turn1, turn2))) return right;
    const hn::Mask<DN> by1 = Narrow(turn1), by2 = Narrow(turn2);
    Turn(by1, by2, v_);
    Turn(by1, by2, e_);
    Turn(by1, by2, slot_);
    Turn(turn1, turn2, length_);
    for (int k = 0; k < 3; ++k) {
      flip_[k] = hn::And(e_[k], hn::Set(DN(), Patch::kFlip));
      index_[k] = hn::AndNot(flip_[k], e_[k]);
      m_[k] = slot_[k] + midpoints_;
    }
    return right;
  }

  // What was 1, 2, 0 becomes 0, 1, 2 by `by1`; what was 2, 0, 1 by `by2`.
  template <typename Mask, typename V>
  static void Turn(Mask by1, Mask by2, V* of) {
    const V was[3] = {of[0], of[1], of[2]};
    for (int k = 0; k < 3; ++k) {
      of[k] = hn::IfThenElse(by1, was[(k + 1) % 3], hn::IfThenElse(by2, was[(k + 2) % 3], was[k]));
    }
  }

  // Of longest edges the one with the smallest sum of its ends' identities.
  HWY_NOINLINE void LongestOfTied(MF is0, MF is1, MF is2, MF& turn1, MF& turn2) const {
    const DF d;
    const DU du;
    HWY_ALIGN uint32_t corner[3][kLanes];
    HWY_ALIGN uint64_t longest[3][kLanes];
    for (int k = 0; k < 3; ++k) hn::Store(v_[k], DN(), corner[k]);
    const MF masks[3] = {is0, is1, is2};
    for (int k = 0; k < 3; ++k) {
      hn::Store(hn::BitCast(du, hn::VecFromMask(d, masks[k])), du, longest[k]);
    }
    for (size_t i = 0; i < kLanes; ++i) {
      int best = -1;
      uint64_t least = 0;
      for (int k = 0; k < 3; ++k) {
        if (longest[k][i] == 0) continue;
        const uint64_t sum = patch_.vertices.value[corner[k][i]].id +
                             patch_.vertices.value[corner[(k + 1) % 3][i]].id;
        if (best < 0 || sum < least) {
          best = k;
          least = sum;
        }
      }
      for (int k = 0; k < 3; ++k) longest[k][i] = k == best ? ~uint64_t{0} : 0;
    }
    turn1 = hn::MaskFromVec(hn::BitCast(d, hn::Load(du, longest[0])));
    turn2 = hn::MaskFromVec(hn::BitCast(d, hn::Load(du, longest[1])));
  }

  // Edge 0 longer than edge 1, or equal with the smaller sum of identities.
  MF FirstLonger() const {
    const DF d;
    const bool current = rules_.current();
    const VF a = current ? Gather(patch_.edges.current2.data(), index_[0]) : length_[0];
    const VF b = current ? Gather(patch_.edges.current2.data(), index_[1]) : length_[1];
    const MF longer = hn::Gt(a, b);
    const MF equal = hn::Eq(a, b);
    if (hn::AllFalse(d, equal)) return longer;
    HWY_ALIGN uint32_t corner[3][kLanes];
    HWY_ALIGN uint64_t smaller[kLanes];
    for (int k = 0; k < 3; ++k) hn::Store(v_[k], DN(), corner[k]);
    for (size_t i = 0; i < kLanes; ++i) {
      const uint64_t middle = patch_.vertices.value[corner[1][i]].id;
      const uint64_t first = patch_.vertices.value[corner[0][i]].id + middle;
      const uint64_t second = middle + patch_.vertices.value[corner[2][i]].id;
      smaller[i] = first < second ? ~uint64_t{0} : 0;
    }
    const MF sums = hn::MaskFromVec(hn::BitCast(d, hn::Load(DU(), smaller)));
    return hn::Or(longer, hn::And(equal, sums));
  }

  const SurfaceRules& rules_;
  Patch& patch_;
  const double* edge_length2_;
  VN midpoints_;
  size_t lanes_ = 0;
  VN v_[3], e_[3], flip_[3], index_[3], slot_[3], m_[3], site_;
  VF length_[3];
};

}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
