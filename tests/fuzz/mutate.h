// Seeded damage to bytes: what a few thousand runs of a fuzzer would try first.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace fjord::fuzz {

// One mutation of one of `corpus`, the same for the same (corpus, seed): bytes flipped, inserted,
// removed, doubled, cut off, replaced by numbers and words that break parsers, or spliced with
// another entry. At most 64 KiB long.
std::string Mutate(const std::vector<std::string>& corpus, uint64_t seed);

}  // namespace fjord::fuzz
