// Joins pieces of two points each, as modellers write lines, into chains. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace fjord {

struct Chain {
  size_t first = 0;                // the chain's first edge in the list
  std::vector<uint32_t> vertices;  // two or more; of a closed chain the first does not come again
  bool closed = false;             // three or more vertices
};

// Each edge names two of `vertices` vertices. An edge goes on with the next of the list where that
// begins at its end, else, where just two edges meet, with the other one, whichever way round it is
// written. An edge given twice counts once. Chains come in the order of their first edges and run
// in the direction of these. Linear in time.
std::vector<Chain> JoinEdges(std::span<const std::array<uint32_t, 2>> edges, size_t vertices);

}  // namespace fjord
