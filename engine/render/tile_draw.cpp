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

StreamStats TileDraw::Draw(const DrawList& list, const TileLists& lists, size_t tile,
                           const RenderOptions& options) {
  const TileRect& rect = lists.busy[tile];
  const size_t patch = options.patch_size > 0 ? options.patch_size : kPatchSize;
  buffer_.Reset(rect, list.samples, list.sea);
  buffer_.AddRecord({});  // what Keep::kDepth refers to
  StreamStats made;
  uint32_t i = lists.start[tile];
  const uint32_t end = lists.start[tile + 1];
  while (i < end) {
    const uint32_t object = lists.refs[i].object;
    const ObjectSetup& setup = list.objects[object];
    raster_.StartObject(object, setup.to, setup.keep, setup.line_width);
    if (setup.fill) fill_.Start(buffer_, list.cull[object].open);
    TileSink sink(list.cull[object], rect, options.cancel, &raster_, setup.fill ? &fill_ : nullptr);
    for (; i < end && lists.refs[i].object == object; ++i) {
      if (IsSet(options.cancel)) return made;
      const StreamStats root = list.cull[object].prepared->Stream(lists.refs[i].root, sink, patch);
      made.midpoints += root.midpoints;
      made.triangles += root.triangles;
      made.culled += root.culled;
      made.depth = std::max(made.depth, root.depth);
    }
    if (setup.fill) fill_.Finish(*setup.fill, object, &buffer_);
  }
  return made;
}

}  // namespace fjord
