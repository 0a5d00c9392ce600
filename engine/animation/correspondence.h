// Which point of one key picture becomes which of the next (S25), as one common set of points for
// all keys of an object.
//
// C1 Every point that a key was drawn with is there, bit for bit, in its order.
// C2 Points that only other keys have lie on the key's own edges, so no key changes its outline.
// C3 The numbering is the same in every key; it is what coarse identities are made from.
#pragma once

#include <span>
#include <vector>

#include "engine/scene/shapes.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {

// Points of different keys closer than this share of the outline's length become one.
inline constexpr double kMergeShare = 1e-6;

// points[k][n]: point n as key k has it. number_of[k][v]: the number that vertex v (from 0) of key
// k got.
struct AlignedKeys {
  std::vector<std::vector<Vec3>> points;
  std::vector<std::vector<uint32_t>> number_of;
};

// (from, to) from 0: a point of the key before and the point of this key that it becomes.
using PointPairs = std::vector<std::pair<uint32_t, uint32_t>>;

// Curves, all open or all closed. pairs[k]: anchors between keys k-1 and k, each side in the same
// order around (validated); between anchors arc length decides. No pairs: the ends (open), the
// first points (closed).
AlignedKeys AlignOutlines(std::span<const Geometry> keys, std::span<const PointPairs> pairs);

// The start of a closed outline that lies best on another's: centred, least squared distance.
// `reversed`: the outlines run in opposite directions, so `to` is walked backwards.
struct BestStart {
  uint32_t vertex = 0;
  bool reversed = false;
};
BestStart FindBestStart(const Geometry& from, const Geometry& to);

// All keys of an object, as its correspondence says. Meshes keep the numbering of the first key;
// their faces are the same (validated).
AlignedKeys AlignKeys(const v1::Object& object, std::span<const Geometry> keys);

}  // namespace fjord
