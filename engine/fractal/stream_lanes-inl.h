// What the kernels on streams of vertices share, compiled once per SIMD target: 64-byte vertices
// turned into columns and back in registers, lanes of a mask brought to the front, gathers. Lane
// for lane the same operations at every width; no fused multiply-add, no Min or Max of floats
// (exact_math-inl.h says why).

#if defined(FJORD_ENGINE_FRACTAL_STREAM_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef FJORD_ENGINE_FRACTAL_STREAM_LANES_INL_H_
#undef FJORD_ENGINE_FRACTAL_STREAM_LANES_INL_H_
#else
#define FJORD_ENGINE_FRACTAL_STREAM_LANES_INL_H_
#endif

#include <cstddef>
#include <cstdint>

#include "engine/fractal/method.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::ScalableTag<double>;
using DU = hn::RebindToUnsigned<DF>;
using DI = hn::RebindToSigned<DF>;
using DN = hn::Rebind<uint32_t, DF>;  // as many 32-bit lanes as doubles
using DS = hn::Rebind<float, DF>;
using VF = hn::Vec<DF>;
using VU = hn::Vec<DU>;
using VN = hn::Vec<DN>;
using MF = hn::Mask<DF>;

// 32-bit lanes, as many as fit.
using D32 = hn::ScalableTag<uint32_t>;
using V32 = hn::Vec<D32>;
using M32 = hn::Mask<D32>;
using I32 = hn::RebindToSigned<D32>;
using VI = hn::Vec<I32>;
using MI = hn::Mask<I32>;
constexpr size_t kLanes32 = hn::MaxLanes(D32());

HWY_INLINE VI Signed(V32 v) { return hn::BitCast(I32(), v); }
HWY_INLINE V32 Unsigned(VI v) { return hn::BitCast(D32(), v); }

// n, n + 1, ... and the mask of lanes 0..count - 1. Under g++ 12 Highway's Iota, which its FirstN
// needs too where masks are vectors, writes lanes to the stack one by one and waits for them.
alignas(64) constexpr uint32_t kCounting[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                8, 9, 10, 11, 12, 13, 14, 15};
static_assert(kLanes32 <= 16);
template <typename D>
HWY_INLINE hn::Vec<D> Counting(D d, size_t n) {
  return hn::Load(d, kCounting) + hn::Set(d, static_cast<uint32_t>(n));
}
template <typename D>
HWY_INLINE hn::Mask<D> FirstLanes(D d, size_t count) {
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
  return hn::FirstN(d, count);
#else
  const hn::RebindToSigned<D> signed_tag;
  const auto most = static_cast<int32_t>(count < 16 ? count : 16);
  return hn::RebindMask(
      d, hn::Lt(hn::BitCast(signed_tag, hn::Load(d, kCounting)), hn::Set(signed_tag, most)));
#endif
}

// Brings the lanes of a mask to the front. Highway's own Compress copies its table at every call
// under g++ 12, and works the order out again for every vector.
class Compactor {
 public:
#if HWY_TARGET == HWY_SCALAR || (HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86)
  explicit HWY_INLINE Compactor(M32 mask) : order_(mask) {}
  HWY_INLINE V32 operator()(V32 v) const { return hn::Compress(v, order_); }
  // For lanes of the mask: how many come before.
  HWY_INLINE V32 Ranks() const {
#if HWY_TARGET == HWY_SCALAR
    return hn::Zero(D32());
#else
    return V32{_mm512_maskz_expand_epi32(order_.raw, Counting(D32(), 0).raw)};
#endif
  }

 private:
  M32 order_;
#else
  explicit HWY_INLINE Compactor(M32 mask) {
    uint8_t bits[8] = {};
    hn::StoreMaskBits(D32(), mask, bits);
    bits_ = bits[0];
    order_ = hn::IndicesFromVec(D32(), hn::Load(D32(), Tables().lane[bits_]));
  }
  HWY_INLINE V32 operator()(V32 v) const { return hn::TableLookupLanes(v, order_); }
  HWY_INLINE V32 Ranks() const { return hn::Load(D32(), Tables().rank[bits_]); }

