// The order in which a job's frames are made (F7): coarse to fine over the time line, so that a
// rough animation is there early: first, last, middle, quarters, eighths ...
#pragma once

#include <cstdint>
#include <vector>

namespace fjord::server {

// A permutation of 0..count-1.
std::vector<uint32_t> CoarseToFine(uint32_t count);

}  // namespace fjord::server
