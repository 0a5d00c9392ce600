// Draws one tile of one view: streams every root that may touch it into a visibility buffer. The
// camera's tiles, which the film develops, and a light's, of which only the depths are read, are
// both drawn here.
//
// Not for sharing between threads.
#pragma once

#include <span>

#include "engine/render/cull.h"
#include "engine/render/frame_renderer.h"
#include "engine/render/frame_setup.h"
#include "engine/render/outline_fill.h"
#include "engine/render/raster.h"
#include "engine/render/tile_buffer.h"

namespace fjord {

// What is drawn: both lists are of the frame's objects, in their order.
struct DrawList {
  std::span<const ObjectSetup> objects;
  std::span<const CullObject> cull;
  uint32_t samples = 1;
  const ViewPlane* sea = nullptr;  // null: none
};

// The roots at the front of `refs` that are of one object.
std::span<const RootRef> RootsOfFirst(std::span<const RootRef> refs);

class TileDraw {
 public:
  TileDraw() : raster_(&buffer_) {}

  // What is opaque, in rows lists.busy[tile]. Ends early once options.cancel is set. Adds to
  // `made`.
  void Draw(const DrawList& list, const TileLists& lists, size_t tile, const RenderOptions& options,
            StreamStats* made);

  // One translucent object alone, of which `roots` may touch the tile: what of it lies before
  // `solid`.
  void DrawBefore(const TileBuffer& solid, const DrawList& list, std::span<const RootRef> roots,
                  const RenderOptions& options, StreamStats* made);

  const TileBuffer& buffer() const { return buffer_; }
  size_t Bytes() const { return buffer_.Bytes() + raster_.Bytes() + fill_.Bytes(); }

 private:
  void DrawObject(const DrawList& list, std::span<const RootRef> roots,
                  const RenderOptions& options, StreamStats* made);

  TileBuffer buffer_;
  Raster raster_;
  OutlineFill fill_;
};

}  // namespace fjord
