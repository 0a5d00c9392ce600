// The floating-point environment the engine computes in: round to nearest, denormals kept, no
// traps. It belongs to the thread, and a library that was built with -ffast-math, or that changes
// it for its own ends, may have left it otherwise: before main, when it was loaded, or in a thread
// of its own.
//
// So it is set by every main, by OpenPictureFiles after it has loaded the picture libraries, by
// ParallelFor in its threads, and by every entry of the engine from which a frame key or a pixel
// follows: LoadScene..., Animation::Make and Inbetween, BuildFrame, PrepareObject, RenderRegion.
// Setting it where it is right already costs a few cycles.
#pragma once

#include <cfloat>
#include <cstdint>
#include <limits>

#if defined(__x86_64__) || defined(__i386__)
#include <xmmintrin.h>
#endif

namespace fjord {

static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<float>::is_iec559);
static_assert(FLT_EVAL_METHOD == 0, "doubles must be computed as doubles");

inline void SetFloatEnvironment() {
#if defined(__x86_64__) || defined(__i386__)
  constexpr unsigned kStickyFlags = 0x3f;
  constexpr unsigned kNearestAllMasked = 0x1f80;  // FTZ and DAZ off
  if ((_mm_getcsr() & ~kStickyFlags) != kNearestAllMasked) _mm_setcsr(kNearestAllMasked);
  // The x87 unit computes nothing of ours, but the C library asks it how to round when it reads
  // decimal numbers.
  constexpr uint16_t kNearestExtended = 0x37f;
  uint16_t now = 0;
  __asm__ volatile("fnstcw %0" : "=m"(now));
  if (now != kNearestExtended) __asm__ volatile("fldcw %0" : : "m"(kNearestExtended));
#elif defined(__aarch64__)
  uint64_t now = 0;
  __asm__ volatile("mrs %0, fpcr" : "=r"(now));
  if (now != 0) __asm__ volatile("msr fpcr, %0" : : "r"(uint64_t{0}));
#elif defined(__s390x__)
  // Bits of the fpc: masks 0xf8000000 off, rounding mode 0 is to nearest; there is no flushing.
  __asm__ volatile("sfpc %0" : : "d"(0u));
#endif
}

}  // namespace fjord
