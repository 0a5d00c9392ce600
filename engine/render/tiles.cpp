#include "engine/render/tiles.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <mutex>

#include "engine/base/clamp.h"
#include "engine/base/fpenv.h"
#include "engine/base/parallel.h"
#include "engine/image/dither.h"
#include "engine/render/film.h"
#include "engine/render/frame_setup.h"
#include "engine/render/outline_fill.h"
#include "engine/render/screen_bound.h"

namespace fjord {
namespace {

constexpr size_t kPatchSize = 2048;

struct TileSize {
  int32_t width, height;
};

// Terrain moves up and down more than sideways, so what is made twice lies along the upper and
// lower edges of tiles: few of those, and no more columns than the threads need to be busy.
TileSize ChooseTile(const TileRect& region, int threads) {
  constexpr int32_t kTall = 1088;
  const int32_t share = region.width / (threads <= 1 ? 1 : 4 * threads) / 16 * 16;
  return {std::clamp(share, 64, 256), kTall};
}

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

// The buffers one thread needs.
struct Worker {
  Worker() : raster(&buffer) {}

  TileBuffer buffer;
  Raster raster;
  OutlineFill fill;
  Film film;
  std::vector<float> rgb;

  size_t Bytes() const {
    return buffer.Bytes() + raster.Bytes() + fill.Bytes() + film.Bytes() +
           rgb.capacity() * sizeof(float);
  }
};

// Workers between tiles and between frames: touching fresh memory costs a tenth of a small frame.
// Holds at most one a core; tiny ones are not worth keeping.
class WorkerPool {
 public:
  static WorkerPool& Get() {
    static WorkerPool pool;
    return pool;
  }

  std::unique_ptr<Worker> Borrow() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (idle_.empty()) return std::make_unique<Worker>();
    std::unique_ptr<Worker> worker = std::move(idle_.back());
    idle_.pop_back();
    return worker;
  }

  void Return(std::unique_ptr<Worker> worker) {
    constexpr size_t kLargest = 64 << 20;
    if (worker->Bytes() > kLargest) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    if (idle_.size() < static_cast<size_t>(HardwareThreads())) idle_.push_back(std::move(worker));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Worker>> idle_;
};

class RegionRenderer {
 public:
  RegionRenderer(const BuiltFrame& frame, const TileRect& region, const RenderOptions& options)
      : setup_(frame), region_(region), options_(options) {
    const TileSize size = options.tile_size > 0 ? TileSize{options.tile_size, options.tile_size}
                                                : ChooseTile(region, Threads());
    lists_ = BinRoots(region, size.width, size.height, setup_.cull);
    picture_.width = static_cast<uint32_t>(region.width);
    picture_.height = static_cast<uint32_t>(region.height);
    picture_.format = frame.format;
    pixel_bytes_ = 3 * BytesPerSample(frame.format);
    picture_.bytes.resize(size_t{picture_.width} * picture_.height * pixel_bytes_);
  }

  Result<RenderedFrame> Run() {
    ParallelFor(lists_.tiles.size(), options_.threads, [this](size_t i) { RenderTile(i); });
    if (IsSet(options_.cancel)) return MakeError(ErrorCode::kCancelled, "cancelled");
    stats_.peak_bytes = most_bytes_ * std::min(static_cast<size_t>(Threads()), lists_.tiles.size());
    stats_.peak_bytes += picture_.bytes.size() + lists_.refs.capacity() * sizeof(RootRef);
    return RenderedFrame{std::move(picture_), stats_};
  }

 private:
  int Threads() const { return options_.threads > 0 ? options_.threads : HardwareThreads(); }

  void RenderTile(size_t tile) {
    if (IsSet(options_.cancel)) return;
    std::unique_ptr<Worker> worker = WorkerPool::Get().Borrow();
    const TileRect& rect = lists_.tiles[tile];
    const StreamStats made = Draw(tile, worker.get());
    worker->rgb.resize(static_cast<size_t>(rect.width) * static_cast<size_t>(rect.height) * 3);
    worker->film.Develop(setup_, rect, worker->buffer, worker->rgb);
    Store(rect, worker->rgb);
    Return(std::move(worker), made);
  }

