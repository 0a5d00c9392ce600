// From a frame scene to a picture: fractalize and render in one streaming pass over tiles.
//
// The samples are the same for every thread count, tile size, patch size and SIMD level (D4).
// Memory is bounded by threads and tile size, not by the number of triangles.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>

#include "engine/asset/asset.h"
#include "engine/base/result.h"
#include "engine/image/codec.h"
#include "engine/image/picture.h"
#include "fjord/v1/frame.pb.h"

namespace fjord {

struct RenderOptions {
  int threads = 1;        // 0: one a core
  int tile_size = 0;      // pixels, a multiple of 16; 0: chosen
  size_t patch_size = 0;  // leaves made at a time; 0: chosen
  // The lists that the frame scene only names; null where it names none.
  const AssetResolver* assets = nullptr;
  // Called with the share done, 0..1, from any thread, at most once a tile. May be empty.
  std::function<void(double)> progress;
  // Set by anyone to end early with kCancelled. May be null.
  const std::atomic<bool>* cancel = nullptr;
};

struct RenderStats {
  // Micro-triangles made. Those at the borders of tiles are made for each tile, and what is hidden
  // is made until something hides it: the count depends on threads, tiles and patches.
  uint64_t triangles = 0;
  uint64_t midpoints = 0;
  uint64_t culled = 0;  // subtrees not made
  uint32_t depth = 0;
  uint64_t peak_bytes = 0;  // of the renderer's own buffers
};

struct RenderedFrame {
  Picture picture;
  RenderStats stats;
};

// A frame made ready to draw: objects prepared, shadow maps drawn, once for all of its tiles.
// Immutable; share it between threads.
class FrameRenderer {
 public:
  // Of options: assets, and what DrawShadows takes.
  static Result<std::unique_ptr<FrameRenderer>> Make(const v1::FrameScene& frame,
                                                     const RenderOptions& options);
  ~FrameRenderer();

  Result<RenderedFrame> Whole(const RenderOptions& options) const;
  // One tile alone (x0, y0, width, height in pixels): equals that part of the whole.
  Result<RenderedFrame> Tile(uint32_t x, uint32_t y, uint32_t width, uint32_t height,
                             const RenderOptions& options) const;

 private:
  struct Ready;
  explicit FrameRenderer(std::unique_ptr<const Ready> ready);

  std::unique_ptr<const Ready> ready_;
};

// Make and Whole.
Result<RenderedFrame> RenderFrame(const v1::FrameScene& frame, const RenderOptions& options);

// Make and Tile, for one tile.
Result<RenderedFrame> RenderTile(const v1::FrameScene& frame, uint32_t x, uint32_t y,
                                 uint32_t width, uint32_t height, const RenderOptions& options);

// Metadata for the file: frame key, and seed and parameters of every object (C47).
Result<PictureInfo> DescribeFrame(const v1::FrameScene& frame);

}  // namespace fjord
