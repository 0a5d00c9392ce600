// The two ends of a level: which edges are long, and leaves as index triples.
#include <bit>

#include "engine/fractal/patch.h"

// The order matters.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/fractal/patch_collect.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep

#include "hwy/highway.h"
#include "engine/fractal/patch_lanes-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR
void CollectLongEdgesLanes(Patch& patch, bool keep_numbers) {
  const double* length2 = patch.edges.length2.data();
  const uint32_t* edge_a = patch.edges.a.data();
  const uint32_t* edge_b = patch.edges.b.data();
  uint32_t* slot = patch.edges.slot.data();
  uint32_t* list = patch.long_edges.number.data();
  uint32_t* list_a = patch.long_edges.a.data();
  uint32_t* list_b = patch.long_edges.b.data();
  double* list_length2 = patch.long_edges.length2.data();
  uint32_t n = 0;
  for (size_t i = patch.edges.run_begin; i < patch.edges.count; ++i) {
    if (PatchIsShort(length2[i])) {
      slot[i] = PatchEdges::kShort;
      continue;
    }
    slot[i] = n;
    list_a[n] = edge_a[i];
    list_b[n] = edge_b[i];
    list_length2[n] = length2[i];
    if (keep_numbers) list[n] = static_cast<uint32_t>(i);
    ++n;
  }
  patch.long_edges.count = n;
}
#else
// The lanes that are long of edges i..: the sign is in a double's upper word.
HWY_INLINE M32 LongLanes(const double* length2) {
  const D32 d;
  constexpr bool kLittle = std::endian::native == std::endian::little;
  const V32 low = hn::BitCast(d, hn::LoadU(DF(), length2));
  const V32 high = hn::BitCast(d, hn::LoadU(DF(), length2 + hn::MaxLanes(D32()) / 2));
  const V32 word = kLittle ? hn::ConcatOdd(d, high, low) : hn::ConcatEven(d, high, low);
  return hn::Lt(word, hn::Set(d, 0x80000000u));
}

void CollectLongEdgesLanes(Patch& patch, bool keep_numbers) {
  const D32 d;
  const size_t begin = patch.edges.run_begin, end = patch.edges.count;
  double* length2 = patch.edges.length2.data();
  const uint32_t* edge_a = patch.edges.a.data();
  const uint32_t* edge_b = patch.edges.b.data();
  uint32_t* slot = patch.edges.slot.data();
  uint32_t* list = patch.long_edges.number.data();
  uint32_t* list_a = patch.long_edges.a.data();
  uint32_t* list_b = patch.long_edges.b.data();
  double* list_length2 = patch.long_edges.length2.data();
  for (size_t i = 0; i < kLanes32; ++i) length2[end + i] = -1;
  const V32 none = hn::Set(d, PatchEdges::kShort);
  size_t n = 0;
  for (size_t i = begin; i < end; i += kLanes32) {
    const M32 is_long = LongLanes(length2 + i);
    const Compactor front(is_long);
    const V32 places = front.Ranks() + hn::Set(d, static_cast<uint32_t>(n));
    hn::StoreU(hn::IfThenElse(is_long, places, none), d, slot + i);
    hn::StoreU(front(hn::LoadU(d, edge_a + i)), d, list_a + n);
    hn::StoreU(front(hn::LoadU(d, edge_b + i)), d, list_b + n);
    if (keep_numbers) {
      hn::StoreU(front(Counting(d, i)), d, list + n);
    }
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
    const __mmask16 bits = is_long.raw;
    const auto low = static_cast<__mmask8>(bits), high = static_cast<__mmask8>(bits >> 8);
    const size_t low_count = static_cast<size_t>(__builtin_popcount(low));
    _mm512_storeu_pd(list_length2 + n, _mm512_maskz_compress_pd(low, _mm512_loadu_pd(length2 + i)));
    _mm512_storeu_pd(list_length2 + n + low_count,
                     _mm512_maskz_compress_pd(high, _mm512_loadu_pd(length2 + i + 8)));
    n += low_count + static_cast<size_t>(__builtin_popcount(high));
#else
    for (size_t k = 0, at = n; k < kLanes32; ++k) {
      list_length2[at] = length2[i + k];
      at += PatchIsShort(length2[i + k]) ? 0 : 1;
    }
    n += hn::CountTrue(d, is_long);
#endif
  }
  // Whole vectors may be read.
  hn::StoreU(hn::Zero(d), d, list_a + n);
  hn::StoreU(hn::Zero(d), d, list_b + n);
  if (keep_numbers) hn::StoreU(hn::Zero(d), d, list + n);
  hn::StoreU(hn::Set(DF(), 1.0), DF(), list_length2 + n);
  patch.long_edges.count = n;
}
#endif

void InterleaveLeavesLanes(Patch& patch) {
  const D32 d;
  for (size_t i = 0; i < patch.leaves.count; i += kLanes32) {
    hn::StoreInterleaved3(
        hn::LoadU(d, &patch.leaves.corner[0][i]), hn::LoadU(d, &patch.leaves.corner[1][i]),
        hn::LoadU(d, &patch.leaves.corner[2][i]), d, patch.leaves.packed[i].data());
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fjord {

HWY_EXPORT(CollectLongEdgesLanes);
HWY_EXPORT(InterleaveLeavesLanes);

void CollectLongEdges(Patch& patch, bool keep_numbers) {
  HWY_DYNAMIC_DISPATCH(CollectLongEdgesLanes)(patch, keep_numbers);
}

void InterleaveLeaves(Patch& patch) { HWY_DYNAMIC_DISPATCH(InterleaveLeavesLanes)(patch); }

}  // namespace fjord
#endif
