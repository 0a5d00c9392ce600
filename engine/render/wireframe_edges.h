// The edges of a frame that its picture shows, each once, projected: what a wireframe draws. Only
// what may touch the picture is made, and no more of it than a few times what may be drawn: where
// there are more edges in view than `most`, lengths that end splitting are doubled until they fit.
// Where even the coarse shapes have too many, the longest on the picture stay. Thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/render/built_frame.h"

namespace fjord {

struct ScreenEdge {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // pixels, cut to the picture and one pixel more
  uint32_t place = 0;                     // an object at one of its places
  uint64_t from = 0, to = 0;              // identities of its ends in the object, from < to
};

struct FrameEdges {
  std::vector<ScreenEdge> edges;  // by place, from, to
  double coarser = 1;             // 1: the fineness of the picture; 4: edges four times as long
  bool longest_only = false;      // shorter ones are left out
  uint64_t made = 0;              // triangles and segments, in all attempts
};

Result<FrameEdges> EdgesInView(const BuiltFrame& frame, size_t most);

}  // namespace fjord