 private:
  struct Table {
    alignas(64) uint32_t lane[size_t{1} << kLanes32][kLanes32];
    alignas(64) uint32_t rank[size_t{1} << kLanes32][kLanes32];
    constexpr Table() : lane(), rank() {
      for (size_t mask = 0; mask < size_t{1} << kLanes32; ++mask) {
        size_t n = 0;
        for (uint32_t i = 0; i < kLanes32; ++i) {
          rank[mask][i] = static_cast<uint32_t>(n);
          if (mask >> i & 1) lane[mask][n++] = i;
        }
        while (n < kLanes32) lane[mask][n++] = 0;
      }
    }
  };
  using Indices = decltype(hn::IndicesFromVec(D32(), hn::Zero(D32())));
  static HWY_INLINE const Table& Tables() {
    static constexpr Table kTable;
    return kTable;
  }
  size_t bits_ = 0;
  Indices order_;
#endif
};

// from[index], lane by lane. With Highway's AVX-512 gather, g++ 12 lets every gather wait for the
// last result that was in its register; from zeroed registers they overlap.
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
HWY_INLINE VF Gather(const double* from, VN index) {
  return VF{_mm512_mask_i32gather_pd(_mm512_setzero_pd(), 0xff, index.raw, from, 8)};
}
HWY_INLINE VU Gather(const uint64_t* from, VN index) {
  return VU{_mm512_mask_i32gather_epi64(_mm512_setzero_si512(), 0xff, index.raw, from, 8)};
}
HWY_INLINE V32 Gather(const uint32_t* from, V32 index) {
  return V32{_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), 0xffff, index.raw, from, 4)};
}
HWY_INLINE hn::Vec<DS> Gather(const float* from, VN index) {
  return hn::Vec<DS>{_mm256_mmask_i32gather_ps(_mm256_setzero_ps(), 0xff, index.raw, from, 4)};
}
#else
HWY_INLINE VF Gather(const double* from, VN index) {
  return hn::GatherIndex(DF(), from, hn::BitCast(DI(), hn::PromoteTo(DU(), index)));
}
HWY_INLINE VU Gather(const uint64_t* from, VN index) {
  return hn::GatherIndex(DU(), from, hn::BitCast(DI(), hn::PromoteTo(DU(), index)));
}
HWY_INLINE V32 Gather(const uint32_t* from, V32 index) {
  const D32 d;
  return hn::GatherIndex(d, from, hn::BitCast(hn::RebindToSigned<D32>(), index));
}
HWY_INLINE hn::Vec<DS> Gather(const float* from, VN index) {
  return hn::GatherIndex(DS(), from, hn::BitCast(hn::RebindToSigned<DN>(), index));
}
#endif

// Pairs of words, lane by lane: pairs[2 index], pairs[2 index + 1].
HWY_INLINE void LoadPairs(const uint64_t* pairs, const uint32_t* index, VU& first, VU& second) {
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
  const auto pair = [&](int i) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(pairs + 2 * size_t{index[i]}));
  };
  const auto four = [&](int i) {  // i, i + 2, i + 4, i + 6
    const __m256i low = _mm256_inserti128_si256(_mm256_castsi128_si256(pair(i)), pair(i + 2), 1);
    const __m256i high =
        _mm256_inserti128_si256(_mm256_castsi128_si256(pair(i + 4)), pair(i + 6), 1);
    return _mm512_inserti64x4(_mm512_castsi256_si512(low), high, 1);
  };
  const __m512i even = four(0), odd = four(1);
  first = VU{_mm512_unpacklo_epi64(even, odd)};
  second = VU{_mm512_unpackhi_epi64(even, odd)};
#else
  const VN at = hn::ShiftLeft<1>(hn::LoadU(DN(), index));
  first = Gather(pairs, at);
  second = Gather(pairs + 1, at);
#endif
}

// Eight columns of N vertices: x y z, direction x y z, id, and the word of two floats.
struct Columns {
  VF v[8];
};

#if HWY_TARGET != HWY_SCALAR
// 2x2 within each pair of lanes.
HWY_INLINE void TransposePairs(VF& a, VF& b) {
  const DF d;
  const VF low = hn::InterleaveLower(d, a, b);
  b = hn::InterleaveUpper(d, a, b);
  a = low;
}
#endif

