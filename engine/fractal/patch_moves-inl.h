// How midpoints move, N in lock-step: keyed draws, the sides of the split rule on the frame's own
// lengths, variants, coasts, fading. Compiled once per SIMD target.

#if defined(FJORD_ENGINE_FRACTAL_PATCH_MOVES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FJORD_ENGINE_FRACTAL_PATCH_MOVES_INL_H_
#undef FJORD_ENGINE_FRACTAL_PATCH_MOVES_INL_H_
#else
#define FJORD_ENGINE_FRACTAL_PATCH_MOVES_INL_H_
#endif

#include <cmath>

#include "engine/base/random.h"
#include "engine/fractal/amount.h"
#include "engine/fractal/patch_lanes-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {

struct Triple {
  VF x, y, z;
};

HWY_INLINE VF Dot(const Triple& a, const Triple& b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
HWY_INLINE Triple Cross(const Triple& a, const Triple& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
HWY_INLINE Triple Scaled(const Triple& a, VF s) { return {a.x * s, a.y * s, a.z * s}; }
HWY_INLINE Triple Select(MF m, const Triple& a, const Triple& b) {
  return {hn::IfThenElse(m, a.x, b.x), hn::IfThenElse(m, a.y, b.y), hn::IfThenElse(m, a.z, b.z)};
}

// a / |a|; `some`: where |a| is not 0, elsewhere the result is 0.
HWY_INLINE Triple UnitOrZero(const Triple& a, MF& some) {
  const DF d;
  const VF length2 = Dot(a, a);
  some = hn::Gt(length2, hn::Zero(d));
  return Scaled(a, hn::IfThenElseZero(some, hn::Set(d, 1.0) / hn::Sqrt(length2)));
}

HWY_INLINE VU MixLanes(VU x) {
  const DU du;
  const VU factor = hn::Set(du, 0xd6e8feb86659fd93u);
  const auto times = [&](VU v) {
#if HWY_TARGET <= HWY_AVX3 || HWY_TARGET == HWY_SCALAR
    return v * factor;
#else
    const hn::Repartition<uint32_t, DU> d32;
    const auto low = hn::BitCast(d32, v);
    const auto high = hn::BitCast(d32, hn::ShiftRight<32>(v));
    const VU cross = hn::MulEven(high, hn::BitCast(d32, factor)) +
                     hn::MulEven(low, hn::BitCast(d32, hn::ShiftRight<32>(factor)));
    return hn::MulEven(low, hn::BitCast(d32, factor)) + hn::ShiftLeft<32>(cross);
#endif
  };
  x = hn::Xor(x, hn::ShiftRight<32>(x));
  x = times(x);
  x = hn::Xor(x, hn::ShiftRight<32>(x));
  x = times(x);
  return hn::Xor(x, hn::ShiftRight<32>(x));
}

// A whole number below 2^52 as a double.
HWY_INLINE VF WholeLanes(VU n) {
  const DF d;
  const VU magic = hn::Set(DU(), uint64_t{0x4330000000000000u});
  return hn::BitCast(d, hn::Or(n, magic)) - hn::BitCast(d, magic);
}

// Gaussian(id, rules.uniforms), bit for bit (random.h).
HWY_INLINE VF GaussianLanes(const SurfaceRules& rules, VU id) {
  const DF d;
  const DU du;
  const VU pieces = hn::Set(du, uint64_t{0x0000ffff0000ffffu});
  VU sum = hn::Zero(du);
  VU bits = id;
  const uint32_t n = rules.uniforms;
  for (uint32_t channel = 0; channel * 4 < n; ++channel) {
    if (channel > 0) bits = MixLanes(id + hn::Set(du, channel * 0x9e3779b97f4a7c15u));
    const uint32_t count = n - channel * 4;
    if (count < 4) bits = hn::And(bits, hn::Set(du, (uint64_t{1} << (16 * count)) - 1));
    const VU halves = hn::And(bits, pieces) + hn::And(hn::ShiftRight<16>(bits), pieces);
    sum = sum + hn::And(halves + hn::ShiftRight<32>(halves), hn::Set(du, uint64_t{0xffffffffu}));
  }
  return (WholeLanes(sum + sum) - hn::Set(d, rules.gaussian_middle)) *
         hn::Set(d, rules.gaussian_scale);
}

// TangentDraw(id), bit for bit.
HWY_INLINE VF TangentLanes(VU id) {
  const DF d;
  const DU du;
  const VU bits = MixLanes(id + hn::Set(du, 7 * 0x9e3779b97f4a7c15u));
  const VU piece = hn::Set(du, uint64_t{0xffff});
  const VU sum = (hn::And(bits, piece) + hn::And(hn::ShiftRight<16>(bits), piece)) +
                 hn::And(hn::ShiftRight<32>(bits), piece);
  return (WholeLanes(sum + sum) - hn::Set(d, 3 * 65535.0)) / hn::Set(d, 6.0 * 65535.0);
}

// Both sides of the split rule where it reads the frame's own lengths.
struct Sides {
  VF left, right;
};
HWY_INLINE Sides CurrentSides(const SurfaceRules& rules, const Columns& a, const Columns& b,
                              VF current2) {
  const DF d;
  const VF middle2 = MiddleDistance2(FloatOf<true>(a.v[7]), FloatOf<true>(b.v[7]), current2);
  return {current2 * hn::Set(d, rules.length_scale), LongSide(rules, middle2)};
}

HWY_INLINE Triple Between(const Columns& a, const Columns& b) {
  return {b.v[0] - a.v[0], b.v[1] - a.v[1], b.v[2] - a.v[2]};
}

// The weight of midpoints of one stage at this squared distance from the eye (stages.h C2).
class StageWeight {
 public:
  StageWeight(const SurfaceRules& rules, uint32_t stage) : rules_(rules) {
    const double length = std::sqrt(rules.stages.Length2(stage));
    start_ = rules.stages.start * length;
    inverse_ = 1 / (start_ - rules.stages.full * length);
  }
  HWY_INLINE VF operator()(VF distance2) const {
    const DF d;
    const VF zero = hn::Zero(d), one = hn::Set(d, 1.0);
    VF distance = hn::Sqrt(hn::Set(d, rules_.floor));
    if (ByDistance(rules_)) {
      const VF clear = hn::Sqrt(distance2) - hn::Set(d, rules_.eye_radius);
      distance = Larger(clear, hn::Set(d, rules_.near));
    }
    const VF past = (hn::Set(d, start_) - distance) * hn::Set(d, inverse_);
    const VF above = hn::IfThenElseZero(hn::Gt(past, zero), past);
    const VF t = hn::IfThenElse(hn::Lt(above, one), above, one);
    return (t * t) * (hn::Set(d, 3.0) - (t + t));
  }

 private:
  const SurfaceRules& rules_;
  double start_;
  double inverse_;
};

HWY_INLINE VF ClampedShare(VF share) {
  const DF d;
  const VF most = hn::Set(d, kSimilarClamp), least = hn::Set(d, -kSimilarClamp);
  const VF above = hn::IfThenElse(hn::Gt(share, least), share, least);
  return hn::IfThenElse(hn::Lt(above, most), above, most);
}

// Everything but the plain case: laws that read current lengths, variants, coasts. `way`
// comes as the kept direction, `offset` as the affine law's.
HWY_INLINE void Bend(const SurfaceRules& rules, uint32_t level, const Columns& a, const Columns& b,
                     VF g, VF coast, Triple& way, VF& offset) {
  const DF d;
  const DU du;
  const VF zero = hn::Zero(d);
  const Triple e = Between(a, b);
  const VF current2 = Dot(e, e);
  const VU id_a = hn::BitCast(du, a.v[6]), id_b = hn::BitCast(du, b.v[6]);
  const MF first = hn::RebindMask(d, hn::Lt(id_a, id_b));
  if (rules.law == Law::kShih) offset = (hn::Set(d, rules.shih[level]) * g) * hn::Sqrt(current2);
  if (rules.law == Law::kSimilar) {
    offset = ClampedShare(hn::Set(d, rules.similar) * g) * hn::Sqrt(current2);
  }
  if (rules.variant != Variant::kFixed) {
    const VF along = hn::IfThenElseZero(hn::Gt(current2, zero), Dot(way, e) / current2);
    const Triple square{way.x - e.x * along, way.y - e.y * along, way.z - e.z * along};
    const VF left = hn::Sqrt(Dot(square, square));
    const VF least = hn::Set(d, kLeastSquare);
    way = Scaled(square, hn::Set(d, 1.0) / hn::IfThenElse(hn::Gt(left, least), left, least));
  }
  if (rules.variant == Variant::kPerturbed) {
    const VF u = hn::Set(d, rules.perturb) * TangentLanes(MixLanes(id_a + id_b));
    const VF share = hn::IfThenElseZero(hn::Gt(current2, zero), u / hn::Sqrt(current2));
    const Triple tangent = Scaled(Cross(e, way), hn::IfThenElse(first, share, zero - share));
    way = {way.x + tangent.x, way.y + tangent.y, way.z + tangent.z};
  }
  if (rules.coast) {
    // Horizontal, square to the edge, to the right hand as seen from the smaller identity (S22), by
    // a share of the edge's horizontal length: nothing jumps as an edge swings past the upright.
    const MF is_coast = hn::Gt(coast, zero);
    // Coasts share nothing: their dimension rests on draws of their own.
    const VF own = GaussianLanes(rules, MixLanes(id_a + id_b));
    const VF moved = ClampedShare(hn::Set(d, rules.coast_similar) * own);
    way = Select(is_coast, {e.y, zero - e.x, zero}, way);
    offset = hn::IfThenElse(is_coast, hn::IfThenElse(first, moved, zero - moved), offset);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
