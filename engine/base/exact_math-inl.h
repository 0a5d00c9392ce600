// The exact functions of exact_math.h as Highway templates, compiled once per SIMD target: lane for
// lane the same operations, so the same bits as the scalar functions (which are instances of these
// with one lane). Include after hwy/highway.h in a file that is compiled per target, with
// HWY_BEFORE_NAMESPACE around its own code; call as HWY_NAMESPACE::Exp2(d, v).
//
// Rules for whoever edits or imitates this: + - * / sqrt, comparisons, selections, bit operations;
// no MulAdd (fused on some targets), no approximate reciprocals, no Min, Max, Round or ConvertTo
// (they differ in signed zeros, NaN or overflow between targets). Coefficients are minimax fits.

#if defined(FJORD_ENGINE_BASE_EXACT_MATH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FJORD_ENGINE_BASE_EXACT_MATH_INL_H_
#undef FJORD_ENGINE_BASE_EXACT_MATH_INL_H_
#else
#define FJORD_ENGINE_BASE_EXACT_MATH_INL_H_
#endif

#include <cstdint>

#include "engine/base/simd.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// A value as an unevaluated sum hi + lo, |lo| <= half a unit in hi's last place or near it.
template <class V>
struct TwoDoubles {
  V hi;
  V lo;
};

// Adding it to |x| < 2^51 leaves round(x) in the low bits; subtracting it again gives round(x).
inline constexpr double kRoundingShift = 6755399441055744.0;  // 1.5 * 2^52
inline constexpr uint64_t kHigh26Bits = 0xfffffffff8000000u;  // sign, exponent, 26 bits of 53

// Cuts v to 26 significant bits: products of two such are exact.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V CutTo26Bits(D d, V v) {
  const hn::RebindToUnsigned<D> du;
  return hn::BitCast(d, hn::And(hn::BitCast(du, v), hn::Set(du, kHigh26Bits)));
}

// log2 x for normal x > 0 with about 2^-59 of relative error. hi has at most 53 bits; other x:
// -1075.
template <class D, class V = hn::Vec<D>>
HWY_INLINE TwoDoubles<V> Log2Parts(D d, V x) {
  const hn::RebindToUnsigned<D> du;
  const V one = hn::Set(d, 1.0);
  // x = 2^e m, m in [sqrt(1/2), sqrt 2): e + 1024 is left in the exponent field of `shifted`.
  const auto bits = hn::BitCast(du, x);
  const auto shifted = bits + hn::Set(du, uint64_t{0x4000000000000000u - 0x3fe6a09e667f3bcdu});
  const auto exponent = hn::ShiftRight<52>(shifted);
  const auto m_bits = bits - (hn::ShiftLeft<52>(exponent) - hn::Set(du, uint64_t{1024} << 52));
  const V m = hn::BitCast(d, m_bits);
  const V e = hn::BitCast(d, hn::Or(exponent, hn::Set(du, uint64_t{0x4330000000000000u}))) -
              hn::Set(d, 4503599627370496.0 + 1024.0);
  // log2 m = 2 / ln 2 * atanh s, s = (m - 1) / (m + 1) = s_high + s_low.
  const V numerator = m - one;
  const V denominator = m + one;
  const V inverse = one / denominator;
  const V s = numerator * inverse;
  const V s_high = CutTo26Bits(d, s);
  const V d_high = CutTo26Bits(d, denominator);
  const V d_low = m - (d_high - one);
  const V s_low = ((numerator - s_high * d_high) - s_high * d_low) * inverse;
  // 2 / ln 2 * (atanh s - s) / s^3 in z = s^2, even and odd powers apart.
  const V z = s * s;
  const V zz = z * z;
  const V even =
      hn::Set(d, 0x1.ec709dc3a03fdp-1) +
      zz * (hn::Set(d, 0x1.a61762a719600p-2) +
            zz * (hn::Set(d, 0x1.0c9a5b73d29bbp-2) + zz * hn::Set(d, 0x1.877e65a49888cp-3)));
  const V odd =
      hn::Set(d, 0x1.2776c50ef9f2ap-1) +
      zz * (hn::Set(d, 0x1.484b1440edb6ep-2) +
            zz * (hn::Set(d, 0x1.c6a20e3db5309p-3) + zz * hn::Set(d, 0x1.878633187b6c2p-3)));
  const V tail = (s * z) * (even + z * odd);
  // 2 / ln 2 = 0x1.715476p+1 (26 bits, exact product) + 0x1.4ae0bf85ddf44p-25.
  const V high = s_high * hn::Set(d, 0x1.715476p+1);
  const V low =
      s_high * hn::Set(d, 0x1.4ae0bf85ddf44p-25) + s_low * hn::Set(d, 0x1.71547652b82fep+1) + tail;
  const V above = e + high;
  const V below = (high - (above - e)) + low;
  const V sum = above + below;
  const V rest = (above - sum) + below;
  const auto normal = hn::Ge(x, hn::Set(d, 0x1p-1022));
  return {hn::IfThenElse(normal, sum, hn::Set(d, -1075.0)), hn::IfThenElseZero(normal, rest)};
}

