// Where objects are drawn: an object once for each of its placements that the picture may show. All
// share what was prepared of the object.
//
// L1 Places are numbered by object, then by placement; those that are left out leave no gap but
//    change no order, so ties in depth go to the same place however many are seen.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/render/built_frame.h"
#include "engine/render/view.h"

namespace fjord {

struct ObjectPlace {
  uint32_t object = 0;  // of BuiltFrame::objects
  Transform transform = kNoTransform;
};

std::vector<ObjectPlace> PlacesSeen(const BuiltFrame& frame, const View& view);

// All of them, seen or not.
std::vector<ObjectPlace> AllPlaces(const BuiltFrame& frame);

// The map that does `first`, then `second`.
Transform Composed(const Transform& first, const Transform& second);

}  // namespace fjord
