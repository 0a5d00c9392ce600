// What lies before the opaque samples of a tile and covers them in part. A translucent object is
// drawn alone, over the depths of what is opaque; of each sample that it covers, one fragment
// stays, the object's nearest. Once all are there, a sample's fragments are laid over its colour,
// far ones first.
//
// Invariants
// T1 A sample has at most one fragment of an object, so an object that covers itself is not the
//    denser for it.
// T2 The order of a sample's fragments is that of (depth, owner): no tile, thread or order of
//    drawing enters.
//
// Not for sharing between threads.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/geometry/vec.h"

namespace fjord {

struct Fragment {
  uint32_t sample = 0;  // of the tile: rows of pixels, in each the samples of a pixel after another
  uint32_t owner = 0;   // of FrameSetup::owners
  double depth = 0;
  Rgb color{0};
  float opacity = 1;
};

// By sample; of one sample far ones first, at equal depth those of larger owners first.
void SortFragments(std::vector<Fragment>* fragments);

// Those of samples first..end - 1 of a sorted list.
std::span<const Fragment> FragmentsOf(std::span<const Fragment> sorted, uint32_t first,
                                      uint32_t end);

}  // namespace fjord