// 2^(hi + lo), |lo| <= 2^-20.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Exp2Parts(D d, V hi, V lo) {
  const hn::RebindToUnsigned<D> du;
  const V least = hn::Set(d, -1100.0);
  const V most = hn::Set(d, 1100.0);
  const V above = hn::IfThenElse(hn::Gt(hi, least), hi, least);
  const V x = hn::IfThenElse(hn::Lt(above, most), above, most);
  const V shifted = x + hn::Set(d, kRoundingShift);
  const V k = shifted - hn::Set(d, kRoundingShift);
  const V f = (x - k) + lo;
  // (2^f - 1) / f, even and odd powers apart.
  const V ff = f * f;
  const V even = hn::Set(d, 0x1.62e42fefa39efp-1) +
                 ff * (hn::Set(d, 0x1.c6b08d704a0d7p-5) +
                       ff * (hn::Set(d, 0x1.5d87fe78a0de4p-10) +
                             ff * (hn::Set(d, 0x1.ffcbfc7c58a11p-17) +
                                   ff * (hn::Set(d, 0x1.b524cdccecfa6p-24) +
                                         ff * hn::Set(d, 0x1.ea186c9d53384p-32)))));
  const V odd = hn::Set(d, 0x1.ebfbdff82c5a5p-3) +
                ff * (hn::Set(d, 0x1.3b2ab6fb9ff54p-7) +
                      ff * (hn::Set(d, 0x1.4309130f2fd3ep-13) +
                            ff * (hn::Set(d, 0x1.62bfc6cbf0405p-20) +
                                  ff * hn::Set(d, 0x1.e61ca9be8602dp-28))));
  const V power = hn::Set(d, 1.0) + f * (even + f * odd);
  // 2^k in two steps, so that only the last may round, into the denormals. i = k + 2048 >= 0.
  const auto i = hn::BitCast(du, shifted) - hn::Set(du, uint64_t{0x4338000000000000u - 2048});
  const auto half = hn::ShiftRight<1>(i);
  const auto bias = hn::Set(du, uint64_t{1});
  const V scale1 = hn::BitCast(d, hn::ShiftLeft<52>(half - bias));
  const V scale2 = hn::BitCast(d, hn::ShiftLeft<52>((i - half) - bias));
  const V result = (power * scale1) * scale2;
  const V capped =
      hn::IfThenElse(hn::Gt(hi, hn::Set(d, 1023.99)), hn::Set(d, 0x1.fffffffffffffp+1023), result);
  return hn::IfThenZeroElse(hn::Lt(hi, hn::Set(d, -1074.0)), capped);
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V Exp2(D d, V x) {
  return Exp2Parts(d, x, hn::Zero(d));
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V Log2(D d, V x) {
  const TwoDoubles<V> parts = Log2Parts(d, x);
  return parts.hi + parts.lo;
}

// x^y for x >= 0. A y that is the same in every lane and call costs nothing extra: its parts move
// out of the loop.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Pow(D d, V x, V y) {
  const V zero = hn::Zero(d);
  const V most = hn::Set(d, 0x1p64);  // beyond it every x but 1 is at a limit
  const V least = hn::Set(d, -0x1p64);
  const V above = hn::IfThenElse(hn::Gt(y, least), y, least);
  const V power = hn::IfThenElse(hn::Lt(above, most), above, most);
  const V power_high = CutTo26Bits(d, power);
  const V power_low = power - power_high;
  const TwoDoubles<V> log = Log2Parts(d, x);
  const V log_high = CutTo26Bits(d, log.hi);
  const V log_low = (log.hi - log_high) + log.lo;
  const V high = power_high * log_high;
  const V low = power_low * log_high + power * log_low;
  const V result = Exp2Parts(d, high, low);
  const V at_zero = hn::IfThenElseZero(hn::Eq(y, zero), hn::Set(d, 1.0));
  return hn::IfThenElse(hn::Gt(x, zero), result, at_zero);
}

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
