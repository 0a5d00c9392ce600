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

#include "engine/base/exact_trig-inl.h"
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

inline constexpr uint64_t kHigh26Bits = 0xfffffffff8000000u;  // sign, exponent, 26 bits of 53

// Cuts v to 26 significant bits: products of two such are exact.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V CutTo26Bits(D d, V v) {
  const hn::RebindToUnsigned<D> du;
  return hn::BitCast(d, hn::And(hn::BitCast(du, v), hn::Set(du, kHigh26Bits)));
}

// log2 x for normal x > 0 with about 2^-60 of relative error. Other x give anything.
template <class D, class V = hn::Vec<D>>
HWY_INLINE TwoDoubles<V> Log2OfNormal(D d, V x) {
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
  return {sum, rest};
}

// The same; x that are not normal and positive give -1075.
template <class D, class V = hn::Vec<D>>
HWY_INLINE TwoDoubles<V> Log2Parts(D d, V x) {
  const TwoDoubles<V> log = Log2OfNormal(d, x);
  const auto normal = hn::Ge(x, hn::Set(d, 0x1p-1022));
  return {hn::IfThenElse(normal, log.hi, hn::Set(d, -1075.0)), hn::IfThenElseZero(normal, log.lo)};
}

// 2^f for f in -.51 .. .51; exactly 1 at 0.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Exp2OfFraction(D d, V f) {
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
  return hn::Set(d, 1.0) + f * (even + f * odd);
}

// 2^(hi + lo), |lo| <= 2^-20, where the result is a normal number. Elsewhere it gives anything.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Exp2ToNormal(D d, V hi, V lo) {
  const hn::RebindToUnsigned<D> du;
  const V shifted = hi + hn::Set(d, kRoundingShift);
  const V k = shifted - hn::Set(d, kRoundingShift);
  const V power = Exp2OfFraction(d, (hi - k) + lo);
  return hn::BitCast(d, hn::BitCast(du, power) + hn::ShiftLeft<52>(hn::BitCast(du, shifted)));
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
  const V power = Exp2OfFraction(d, (x - k) + lo);
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

// y * log as parts of 26 bits and rest, so that the main product is exact.
template <class D, class V = hn::Vec<D>>
HWY_INLINE TwoDoubles<V> TimesLog(D d, V y, TwoDoubles<V> log) {
  const V y_high = CutTo26Bits(d, y);
  const V y_low = y - y_high;
  const V log_high = CutTo26Bits(d, log.hi);
  const V log_low = (log.hi - log_high) + log.lo;
  return {y_high * log_high, y_low * log_high + y * log_low};
}

// x^y for x >= 0. What depends on y alone moves out of a loop in which y stays.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Pow(D d, V x, V y) {
  const V zero = hn::Zero(d);
  const V most = hn::Set(d, 0x1p64);  // beyond it every x but 1 is at a limit
  const V least = hn::Set(d, -0x1p64);
  const V above = hn::IfThenElse(hn::Gt(y, least), y, least);
  const V power = hn::IfThenElse(hn::Lt(above, most), above, most);
  const TwoDoubles<V> product = TimesLog(d, power, Log2Parts(d, x));
  const V result = Exp2Parts(d, product.hi, product.lo);
  const V at_zero = hn::IfThenElseZero(hn::Eq(y, zero), hn::Set(d, 1.0));
  return hn::IfThenElse(hn::Gt(x, zero), result, at_zero);
}

// Pow without its guards, a fifth cheaper: the same bits where x and x^y are normal numbers and x >
// 0; elsewhere anything (never a trap).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V PowOfNormal(D d, V x, V y) {
  const TwoDoubles<V> product = TimesLog(d, y, Log2OfNormal(d, x));
  return Exp2ToNormal(d, product.hi, product.lo);
}

}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
