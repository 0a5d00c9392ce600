// Triangles by how many long edges they have (S21), N in lock-step: sorted first, so that no lane
// waits for another case.
//
// Templates, corners 0 1 2 turned so that the long edges come first, m_k the midpoint of edge k:
//   one     (0 m0 2) (m0 1 2)
//   two     (m0 1 m1), and of the rest the diagonal from the midpoint of the longer edge; equal
//           edges: from the one with the smaller sum of identities
//   three   (0 m0 m2) (m0 1 m1) (m2 m1 2) (m0 m1 m2)
#include "engine/fractal/patch.h"

// The order matters.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/fractal/patch_triangles.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep

#include "hwy/highway.h"
#include "engine/fractal/patch_lanes-inl.h"
#include "engine/fractal/patch_sort-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {

constexpr size_t kLanes = hn::MaxLanes(DF());

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
      const VF from = far ? Distance2(a) : zero, to = far ? Distance2(b) : zero;
      length2 = rules_.staged() ? Flagged<true>(rules_, length2, from, to)
                                : Flagged<false>(rules_, length2, from, to);
    }
    hn::StoreU(length2, DF(), edge_length2_ + at);
    if (rules_.sites) hn::StoreU(site_, dn, &patch_.edge_site[at]);
    edges_ += lanes_;
    return hn::Iota(dn, static_cast<uint32_t>(at));
  }

  VF Distance2(VN index) const {
    if (rules_.staged()) return Gather(patch_.distance2.data(), index);
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
  CaseList lists[5];
  Expander expander(rules, patch);
  for (size_t begin = 0; begin < patch.triangles.count; begin += kBlock) {
    const size_t left = patch.triangles.count - begin;
    SortBlock(rules, patch, begin, begin + (left < kBlock ? left : kBlock), lists);
    expander.One(lists[0]);
    expander.Two(lists[1]);
    expander.Three(lists[2]);
    if (rules.staged()) expander.Keep(lists[kWaiting]);
  }
  expander.Finish();
}

}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fjord {

HWY_EXPORT(SplitTrianglesLanes);

void SplitTriangles(const SurfaceRules& rules, Patch& patch) {
  HWY_DYNAMIC_DISPATCH(SplitTrianglesLanes)(rules, patch);
}

}  // namespace fjord
#endif
