// Exact sine, cosine and arc tangent for SIMD lanes: a part of exact_math-inl.h, whose rules hold.

#if defined(FJORD_ENGINE_BASE_EXACT_TRIG_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FJORD_ENGINE_BASE_EXACT_TRIG_INL_H_
#undef FJORD_ENGINE_BASE_EXACT_TRIG_INL_H_
#else
#define FJORD_ENGINE_BASE_EXACT_TRIG_INL_H_
#endif

#include <cstdint>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Adding it to |x| < 2^51 leaves round(x) in the low bits; subtracting it again gives round(x).
inline constexpr double kRoundingShift = 6755399441055744.0;  // 1.5 * 2^52

// Both at once, |x| <= 1e6; larger x: both 0.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void SinCos(D d, V x, V& sin, V& cos) {
  const hn::RebindToUnsigned<D> du;
  const V one = hn::Set(d, 1.0);
  // x = k pi/2 + r + t, |r| <= pi/4 or a little more (Cody and Waite: pi/2 as 33 + 33 + 53 bits).
  const V shifted = x * hn::Set(d, 0x1.45f306dc9c883p-1) + hn::Set(d, kRoundingShift);
  const V k = shifted - hn::Set(d, kRoundingShift);
  const V first = x - k * hn::Set(d, 0x1.921fb544p+0);
  const V second_part = k * hn::Set(d, 0x1.0b4611a6p-34);
  const V second = first - second_part;
  const V second_rest = (first - second) - second_part;
  const V third_part = k * hn::Set(d, 0x1.3198a2e037073p-69);
  const V r = second - third_part;
  const V t = ((second - r) - third_part) + second_rest;
  const V z = r * r;
  const V zz = z * z;
  const V sin_tail =
      (hn::Set(d, 0x1.111111110f880p-7) +
       zz * (hn::Set(d, 0x1.71de357865299p-19) + zz * hn::Set(d, 0x1.5d932b44c83cep-33))) +
      z * (hn::Set(d, -0x1.a01a019c125bdp-13) + zz * hn::Set(d, -0x1.ae5e66c7e2de1p-26));
  const V cube = z * r;
  const V half = hn::Set(d, .5);
  const V sin_r =
      r - ((z * (half * t - cube * sin_tail) - t) - cube * hn::Set(d, -0x1.5555555555549p-3));
  const V cos_tail =
      (hn::Set(d, 0x1.555555555554cp-5) +
       zz * (hn::Set(d, 0x1.a01a019cb263ep-16) + zz * hn::Set(d, 0x1.1ee9ec414b1d7p-29))) +
      z * (hn::Set(d, -0x1.6c16c16c15184p-10) +
           zz * (hn::Set(d, -0x1.27e4f80a6da36p-22) + zz * hn::Set(d, -0x1.8faecba1e7ae8p-37)));
  const V half_z = half * z;
  const V near_one = one - half_z;
  const V cos_r = near_one + (((one - near_one) - half_z) + (zz * cos_tail - r * t));
  // The low two bits of k tell which of the two, and the sign.
  const auto quadrant = hn::BitCast(du, shifted);
  const auto bit0 = hn::Set(du, uint64_t{1});
  const auto swap = hn::RebindMask(d, hn::Eq(hn::And(quadrant, bit0), bit0));
  const auto bit1 = hn::Set(du, uint64_t{2});
  const auto sin_sign = hn::ShiftLeft<62>(hn::And(quadrant, bit1));
  const auto cos_sign = hn::ShiftLeft<62>(hn::And(quadrant + bit0, bit1));
  const V sin_value = hn::IfThenElse(swap, cos_r, sin_r);
  const V cos_value = hn::IfThenElse(swap, sin_r, cos_r);
  const auto in_range = hn::Le(hn::Abs(x), hn::Set(d, 1e6));
  sin = hn::IfThenElseZero(in_range, hn::BitCast(d, hn::Xor(hn::BitCast(du, sin_value), sin_sign)));
  cos = hn::IfThenElseZero(in_range, hn::BitCast(d, hn::Xor(hn::BitCast(du, cos_value), cos_sign)));
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V Sin(D d, V x) {
  V sin;
  V cos;
  SinCos(d, x, sin, cos);
  return sin;
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V Cos(D d, V x) {
  V sin;
  V cos;
  SinCos(d, x, sin, cos);
  return cos;
}

// The angle of (x, y), in -pi..pi; zeros have no sign here; (0, 0) gives 0.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Atan2(D d, V y, V x) {
  const V zero = hn::Zero(d);
  const V one = hn::Set(d, 1.0);
  const V ax = hn::Abs(x);
  const V ay = hn::Abs(y);
  const auto steep = hn::Gt(ay, ax);
  const V large = hn::IfThenElse(steep, ay, ax);
  const V small = hn::IfThenElse(steep, ax, ay);
  const V scale = hn::IfThenElse(hn::Gt(large, hn::Set(d, 0x1p1000)), hn::Set(d, 0x1p-100), one);
  const V b = large * scale;
  const V a = small * scale;
  // atan(a / b) = pi/4 + atan((a - b) / (a + b)) beyond tan(pi/8).
  const auto wide = hn::Gt(a, b * hn::Set(d, 0x1.a827999fcef32p-2));
  const V numerator = hn::IfThenElse(wide, a - b, a);
  const V sum = hn::IfThenElse(wide, a + b, b);
  const V denominator = hn::IfThenElse(hn::Gt(sum, zero), sum, one);
  const V q = numerator / denominator;
  const V z = q * q;
  const V zz = z * z;
  const V even = hn::Set(d, -0x1.555555555553dp-2) +
                 zz * (hn::Set(d, -0x1.24924922b1716p-3) +
                       zz * (hn::Set(d, -0x1.745cf90f14940p-4) +
                             zz * (hn::Set(d, -0x1.10ebe0fdac9e7p-4) +
                                   zz * (hn::Set(d, -0x1.9cdd0f9cab36fp-5) +
                                         zz * hn::Set(d, -0x1.25a28e130d04bp-6)))));
  const V odd =
      hn::Set(d, 0x1.99999999958f7p-3) +
      zz * (hn::Set(d, 0x1.c71c70e7c3fb3p-4) +
            zz * (hn::Set(d, 0x1.3b111cae15b4bp-4) +
                  zz * (hn::Set(d, 0x1.df1199eef1287p-5) + zz * hn::Set(d, 0x1.37ef9c573ad18p-5))));
  const V tail = (q * z) * (even + z * odd);
  // turn + (q + tail), or its mirror images, with turn in two parts.
  const V quarter = hn::Set(d, 0x1.921fb54442d18p-1);
  const V quarter_low = hn::Set(d, 0x1.1a62633145c07p-55);
  const V low = hn::IfThenElseZero(wide, quarter_low) + tail;
  const V angle = hn::IfThenElseZero(wide, quarter) + (q + low);
  const V right = hn::Set(d, 0x1.921fb54442d18p+0);
  const V right_low = hn::Set(d, 0x1.1a62633145c07p-54);
  const V first = hn::IfThenElse(steep, right - (angle - right_low), angle);
  const V straight = hn::Set(d, 0x1.921fb54442d18p+1);
  const V straight_low = hn::Set(d, 0x1.1a62633145c07p-53);
  const V half_plane = hn::IfThenElse(hn::Lt(x, zero), straight - (first - straight_low), first);
  return hn::IfThenElse(hn::Lt(y, zero), zero - half_plane, half_plane);
}

}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
