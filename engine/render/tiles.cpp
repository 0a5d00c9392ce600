#include "engine/render/tiles.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <mutex>

#include "engine/base/fpenv.h"
#include "engine/base/parallel.h"
#include "engine/image/alpha.h"
#include "engine/image/dither.h"
#include "engine/render/depth_layer.h"
#include "engine/render/film.h"
#include "engine/render/frame_setup.h"
#include "engine/render/shadow_draw.h"
#include "engine/render/tile_draw.h"

namespace fjord {
namespace {

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

// The buffers one thread needs.
struct Worker {
  TileDraw draw;
  TileDraw before;  // translucent objects, one by one
  Film film;
  std::vector<float> pixels, straight, distance;

  size_t Bytes() const {
    return draw.Bytes() + before.Bytes() + film.Bytes() +
           (pixels.capacity() + straight.capacity() + distance.capacity()) * sizeof(float);
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
  RegionRenderer(const FrameSetup& setup, const TileRect& region, const RenderOptions& options)
      : setup_(setup), region_(region), options_(options) {
    const BuiltFrame& frame = setup.frame;
    const TileSize size = options.tile_size > 0 ? TileSize{options.tile_size, options.tile_size}
                                                : ChooseTile(region, Threads());
    lists_ = BinRoots(region, size.width, size.height, setup_.cull);
    picture_.width = static_cast<uint32_t>(region.width);
    picture_.height = static_cast<uint32_t>(region.height);
    picture_.format = frame.format;
    picture_.alpha = frame.alpha;
    pixel_bytes_ = picture_.channels() * BytesPerSample(frame.format);
    const size_t pixels = size_t{picture_.width} * picture_.height;
    picture_.bytes.resize(pixels * pixel_bytes_);
    if (frame.depth_layer) picture_.layers.push_back({"depth", std::vector<float>(pixels)});
  }

  Result<RenderedFrame> Run() {
    ParallelFor(lists_.tiles.size(), options_.threads, [this](size_t i) { RenderTile(i); });
    if (IsSet(options_.cancel)) return MakeError(ErrorCode::kCancelled, "cancelled");
    stats_.peak_bytes = most_bytes_ * std::min(static_cast<size_t>(Threads()), lists_.tiles.size());
    for (const ShadowMap& shadow : setup_.shadows) stats_.peak_bytes += shadow.Bytes();
    stats_.peak_bytes += picture_.bytes.size() + lists_.refs.capacity() * sizeof(RootRef);
    return RenderedFrame{std::move(picture_), stats_};
  }

 private:
  int Threads() const { return options_.threads > 0 ? options_.threads : HardwareThreads(); }

  void RenderTile(size_t tile) {
    if (IsSet(options_.cancel)) return;
    std::unique_ptr<Worker> worker = WorkerPool::Get().Borrow();
    const TileRect& rect = lists_.tiles[tile];
    StreamStats made;
    worker->draw.Draw(List(), lists_, tile, options_, &made);
    worker->film.Start(setup_, rect);
    DrawTranslucent(tile, worker.get(), &made);
    const size_t pixels = static_cast<size_t>(rect.width) * static_cast<size_t>(rect.height);
    worker->pixels.resize(pixels * picture_.channels());
    worker->film.Develop(worker->draw.buffer(), worker->pixels);
    Store(rect, worker.get());
    if (setup_.frame.depth_layer) {
      worker->distance.resize(pixels);
      MeasureDepth(setup_, rect, worker->draw.buffer(), worker->film.fragments(), worker->distance);
      StoreDepth(rect, worker->distance);
    }
    Return(std::move(worker), made);
  }

  void DrawTranslucent(size_t tile, Worker* worker, StreamStats* made) const {
    for (std::span<const RootRef> refs = lists_.Of(tile); !refs.empty();) {
      const std::span<const RootRef> roots = RootsOfFirst(refs);
      refs = refs.subspan(roots.size());
      const uint32_t object = roots[0].object;
      if (!setup_.objects[object].translucent) continue;
      worker->before.DrawBefore(worker->draw.buffer(), List(), roots, options_, made);
      worker->film.AddFragments(object, worker->before.buffer());
    }
  }

  DrawList List() const {
    return {setup_.objects, setup_.cull, setup_.frame.samples, setup_.sea ? &*setup_.sea : nullptr};
  }

  // Quantised here, so that no picture of floats is ever held whole.
  void Store(const TileRect& rect, Worker* worker) {
    const size_t row = static_cast<size_t>(rect.width) * pixel_bytes_;
    const size_t samples = static_cast<size_t>(rect.width) * picture_.channels();
    for (int32_t y = 0; y < rect.height; ++y) {
      const size_t at = (static_cast<size_t>(rect.y - region_.y + y) * picture_.width +
                         static_cast<size_t>(rect.x - region_.x)) *
                        pixel_bytes_;
      const std::span<const float> from =
          std::span(worker->pixels).subspan(static_cast<size_t>(y) * samples, samples);
      const std::span<uint8_t> to = std::span(picture_.bytes).subspan(at, row);
      if (setup_.frame.dither) {
        Dither(rect.x, rect.y + y, from, &worker->straight, to);
        continue;
      }
      const Picture part = Quantise(static_cast<uint32_t>(rect.width), 1, picture_.format, from,
                                    picture_.alpha ? Channels::kRgba : Channels::kRgb);
      std::memcpy(to.data(), part.bytes.data(), row);
    }
  }

  void Dither(int32_t x, int32_t y, std::span<const float> from, std::vector<float>* straight,
              std::span<uint8_t> to) const {
    if (picture_.alpha) {
      ToStraight(from, straight);
      from = *straight;
      EncodeAlpha8(from, to);
    }
    EncodeDithered8(static_cast<uint32_t>(x), static_cast<uint32_t>(y), from, to,
                    picture_.channels());
  }

  void StoreDepth(const TileRect& rect, std::span<const float> distance) {
    const auto width = static_cast<size_t>(rect.width);
    for (int32_t y = 0; y < rect.height; ++y) {
      const size_t at = static_cast<size_t>(rect.y - region_.y + y) * picture_.width +
                        static_cast<size_t>(rect.x - region_.x);
      std::copy_n(distance.begin() + y * rect.width, width, &picture_.layers[0].samples[at]);
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

  const FrameSetup& setup_;
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

Result<RenderedFrame> RenderRegion(const FrameSetup& setup, const TileRect& region,
                                   const RenderOptions& options) {
  SetFloatEnvironment();
  if (options.tile_size < 0 || options.tile_size % 16 != 0 || options.tile_size > 4096) {
    return Invalid("the tile size must be a multiple of 16, at most 4096");
  }
  return RegionRenderer(setup, region, options).Run();
}

Result<RenderedFrame> RenderRegion(const BuiltFrame& frame, const TileRect& region,
                                   const RenderOptions& options) {
  SetFloatEnvironment();
  FrameSetup setup(frame);
  if (Result<> drawn = DrawShadows(&setup, options); !drawn) return drawn.error();
  return RenderRegion(setup, region, options);
}

}  // namespace fjord