#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
// r[i] holds row i; afterwards column i. Its own inverse.
HWY_INLINE void Transpose(VF* HWY_RESTRICT r) {
  const DF d;
  VF t[8];
  for (int i = 0; i < 8; i += 2) {
    t[i] = hn::InterleaveLower(d, r[i], r[i + 1]);
    t[i + 1] = hn::InterleaveUpper(d, r[i], r[i + 1]);
  }
  // t[2 i + odd]: blocks of two rows. Column 2 c + odd takes block c of rows 2 i, 2 i + 1.
  for (int odd = 0; odd < 2; ++odd) {
    const __m512d a = t[0 + odd].raw, b = t[2 + odd].raw, c = t[4 + odd].raw, e = t[6 + odd].raw;
    const __m512d ab01 = _mm512_shuffle_f64x2(a, b, 0x44), ab23 = _mm512_shuffle_f64x2(a, b, 0xee);
    const __m512d ce01 = _mm512_shuffle_f64x2(c, e, 0x44), ce23 = _mm512_shuffle_f64x2(c, e, 0xee);
    r[0 + odd] = VF{_mm512_shuffle_f64x2(ab01, ce01, 0x88)};
    r[2 + odd] = VF{_mm512_shuffle_f64x2(ab01, ce01, 0xdd)};
    r[4 + odd] = VF{_mm512_shuffle_f64x2(ab23, ce23, 0x88)};
    r[6 + odd] = VF{_mm512_shuffle_f64x2(ab23, ce23, 0xdd)};
  }
}
HWY_INLINE Columns LoadVertices(const StreamVertex* vertex, const uint32_t* index) {
  const DF d;
  Columns c;
  for (int i = 0; i < 8; ++i) c.v[i] = hn::LoadU(d, &vertex[index[i]].position.x);
  Transpose(c.v);
  return c;
}
HWY_INLINE void StoreVertices(Columns c, StreamVertex* vertex) {
  const DF d;
  Transpose(c.v);
  for (int i = 0; i < 8; ++i) hn::StoreU(c.v[i], d, &vertex[i].position.x);
}
#elif HWY_TARGET == HWY_AVX2
HWY_INLINE void Transpose4(VF& a, VF& b, VF& c, VF& e) {
  const DF d;
  TransposePairs(a, b);
  TransposePairs(c, e);
  const VF a1 = hn::ConcatUpperUpper(d, c, a), b1 = hn::ConcatUpperUpper(d, e, b);
  a = hn::ConcatLowerLower(d, c, a);
  b = hn::ConcatLowerLower(d, e, b);
  c = a1;
  e = b1;
}
HWY_INLINE Columns LoadVertices(const StreamVertex* vertex, const uint32_t* index) {
  const DF d;
  Columns c;
  for (int i = 0; i < 4; ++i) {
    c.v[i] = hn::LoadU(d, &vertex[index[i]].position.x);
    c.v[4 + i] = hn::LoadU(d, &vertex[index[i]].direction.y);
  }
  Transpose4(c.v[0], c.v[1], c.v[2], c.v[3]);
  Transpose4(c.v[4], c.v[5], c.v[6], c.v[7]);
  return c;
}
HWY_INLINE void StoreVertices(Columns c, StreamVertex* vertex) {
  const DF d;
  Transpose4(c.v[0], c.v[1], c.v[2], c.v[3]);
  Transpose4(c.v[4], c.v[5], c.v[6], c.v[7]);
  for (int i = 0; i < 4; ++i) {
    hn::StoreU(c.v[i], d, &vertex[i].position.x);
    hn::StoreU(c.v[4 + i], d, &vertex[i].direction.y);
  }
}
#elif HWY_TARGET != HWY_SCALAR
// Two lanes.
HWY_INLINE Columns LoadVertices(const StreamVertex* vertex, const uint32_t* index) {
  const DF d;
  Columns c;
  const double* a = &vertex[index[0]].position.x;
  const double* b = &vertex[index[1]].position.x;
  for (int i = 0; i < 8; i += 2) {
    c.v[i] = hn::LoadU(d, a + i);
    c.v[i + 1] = hn::LoadU(d, b + i);
    TransposePairs(c.v[i], c.v[i + 1]);
  }
  return c;
}
HWY_INLINE void StoreVertices(Columns c, StreamVertex* vertex) {
  const DF d;
  double* a = &vertex[0].position.x;
  double* b = &vertex[1].position.x;
  for (int i = 0; i < 8; i += 2) {
    TransposePairs(c.v[i], c.v[i + 1]);
    hn::StoreU(c.v[i], d, a + i);
    hn::StoreU(c.v[i + 1], d, b + i);
  }
}
#else
HWY_INLINE Columns LoadVertices(const StreamVertex* vertex, const uint32_t* index) {
  const DF d;
  Columns c;
  const double* a = &vertex[index[0]].position.x;
  for (int i = 0; i < 8; ++i) c.v[i] = hn::LoadU(d, a + i);
  return c;
}
HWY_INLINE void StoreVertices(Columns c, StreamVertex* vertex) {
  const DF d;
  double* a = &vertex[0].position.x;
  for (int i = 0; i < 8; ++i) hn::StoreU(c.v[i], d, a + i);
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
