#include "engine/render/tiles.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <mutex>

#include "engine/base/fpenv.h"
#include "engine/base/parallel.h"
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
  Film film;
  std::vector<float> rgb, distance;

  size_t Bytes() const {
    return draw.Bytes() + film.Bytes() + (rgb.capacity() + distance.capacity()) * sizeof(float);
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
    const size_t pixels = size_t{picture_.width} * picture_.height;
    picture_.bytes.resize(pixels * pixel_bytes_);
    if (frame.depth_layer) picture_.layers.push_back({"depth", std::vector<float>(pixels)});
  }

  Result<RenderedFrame> Run() {
    if (Result<> drawn = DrawShadows(&setup_, options_); !drawn) return drawn.error();
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
    const StreamStats made = worker->draw.Draw(List(), lists_, tile, options_);
    const size_t pixels = static_cast<size_t>(rect.width) * static_cast<size_t>(rect.height);
    worker->rgb.resize(pixels * 3);
    worker->film.Develop(setup_, rect, worker->draw.buffer(), worker->rgb);
    Store(rect, worker->rgb);
    if (setup_.frame.depth_layer) {
      worker->distance.resize(pixels);
      MeasureDepth(setup_, rect, worker->draw.buffer(), worker->distance);
      StoreDepth(rect, worker->distance);
    }
    Return(std::move(worker), made);
  }

  DrawList List() const {
    return {setup_.objects, setup_.cull, setup_.frame.samples, setup_.sea ? &*setup_.sea : nullptr};
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

  FrameSetup setup_;  // tiles only read it
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
