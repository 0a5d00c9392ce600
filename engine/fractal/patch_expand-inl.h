// Triangles on their way to children by the templates of S21, N of one case in lock-step. Compiled
// once per SIMD target.
//
// Templates, corners 0 1 2 turned so that the long edges come first, m_k the midpoint of edge k:
//   one     (0 m0 2) (m0 1 2)
//   two     (m0 1 m1), and of the rest the diagonal from the midpoint of the longer edge; equal
//           edges: from the one with the smaller sum of identities
//   three   (0 m0 m2) (m0 1 m1) (m2 m1 2) (m0 m1 m2)
// EVEN turns a triangle of three long edges so that edge 2 is the longest (equal: the one with the
// smallest sum of identities); where the line from m2 to corner 1 is hardly longer than that from
// m0 to m1, it is taken instead: a right triangle becomes four right triangles, and diagonals
// alternate.

#if defined(FJORD_ENGINE_FRACTAL_PATCH_EXPAND_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FJORD_ENGINE_FRACTAL_PATCH_EXPAND_INL_H_
#undef FJORD_ENGINE_FRACTAL_PATCH_EXPAND_INL_H_
#else
#define FJORD_ENGINE_FRACTAL_PATCH_EXPAND_INL_H_
#endif

#include <cstring>

#include "engine/fractal/patch_case-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {

// N triangles of one case on their way to children.
class Expander : private TriangleLanes {
 public:
  Expander(const SurfaceRules& rules, Patch& patch)
      : TriangleLanes(rules, patch),
        edge_a_(patch.edges.a.data()),
        edge_b_(patch.edges.b.data()),
        length2_(patch.edges.length2.data()),
        edges_(patch.edges.count),
        triangles_(patch.next.count) {
    for (int k = 0; k < 3; ++k) {
      corner_[k] = patch.next.corner[k].data();
      edge_[k] = patch.next.edge[k].data();
    }
    along_ = hn::Set(DN(), static_cast<uint32_t>(patch.long_edges.halves[0]));
    against_ = hn::Set(DN(), static_cast<uint32_t>(patch.long_edges.halves[1]));
  }
  // What was appended.
  void Finish() {
    patch_.edges.count = edges_;
    patch_.next.count = triangles_;
  }