  StreamStats Draw(size_t tile, Worker* worker) {
    const TileRect& rect = lists_.busy[tile];
    const size_t patch = options_.patch_size > 0 ? options_.patch_size : kPatchSize;
    worker->buffer.Reset(rect, setup_.frame.samples, setup_.sea ? &*setup_.sea : nullptr);
    StreamStats made;
    uint32_t i = lists_.start[tile];
    const uint32_t end = lists_.start[tile + 1];
    while (i < end) {
      const uint32_t object = lists_.refs[i].object;
      const ObjectSetup& setup = setup_.objects[object];
      worker->raster.StartObject(object, setup.to, setup.attributes, setup.line_width);
      if (setup.fill) worker->fill.Start(worker->buffer, setup_.cull[object].open);
      TileSink sink(setup_.cull[object], rect, options_.cancel, &worker->raster,
                    setup.fill ? &worker->fill : nullptr);
      for (; i < end && lists_.refs[i].object == object; ++i) {
        if (IsSet(options_.cancel)) return made;
        const StreamStats root =
            setup_.cull[object].prepared->Stream(lists_.refs[i].root, sink, patch);
        made.midpoints += root.midpoints;
        made.triangles += root.triangles;
        made.culled += root.culled;
        made.depth = std::max(made.depth, root.depth);
      }
      if (setup.fill) worker->fill.Finish(*setup.fill, object, &worker->buffer);
    }
    return made;
  }

  // Quantised here, so that no picture of floats is ever held whole.
  void Store(const TileRect& rect, std::span<const float> rgb) {
    const size_t row = static_cast<size_t>(rect.width) * pixel_bytes_;
    const size_t samples = static_cast<size_t>(rect.width) * 3;
    for (int32_t y = 0; y < rect.height; ++y) {
      const size_t at = (static_cast<size_t>(rect.y - region_.y + y) * picture_.width +
                         static_cast<size_t>(rect.x - region_.x)) *
                        pixel_bytes_;
      const std::span<const float> from = rgb.subspan(static_cast<size_t>(y) * samples, samples);
      if (setup_.frame.dither) {
        EncodeDithered8(static_cast<uint32_t>(rect.x), static_cast<uint32_t>(rect.y + y), from,
                        std::span(picture_.bytes).subspan(at, row));
        continue;
      }
      const Picture part = Quantise(static_cast<uint32_t>(rect.width), 1, picture_.format, from);
      std::memcpy(&picture_.bytes[at], part.bytes.data(), row);
    }
  }

  void Return(std::unique_ptr<Worker> worker, const StreamStats& made) {
    double share = 0;
    const uint64_t bytes = worker->Bytes();
    WorkerPool::Get().Return(std::move(worker));
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      most_bytes_ = std::max(most_bytes_, bytes);
      stats_.triangles += made.triangles;
      stats_.midpoints += made.midpoints;
      stats_.culled += made.culled;
      stats_.depth = std::max(stats_.depth, made.depth);
      share = static_cast<double>(++done_) / static_cast<double>(lists_.tiles.size());
    }
    if (options_.progress) options_.progress(share);
  }

  const FrameSetup setup_;
  const TileRect region_;
  const RenderOptions& options_;
  TileLists lists_;
  size_t pixel_bytes_ = 0;
  Picture picture_;  // tiles write their own rows

  std::mutex mutex_;
  uint64_t most_bytes_ = 0;  // of a worker
  RenderStats stats_;
  size_t done_ = 0;
};

}  // namespace

Result<RenderedFrame> RenderRegion(const BuiltFrame& frame, const TileRect& region,
                                   const RenderOptions& options) {
  SetFloatEnvironment();
  if (options.tile_size < 0 || options.tile_size % 16 != 0 || options.tile_size > 4096) {
    return Invalid("the tile size must be a multiple of 16, at most 4096");
  }
  return RegionRenderer(frame, region, options).Run();
}

}  // namespace fjord
