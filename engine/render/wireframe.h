// A fast look (S26): the edges in view of every object, each once; hidden lines are not removed.
// Where there would be more edges than `cap`, the fineness is made coarser, twofold at a time,
// until they fit, or, where coarse shapes alone are too many, the longest are drawn; the answer
// says so (wireframe_edges.h). Thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "engine/base/digest.h"
#include "engine/base/result.h"
#include "engine/image/picture.h"
#include "engine/render/built_frame.h"

namespace fjord {

inline constexpr size_t kWireframeCap = 200'000;

struct WireframeStats {
  uint64_t edges = 0;         // drawn
  double coarser = 1;         // 1: the fineness of the picture; 4: edges four times as long
  bool longest_only = false;  // coarse shapes have more, of which the longest are drawn
  uint64_t made = 0;          // triangles and segments, to find and draw them
};

struct WireframePicture {
  Picture picture;  // kPng8, the frame's size
  WireframeStats stats;
};
Result<WireframePicture> RenderWireframe(const BuiltFrame& frame, size_t cap = kWireframeCap);

struct WireframeDrawing {
  std::string svg;
  WireframeStats stats;
};
Result<WireframeDrawing> WireframeSvg(const BuiltFrame& frame, size_t cap = kWireframeCap);

// SHA-256 over an order-free sum of all leaves that the frame's objects stream, vertex by vertex:
// equal for everything that draws this frame, whatever is culled and however it is cut.
Digest GeometryDigest(const BuiltFrame& frame);

}  // namespace fjord
