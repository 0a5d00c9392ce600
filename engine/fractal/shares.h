// What neighbouring midpoints share (Increments::kEven). Halving with a number of its own for every
// edge makes the two midpoints of a triangle differ too much: an edge between them has twice the
// variance that its length asks for, and lines of the coarse shape show. So each triangle draws a
// number, and the midpoint of an edge takes one half of its draw from the triangle on its left and
// the other half from the one on its right: any two midpoints of a triangle share a half.
//
// A triangle's key is a pure function of its parent's key and of its place in the template, and
// both sides of an edge know it without asking the neighbour: an edge carries the keys of both of
// its triangles, and with each key, in its lowest bits, what is needed to name the child that lies
// along either half.
// - role: 0, 1, 2, the sides of a triangle counter-clockwise, 2 the longest of the coarse one;
// - template: a triangle of three long edges is cut into four children. Child k < 3 lies at the
//   corner where side k starts, child 3 in the middle. With kShareRight, sides a-b, b-c, c-a with
//   midpoints M, N, C: children (a M C), (M b C), (b N C), (N c C).
// Where a triangle was cut otherwise its parts get keys that no other triangle has.
//
// Integers only, frozen with the method's version.
#pragma once

#include <cstdint>

#include "engine/base/random.h"

namespace fjord {

inline constexpr uint64_t kShareRole = 3;
inline constexpr uint64_t kShareRight = 4;
inline constexpr uint64_t kShareFlags = kShareRole | kShareRight;
inline constexpr uint64_t kShareStep = 0x9e3779b97f4a7c15u;

// The template with kShareRight is taken where (2 a^2 + 2 b^2 - c^2) <= kMostRight c^2, c the
// longest side: the median to the middle of c is hardly longer than the line between the other
// midpoints.
inline constexpr double kMostRight = 1.125;

// Child and role of the halves, four bits each: child + 4 role, at place flags + 8 (second half).
constexpr uint64_t ShareHalves() {
  constexpr uint8_t kChild[2][8] = {{0, 1, 2, 0, 0, 2, 3, 0}, {1, 2, 0, 0, 1, 3, 0, 0}};
  constexpr uint8_t kRole[2][8] = {{0, 1, 2, 0, 0, 0, 2, 0}, {0, 1, 2, 0, 1, 1, 2, 0}};
  uint64_t table = 0;
  for (int second = 0; second < 2; ++second) {
    for (int flags = 0; flags < 8; ++flags) {
      const uint64_t entry = kChild[second][flags] + 4u * kRole[second][flags];
      table |= entry << (4 * (flags + 8 * second));
    }
  }
  return table;
}

// A coarse triangle's key from the identities of its corners, smallest vertex number first.
constexpr uint64_t CoarseShare(uint64_t a, uint64_t b, uint64_t c) {
  return Mix64(a + 3 * b + 5 * c + kShareStep) & ~kShareFlags;
}

// Stands for the triangle beside an edge that has not two that run along it in opposite ways.
constexpr uint64_t EdgeShare(uint64_t a, uint64_t b, uint64_t side) {
  return Mix64((a + b) ^ (0xd1b54a32d192ed03u + side)) & ~kShareFlags;
}

}  // namespace fjord
