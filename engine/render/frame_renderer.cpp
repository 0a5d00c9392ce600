#include "engine/render/frame_renderer.h"

#include "engine/render/build.h"
#include "engine/render/tiles.h"

namespace fjord {

Result<RenderedFrame> RenderFrame(const v1::FrameScene& frame, const RenderOptions& options) {
  Result<BuiltFrame> built = BuildFrame(frame, options.assets);
  if (!built) return built.error();
  return RenderRegion(
      *built, {0, 0, static_cast<int32_t>(built->width), static_cast<int32_t>(built->height)},
      options);
}

Result<RenderedFrame> RenderTile(const v1::FrameScene& frame, uint32_t x, uint32_t y,
                                 uint32_t width, uint32_t height, const RenderOptions& options) {
  Result<BuiltFrame> built = BuildFrame(frame, options.assets);
  if (!built) return built.error();
  if (width < 1 || height < 1 || x >= built->width || y >= built->height ||
      width > built->width - x || height > built->height - y) {
    return Invalid("the tile lies outside the picture");
  }
  return RenderRegion(*built,
                      {static_cast<int32_t>(x), static_cast<int32_t>(y),
                       static_cast<int32_t>(width), static_cast<int32_t>(height)},
                      options);
}

}  // namespace fjord
