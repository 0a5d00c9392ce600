#include "engine/render/frame_renderer.h"

#include <utility>

#include "engine/base/fpenv.h"
#include "engine/render/build.h"
#include "engine/render/shadow_draw.h"
#include "engine/render/tiles.h"

namespace fjord {

struct FrameRenderer::Ready {
  explicit Ready(BuiltFrame frame) : built(std::move(frame)), setup(built) {}

  const BuiltFrame built;
  FrameSetup setup;
};

FrameRenderer::FrameRenderer(std::unique_ptr<const Ready> ready) : ready_(std::move(ready)) {}

FrameRenderer::~FrameRenderer() = default;

Result<std::unique_ptr<FrameRenderer>> FrameRenderer::Make(const v1::FrameScene& frame,
                                                           const RenderOptions& options) {
  SetFloatEnvironment();
  Result<BuiltFrame> built = BuildFrame(frame, options.assets);
  if (!built) return built.error();
  auto ready = std::make_unique<Ready>(std::move(*built));
  if (Result<> drawn = DrawShadows(&ready->setup, options); !drawn) {
    return drawn.error();
  }
  return std::unique_ptr<FrameRenderer>(new FrameRenderer(std::move(ready)));
}

Result<RenderedFrame> FrameRenderer::Whole(const RenderOptions& options) const {
  return Tile(0, 0, ready_->built.width, ready_->built.height, options);
}

Result<RenderedFrame> FrameRenderer::Tile(uint32_t x, uint32_t y, uint32_t width, uint32_t height,
                                          const RenderOptions& options) const {
  const BuiltFrame& built = ready_->built;
  if (width < 1 || height < 1 || x >= built.width || y >= built.height || width > built.width - x ||
      height > built.height - y) {
    return Invalid("the tile lies outside the picture");
  }
  return RenderRegion(ready_->setup,
                      {static_cast<int32_t>(x), static_cast<int32_t>(y),
                       static_cast<int32_t>(width), static_cast<int32_t>(height)},
                      options);
}

Result<RenderedFrame> RenderFrame(const v1::FrameScene& frame, const RenderOptions& options) {
  const auto ready = FrameRenderer::Make(frame, options);
  if (!ready) return ready.error();
  return (*ready)->Whole(options);
}

Result<RenderedFrame> RenderTile(const v1::FrameScene& frame, uint32_t x, uint32_t y,
                                 uint32_t width, uint32_t height, const RenderOptions& options) {
  const auto ready = FrameRenderer::Make(frame, options);
  if (!ready) return ready.error();
  return (*ready)->Tile(x, y, width, height, options);
}

}  // namespace fjord
