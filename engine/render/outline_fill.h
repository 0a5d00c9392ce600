// The inside of a closed curve in one tile, by winding number: every segment that crosses a row of
// samples counts +1 or -1 for the samples beyond the crossing, and a sample whose sum is not 0 is
// inside. Sums of integers, so the order of segments is of no account.
//
// What lies before the near plane of a perspective view is cut off. The place where it is missing
// lies on the near side of the line in which the curve's plane meets the near plane, so rows are
// counted from the far side: whatever is missing comes after all that can be seen.
//
// Needs every segment that lies in the tile's rows, also those beside it on the side that is
// counted from. Not for sharing between threads.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/fractal/method.h"
#include "engine/render/cull.h"
#include "engine/render/tile_buffer.h"
#include "engine/render/view.h"
#include "engine/render/view_plane.h"

namespace fjord {

class OutlineFill {
 public:
  // The far side of rows of this plane: kLeft or kRight.
  static OpenSide CountsFrom(const ViewPlane& plane) {
    return plane.along_x < 0 ? OpenSide::kRight : OpenSide::kLeft;
  }

  void Start(const TileBuffer& tile, OpenSide from);
  void Add(const TileBuffer& tile, const Projection& to, const StreamBatch& batch);
  // Draws what is inside at the depths of `plane`.
  void Finish(const ViewPlane& plane, uint32_t object, TileBuffer* tile);

  size_t Bytes() const { return turns_.capacity() * sizeof(int32_t); }

 private:
  // Picture coordinates in 1/256 pixel, not rounded.
  struct Place {
    double x, y;
  };
  void AddSegment(const TileBuffer& tile, const Place& a, const Place& b);
  void AddCrossing(const TileBuffer& tile, int64_t first, int32_t y, size_t sample, int32_t turn);

  OpenSide from_ = OpenSide::kLeft;
  std::vector<int32_t> turns_;  // laid out as the tile's samples: change of the sum at each
};

}  // namespace fjord