  void One(const CaseList& list) {
    for (size_t i = 0; i < list.count; i += kLanes) {
      Load(list, i, 1);
      const VF median = Median(length_[1], length_[2], length_[0]);
      const VN inner = AddEdge(m_[0], v_[2], median);
      if (TakeLong()) StoreShares(inner, MedianShares(Known(Inside(0)), 0));
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
      if (TakeLong()) {
        const hn::Mask<DU> wide = hn::RebindMask(DU(), first_longer);
        const Sharing known = Known(Inside(0), Inside(1), wide);
        StoreShares(cut, CutShares(known));
        const Shares of0 = MedianShares(known, 0), of1 = MedianShares(known, 1);
        StoreShares(diagonal, {hn::IfThenElse(wide, of0.left, of1.right),
                               hn::IfThenElse(wide, of0.right, of1.left)});
      }
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
    if (rules_.even) return EvenThree(list);
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

  void EvenThree(const CaseList& list) {
    const VF quarter = hn::Set(DF(), .25);
    for (size_t i = 0; i < list.count; i += kLanes) {
      Load(list, i, 3);
      const MF right = TurnLongestLast();
      const hn::Mask<DN> narrow = Narrow(right);
      const VN from = hn::IfThenElse(narrow, m_[2], m_[0]);
      const VN to = hn::IfThenElse(narrow, v_[1], m_[1]);
      const VF inner2 =
          hn::IfThenElse(right, Median(length_[0], length_[1], length_[2]), length_[2] * quarter);
      const VN inner = AddEdge(from, to, inner2);
      const VN p1 = AddEdge(m_[1], m_[2], length_[0] * quarter);
      const VN p2 = AddEdge(m_[2], m_[0], length_[1] * quarter);
      if (TakeLong()) StoreThree(hn::RebindMask(DU(), right), inner, p1, p2);
      const VN first1 = First(1);
      AddTriangle(v_[0], m_[0], m_[2], First(0), Back(p2), Second(2));
      // The longest edge last here too, so that few have to be turned at the next level.
      const VN second0 = Second(0);
      AddTriangle(hn::IfThenElse(narrow, m_[2], m_[0]), hn::IfThenElse(narrow, m_[0], v_[1]),
                  hn::IfThenElse(narrow, v_[1], m_[1]), hn::IfThenElse(narrow, p2, second0),
                  hn::IfThenElse(narrow, second0, first1), Back(inner));
      AddTriangle(m_[2], m_[1], v_[2], Back(p1), Second(1), First(2));
      AddTriangle(to, hn::IfThenElse(narrow, m_[1], m_[2]), from,
                  hn::IfThenElse(narrow, first1, p1), hn::IfThenElse(narrow, p1, p2), inner);
    }
  }

  // Those that wait stay as they are.
  void Keep(const CaseList& list) {
    for (int k = 0; k < 3; ++k) {
      std::memcpy(corner_[k] + triangles_, list.corner[k], list.count * sizeof(uint32_t));
      std::memcpy(edge_[k] + triangles_, list.edge[k], list.count * sizeof(uint32_t));
    }
    if (rules_.sites) {
      std::memcpy(&patch_.next.site[triangles_], list.site, list.count * sizeof(uint32_t));
    }
    triangles_ += list.count;
  }

 private:
  // The halves of long edge k as the triangle runs along them.
  VN First(int k) const { return Half(k, along_, against_); }
  VN Second(int k) const { return Half(k, against_, along_); }
  VN Half(int k, VN along, VN against) const {
    const hn::Mask<DN> flipped = hn::Ne(flip_[k], hn::Zero(DN()));
    return hn::Or(slot_[k] + hn::IfThenElse(flipped, against, along), flip_[k]);
  }

  // Is any edge long that was added since the last question, so that shares are read?
  bool TakeLong() {
    const bool any = any_long_;
    any_long_ = false;
    return any;
  }
  void StoreShares(VN edges, const Shares& shares) {
    const size_t at = hn::GetLane(edges);
    hn::StoreInterleaved2(shares.left, shares.right, DU(), &patch_.edges.shares[2 * at]);
  }

  // Of the inner edges of a triangle with three long ones.
  void StoreThree(hn::Mask<DU> right, VN inner, VN p1, VN p2) {
    const DU du;
    const auto number = [&](uint64_t n) { return hn::Set(du, n); };
    // Roles of the sides as their key has them; the children's keys, in the order of the triangles.
    const VU share = Inside(2);
    const VU right_flag = hn::IfThenElseZero(right, number(kShareRight));
    const VU role2 = hn::And(share, number(kShareRole));
    const VU role0 = NextRole(role2), role1 = NextRole(role0);
    const auto child = [&](uint64_t of_right, VU otherwise) {
      const VU which = hn::IfThenElse(right, number(of_right), otherwise);
      return hn::Or(ChildShare(share, which), right_flag);
    };
    const VU at0 = child(0, role0), at1 = child(1, role1), at2 = child(3, role2),
             middle = child(2, number(3));
    const auto as = [&](VU key, uint64_t of_right, VU otherwise) {
      return hn::Or(key, hn::IfThenElse(right, number(of_right), otherwise));
    };
    StoreShares(inner, {as(middle, 2, role2), as(at1, 2, role2)});
    StoreShares(p1, {as(middle, 1, role0), as(at2, 0, role0)});
    StoreShares(p2, {as(hn::IfThenElse(right, at1, middle), 0, role1), as(at0, 1, role1)});
  }

  HWY_INLINE VN AddEdge(VN a, VN b, VF length2) {
    const DN dn;
    const size_t at = edges_;
    hn::StoreU(a, dn, edge_a_ + at);
    hn::StoreU(b, dn, edge_b_ + at);
    if (!rules_.current()) {
      const VF zero = hn::Zero(DF());
      const bool far = ByDistance(rules_);
      const VF from = far ? Distance2(a) : zero, to = far ? Distance2(b) : zero;
      length2 = rules_.staged() ? Flagged<true>(rules_, length2, from, to)
                                : Flagged<false>(rules_, length2, from, to);
    }
    hn::StoreU(length2, DF(), length2_ + at);
    if (rules_.sites) hn::StoreU(site_, dn, &patch_.edges.site[at]);
    any_long_ |= rules_.even && (rules_.current() || AnyLong(length2));
    edges_ += lanes_;
    return Counting(dn, at);
  }

  VF Distance2(VN index) const {
    if (rules_.staged()) return Gather(patch_.vertices.distance2.data(), index);
    // A vertex is 16 floats.
    const float* floats = &patch_.vertices.value[0].eye_distance2;
    return hn::PromoteTo(DF(), Gather(floats, hn::ShiftLeft<4>(index)));
  }

  // Runs of lanes_ entries, ascending: what is written beyond a run belongs to the next one.
  HWY_INLINE void AddTriangle(VN a, VN b, VN c, VN ab, VN bc, VN ca) {
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

  uint32_t* edge_a_;
  uint32_t* edge_b_;
  double* length2_;
  uint32_t* corner_[3];
  uint32_t* edge_[3];
  size_t edges_;
  size_t triangles_;
  VN along_, against_;
  bool any_long_ = false;
};

}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
