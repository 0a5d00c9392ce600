// The inside of a closed curve in one tile, by winding number: every segment left of a sample and
// crossing its row counts +1 or -1, and a sample whose sum is not 0 is inside. Integers only, so
// the order of segments is of no account.
//
// Needs every segment that lies in the tile's rows, also those left of it. Not for sharing between
// threads.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/fractal/method.h"
#include "engine/render/tile_buffer.h"
#include "engine/render/view.h"
#include "engine/render/view_plane.h"

namespace fjord {

class OutlineFill {
 public:
  void Start(const TileBuffer& tile);
  // All corners must lie before the eye.
  void Add(const TileBuffer& tile, const Projection& to, const StreamBatch& batch);
  // Draws what is inside at the depths of `plane`.
  void Finish(const ViewPlane& plane, uint32_t object, TileBuffer* tile);

  size_t Bytes() const { return turns_.capacity() * sizeof(int32_t); }

 private:
  void AddSegment(const TileBuffer& tile, ScreenPoint a, ScreenPoint b);

  std::vector<int32_t> turns_;  // laid out as the tile's samples: change of the sum at each
};

}  // namespace fjord
