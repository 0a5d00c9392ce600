// How far the affine law moves the midpoints of long edges, N edges in lock-step.
#include "engine/fractal/patch.h"

// The order matters.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/fractal/patch_amounts.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep

#include "hwy/highway.h"
#include "engine/base/exact_math-inl.h"
#include "engine/fractal/stream_lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {

// Few lengths are different where triangles are halved into similar ones: those that were met last,
// with what was made of them. A pass over edges that are all different does without after a while.
class AmountMemo {
 public:
  // False: lanes are left that were not met.
  HWY_INLINE bool Find(VF length2, VF& amount) const {
    const DF d;
    amount = hn::Zero(d);
    MF known = hn::Gt(amount, amount);
    for (size_t i = 0; i < kSize; ++i) {
      const MF same = hn::Eq(length2, hn::Set(d, length2_[i]));
      amount = hn::IfThenElse(same, hn::Set(d, amount_[i]), amount);
      known = hn::Or(known, same);
    }
    return hn::AllTrue(d, known);
  }
  void Keep(VF length2, VF amount) {
    const DF d;
    constexpr size_t kLanes = hn::MaxLanes(DF());
    HWY_ALIGN double lengths[kLanes];
    HWY_ALIGN double amounts[kLanes];
    hn::Store(length2, d, lengths);
    hn::Store(amount, d, amounts);
    for (size_t i = 0; i < kLanes; ++i) {
      bool known = false;
      for (size_t k = 0; k < kSize; ++k) known |= length2_[k] == lengths[i];
      if (known) continue;
      length2_[next_] = lengths[i];
      amount_[next_] = amounts[i];
      next_ = (next_ + 1) % kSize;
    }
    ++misses_;
  }
  bool helps(size_t asked) const { return 2 * misses_ < asked + 16; }

 private:
  static constexpr size_t kSize = 8;
  double length2_[kSize] = {-1, -1, -1, -1, -1, -1, -1, -1};
  double amount_[kSize] = {};
  size_t next_ = 0;
  size_t misses_ = 0;
};

// Affine amounts of the long edges: a pass of its own, because the power is one long chain of
// operations, of which several must be under way at a time.
void MeasureAmountsLanes(const SurfaceRules& rules, Patch& patch) {
  const DF d;
  constexpr size_t kLanes = hn::MaxLanes(DF());
  const VF power = hn::Set(d, rules.half_H), scale = hn::Set(d, rules.affine_scale);
  const size_t n = patch.long_edges.count;
  const double* length2 = patch.long_edges.length2.data();
  double* amount = patch.long_edges.amount.data();
  const auto measure = [&](VF rest2) {
    // Nothing below is split but by other lengths than these.
    const MF normal = hn::Ge(rest2, hn::Set(d, 0x1p-1022));
    return scale * hn::IfThenElseZero(normal, PowOfNormal(d, rest2, power));
  };
  AmountMemo memo;
  size_t k = 0;
  for (; k < n && memo.helps(k / kLanes); k += kLanes) {
    const VF rest2 = hn::LoadU(d, length2 + k);
    VF found;
    if (!memo.Find(rest2, found)) {
      found = measure(rest2);
      memo.Keep(rest2, found);
    }
    hn::StoreU(found, d, amount + k);
  }
  for (; k < n; k += kLanes) hn::StoreU(measure(hn::LoadU(d, length2 + k)), d, amount + k);
}

}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fjord {

HWY_EXPORT(MeasureAmountsLanes);

void MeasureAmounts(const SurfaceRules& rules, Patch& patch) {
  HWY_DYNAMIC_DISPATCH(MeasureAmountsLanes)(rules, patch);
}

}  // namespace fjord
#endif
