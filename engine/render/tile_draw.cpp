#include "engine/render/tile_draw.h"

#include <algorithm>

#include "engine/base/clamp.h"
#include "engine/render/screen_bound.h"

namespace fjord {
namespace {

constexpr size_t kPatchSize = 2048;

bool IsSet(const std::atomic<bool>* cancel) {
  return cancel != nullptr && cancel->load(std::memory_order_relaxed);
}

// Takes what a fractal streams into one tile.
class TileSink final : public StreamSink {
 public:
  // fill: null, or where outlines go too.
  TileSink(const CullObject& object, const TileRect& rect, const std::atomic<bool>* cancel,
           Raster* raster, OutlineFill* fill)
      : frustum_(object, rect),
        spread_(object.spread),
        cancel_(cancel),
        raster_(raster),
        fill_(fill) {}

  bool Wants(const Vec3& a, const Vec3& b, const Vec3& c, const StreamReach& reach) override {
    return !IsSet(cancel_) && frustum_.MayTouch(a, b, c, reach) &&
           (fill_ != nullptr || !IsHidden(a, b, c, reach));
  }
  bool ReadsPlaces() const override { return raster_->keep() == Keep::kPlaces; }
  void Take(const StreamBatch& batch) override {
    raster_->Draw(batch);
    if (fill_ != nullptr) fill_->Add(raster_->tile(), raster_->projection(), batch);
  }

 private:
  // Is all of it behind what the tile holds already? Asked of small ones only: large ones are
  // seldom hidden, and cut anyway.
  bool IsHidden(const Vec3& a, const Vec3& b, const Vec3& c, const StreamReach& reach) const {
    constexpr double kLargest = 64 * kFixedOne;
    const std::optional<ScreenBound> bound =
        BoundOnScreen(raster_->projection(), a, b, c, reach, spread_);
    if (!bound || !(bound->right - bound->left < kLargest) ||
        !(bound->bottom - bound->top < kLargest)) {
      return false;
    }
    return raster_->tile().Hides(FloorToInt32(bound->left) >> 8, FloorToInt32(bound->top) >> 8,
                                 FloorToInt32(bound->right) >> 8, FloorToInt32(bound->bottom) >> 8,
                                 bound->depth);
  }

  const TileFrustum frustum_;
  const double spread_;
  const std::atomic<bool>* cancel_;
  Raster* raster_;
  OutlineFill* fill_;
};

}  // namespace

std::span<const RootRef> RootsOfFirst(std::span<const RootRef> refs) {
  size_t count = 0;
  while (count < refs.size() && refs[count].object == refs[0].object) ++count;
  return refs.first(count);
}

void TileDraw::DrawObject(const DrawList& list, std::span<const RootRef> roots,
                          const RenderOptions& options, StreamStats* made) {
  const uint32_t object = roots[0].object;
  const size_t patch = options.patch_size > 0 ? options.patch_size : kPatchSize;
  const ObjectSetup& setup = list.objects[object];
  const CullObject& cull = list.cull[object];
  raster_.StartObject(object, setup.to, setup.keep, setup.line_width);
  if (setup.fill) fill_.Start(buffer_, cull.open);
  TileSink sink(cull, buffer_.rect(), options.cancel, &raster_, setup.fill ? &fill_ : nullptr);
  for (const RootRef& root : roots) {
    if (IsSet(options.cancel)) return;
    const StreamStats streamed = cull.prepared->Stream(root.root, sink, patch);
    made->midpoints += streamed.midpoints;
    made->triangles += streamed.triangles;
    made->culled += streamed.culled;
    made->depth = std::max(made->depth, streamed.depth);
  }
  if (setup.fill) fill_.Finish(*setup.fill, object, &buffer_);
}

void TileDraw::Draw(const DrawList& list, const TileLists& lists, size_t tile,
                    const RenderOptions& options, StreamStats* made) {
  buffer_.Reset(lists.busy[tile], list.samples, list.sea);
  buffer_.AddRecord({});  // what Keep::kDepth refers to
  for (std::span<const RootRef> refs = lists.Of(tile); !refs.empty();) {
    const std::span<const RootRef> roots = RootsOfFirst(refs);
    if (!list.objects[roots[0].object].translucent) DrawObject(list, roots, options, made);
    refs = refs.subspan(roots.size());
  }
}

void TileDraw::DrawBefore(const TileBuffer& solid, const DrawList& list,
                          std::span<const RootRef> roots, const RenderOptions& options,
                          StreamStats* made) {
  buffer_.ResetBefore(solid);
  DrawObject(list, roots, options, made);
}

}  // namespace fjord
