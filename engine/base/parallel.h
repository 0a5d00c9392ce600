// ParallelFor over a fixed number of threads (oneTBB). Results must not depend on the order: every
// index writes its own place.
#pragma once

#include <cstddef>
#include <functional>

namespace fjord {

// Calls body(i) once for each i in 0..count-1. threads 0: one a core; 1: in the calling thread.
// Every thread that runs a body has the floating-point environment set (fpenv.h).
void ParallelFor(size_t count, int threads, const std::function<void(size_t)>& body);

int HardwareThreads();

}  // namespace fjord
