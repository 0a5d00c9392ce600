// Which SIMD instructions the kernels use. Every level gives the same bits (D2); tests and the
// exactness gate run them all. Kernels dispatch through Highway (HWY_DYNAMIC_DISPATCH).
//
// Names, weakest first: scalar, then ssse3, sse4, avx2, avx3 (AVX-512) on x86-64 or neon on ARM.
// The environment variable FJORD_SIMD chooses one when the program starts; an unknown name there
// stops the program with a message, so that a gate can never test the wrong thing.
//
// Threads: set the level only while no kernel runs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fjord {

// Levels compiled in that this processor has, weakest first.
std::vector<std::string> SimdLevels();

// One of SimdLevels(), or "best". False: unknown here, nothing changed.
[[nodiscard]] bool SetSimdLevel(std::string_view level);

// What kernels use now.
std::string SimdLevel();

namespace internal {
bool ApplySimdEnvironment();
// Set before main wherever a kernel is linked in.
inline const bool simd_environment_applied = ApplySimdEnvironment();
}  // namespace internal

}  // namespace fjord
