// The split rule on lanes, compiled once per SIMD target (stream_lanes-inl.h).

#if defined(FJORD_ENGINE_FRACTAL_PATCH_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FJORD_ENGINE_FRACTAL_PATCH_LANES_INL_H_
#undef FJORD_ENGINE_FRACTAL_PATCH_LANES_INL_H_
#else
#define FJORD_ENGINE_FRACTAL_PATCH_LANES_INL_H_
#endif

#include <bit>
#include <cstddef>
#include <cstdint>

#include "engine/fractal/patch.h"
#include "engine/fractal/stream_lanes-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {

HWY_INLINE VF Larger(VF a, VF b) { return hn::IfThenElse(hn::Gt(a, b), a, b); }

// The word of two floats: stretch comes first in memory.
template <bool kSecond>
HWY_INLINE VF FloatOf(VF word) {
  const DF d;
  const DU du;
  const VU bits = hn::BitCast(du, word);
  constexpr bool kHigh = kSecond == (std::endian::native == std::endian::little);
  const VU half = kHigh ? hn::ShiftRight<32>(bits) : hn::And(bits, hn::Set(du, 0xffffffffu));
  return hn::PromoteTo(d, hn::BitCast(DS(), hn::TruncateTo(DN(), half)));
}

HWY_INLINE VF FloatsWord(hn::Vec<DS> first, hn::Vec<DS> second) {
  const DF d;
  const DU du;
  const VU a = hn::PromoteTo(du, hn::BitCast(DN(), first));
  const VU b = hn::PromoteTo(du, hn::BitCast(DN(), second));
  constexpr bool kLittle = std::endian::native == std::endian::little;
  return hn::BitCast(d,
                     kLittle ? hn::Or(a, hn::ShiftLeft<32>(b)) : hn::Or(b, hn::ShiftLeft<32>(a)));
}

// Squared distance from the eye to the middle of an edge with these ends.
HWY_INLINE VF MiddleDistance2(VF a, VF b, VF length2) {
  const DF d;
  return (a + b) * hn::Set(d, .5) - length2 * hn::Set(d, .25);
}

// The right side of the split rule (SurfaceRules) at that distance.
HWY_INLINE VF LongSide(const SurfaceRules& rules, VF middle2) {
  const DF d;
  if (rules.eye_radius > 0) {
    const VF distance = hn::Sqrt(hn::IfThenElseZero(hn::Gt(middle2, hn::Zero(d)), middle2)) -
                        hn::Set(d, rules.eye_radius);
    const VF clear = Larger(distance, hn::Set(d, rules.near));
    return hn::Set(d, rules.slope) * (clear * clear);
  }
  return Larger(hn::Set(d, rules.slope) * middle2, hn::Set(d, rules.floor));
}

HWY_INLINE VF WithShortSign(VF length2, MF is_long) {
  const DF d;
  return hn::IfThenElse(is_long, length2, hn::Or(length2, hn::Set(d, -0.0)));
}

// Stages::Length2(Stages::StageOf(length2)), bit for bit; 0 for 0.
HWY_INLINE VF StageLength2(const Stages& stages, VF length2) {
  const DF d;
  const VU even_exponent = hn::Set(DU(), uint64_t{0x7fe0000000000000u});
  const VU bits = hn::BitCast(DU(), length2 * hn::Set(d, stages.twice_inverse2));
  return hn::BitCast(d, hn::And(bits, even_exponent)) * hn::Set(d, stages.half_unit2);
}

// length2 with its sign set where short. Ends' squared eye distances a, b are read by distance
// only. kStaged: SurfaceRules::staged().
template <bool kStaged>
HWY_INLINE VF Flagged(const SurfaceRules& rules, VF length2, VF a, VF b) {
  const DF d;
  const VF size = kStaged ? StageLength2(rules.stages, length2) : length2;
  const VF left = size * hn::Set(d, rules.length_scale);
  return WithShortSign(length2, hn::Gt(left, LongSide(rules, MiddleDistance2(a, b, length2))));
}

HWY_INLINE bool ByDistance(const SurfaceRules& rules) { return rules.slope > 0; }

}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
