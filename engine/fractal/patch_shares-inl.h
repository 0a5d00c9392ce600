// Keys and draws that triangles share with their edges' midpoints (shares.h), N in lock-step.
// Compiled once per SIMD target.

#if defined(FJORD_ENGINE_FRACTAL_PATCH_SHARES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FJORD_ENGINE_FRACTAL_PATCH_SHARES_INL_H_
#undef FJORD_ENGINE_FRACTAL_PATCH_SHARES_INL_H_
#else
#define FJORD_ENGINE_FRACTAL_PATCH_SHARES_INL_H_
#endif

#include "engine/fractal/patch_moves-inl.h"
#include "engine/fractal/shares.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {

// Shares of short edges are not made, and nothing reads them: most edges are of the last level.
HWY_INLINE bool AnyLong(VF length2) {
  const DI d;
  return !hn::AllTrue(d, hn::Lt(hn::BitCast(d, length2), hn::Zero(d)));
}

// The key of a child, flags 0. `child`: 0..3 by lane.
HWY_INLINE VU ChildShare(VU key, VU child) {
  const DU du;
  const VU zero = hn::Zero(du), one = hn::Set(du, uint64_t{1}), flags = hn::Set(du, kShareFlags);
  const VU odd = zero - hn::And(child, one), upper = zero - hn::ShiftRight<1>(child);
  const VU step =
      hn::And(odd, hn::Set(du, kShareStep)) + hn::And(upper, hn::Set(du, 2 * kShareStep));
  return hn::AndNot(flags, MixLanes((hn::AndNot(flags, key) + hn::Set(du, kShareStep)) + step));
}

// The same for one child in all lanes, which may be any number.
HWY_INLINE VU ChildShare(VU key, uint64_t child) {
  const DU du;
  const VU flags = hn::Set(du, kShareFlags);
  const VU step = hn::Set(du, (child + 1) * kShareStep);
  return hn::AndNot(flags, MixLanes(hn::AndNot(flags, key) + step));
}

// The key along the first or second half of an edge, as the key's triangle runs along it.
HWY_INLINE VU HalfShare(VU key, bool second) {
  const DU du;
  const VU table = hn::Set(du, second ? ShareHalves() >> 32 : ShareHalves() & 0xffffffffu);
  const VU place = hn::ShiftLeft<2>(hn::And(key, hn::Set(du, kShareFlags)));
  const VU entry = hn::Shr(table, place);
  const VU three = hn::Set(du, kShareRole);
  const VU role = hn::And(hn::ShiftRight<2>(entry), three);
  const VU right = hn::And(key, hn::Set(du, kShareRight));
  return hn::Or(ChildShare(key, hn::And(entry, three)), hn::Or(role, right));
}

// A Gaussian of rules.uniforms, half of them of each key; an odd one is of the midpoint's identity.
// The same for keys in either order.
HWY_INLINE VF SharedGaussianLanes(const SurfaceRules& rules, VU left, VU right, VU id) {
  const DF d;
  const DU du;
  const VU low = hn::Set(du, uint64_t{0xffffffffu});
  const VU pieces = hn::Set(du, uint64_t{0x0000ffff0000ffffu});
  const VU flags = hn::Set(du, kShareFlags);
  VU sum = hn::Zero(du);
  VU bits[2] = {left, right};
  const uint32_t each = rules.uniforms / 2;
  for (uint32_t channel = 0; channel * 2 < each; ++channel) {
    if (channel > 0) {
      const VU step = hn::Set(du, (channel + 15) * kShareStep);
      bits[0] = MixLanes(hn::Or(left, flags) + step);
      bits[1] = MixLanes(hn::Or(right, flags) + step);
    }
    const VU both = hn::Or(hn::ShiftRight<32>(bits[0]), hn::AndNot(low, bits[1]));
    VU halves = hn::And(both, pieces);
    if (each - channel * 2 > 1) halves = halves + hn::And(hn::ShiftRight<16>(both), pieces);
    sum = sum + hn::And(halves + hn::ShiftRight<32>(halves), low);
  }
  if (rules.uniforms % 2 == 1) sum = sum + hn::And(id, hn::Set(du, uint64_t{0xffff}));
  return (WholeLanes(sum + sum) - hn::Set(d, rules.gaussian_middle)) *
         hn::Set(d, rules.gaussian_scale);
}

}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
