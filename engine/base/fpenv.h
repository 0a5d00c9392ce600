// The floating-point environment the engine computes in: round to nearest, denormals kept, no
// traps. It belongs to the thread. ParallelFor sets it in its threads; a program's main sets it
// once. A library that was built with -ffast-math may have changed it before main.
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
