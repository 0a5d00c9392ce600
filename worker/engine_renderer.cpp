#include <algorithm>
#include <chrono>
#include <list>
#include <utility>

#include "engine/animation/frame_key.h"
#include "engine/animation/inbetween.h"
#include "engine/render/frame_renderer.h"
#include "engine/scene/load.h"
#include "worker/retry.h"
#include "worker/unit_renderer.h"

namespace fjord::worker {
namespace {

constexpr size_t kAnimationsKept = 4;

// Whether asking again may help is kept in the code.
Result<std::string> Fetch(Blobs& blobs, const std::string& digest) {
  std::string bytes;
  const grpc::Status status = blobs.Get(digest, &bytes);
  if (status.ok()) return bytes;
  const bool passing = ActOn(Rpc::kGet, status.error_code()) == Act::kRetry;
  return MakeError(passing ? ErrorCode::kUnavailable : ErrorCode::kNotFound,
                   "cannot fetch " + digest + ": " + status.error_message());
}

class EngineRenderer : public UnitRenderer {
 public:
  EngineRenderer(Blobs& blobs, int threads) : blobs_(blobs), threads_(threads) {}

  Result<RenderedUnit> Render(const UnitOrder& order, std::atomic<uint64_t>& progress,
                              const std::atomic<bool>& cancel) override {
    const auto begin = std::chrono::steady_clock::now();
    const Result<std::shared_ptr<const Animation>> animation = AnimationOf(order.scene);
    if (!animation.ok()) return animation.error();
    AssetSet assets;
    const Result<v1::FrameScene> scene = animation.value()->Inbetween(order.frame, &assets);
    if (!scene.ok()) return scene.error();
    const Result<Digest> key = FrameKey(*scene);
    if (!key.ok()) return key.error();
    if (key->Hex() != order.frame_key) {
      return Invalid("this worker reaches frame key " + key->Hex() + " and not " + order.frame_key +
                     ": use programs of one release");
    }
    RenderOptions options;
    options.threads = threads_;
    options.assets = &assets;
    options.cancel = &cancel;
    options.progress = [&progress](double) { progress.fetch_add(1, std::memory_order_relaxed); };
    const Result<RenderedFrame> frame = RenderFrame(*scene, options);
    if (!frame.ok()) return frame.error();
    const Result<PictureInfo> info = DescribeFrame(*scene);
    if (!info.ok()) return info.error();
    Result<std::string> bytes = EncodePicture(frame->picture, *info);
    if (!bytes.ok()) return bytes.error();
    RenderedUnit unit;
    unit.pixel_digest = PixelDigest(frame->picture).Hex();
    unit.picture = std::move(*bytes);
    unit.blob_digest = Sha256Of(unit.picture).Hex();
    unit.triangles = frame->stats.triangles;
    unit.render_ms = static_cast<uint32_t>(std::chrono::duration_cast<std::chrono::milliseconds>(
                                               std::chrono::steady_clock::now() - begin)
                                               .count());
    return unit;
  }

 private:
  Result<std::shared_ptr<const Animation>> AnimationOf(const std::string& digest) {
    const auto known = std::find_if(recent_.begin(), recent_.end(),
                                    [&](const auto& entry) { return entry.first == digest; });
    if (known != recent_.end()) {
      recent_.splice(recent_.begin(), recent_, known);
      return recent_.front().second;
    }
    const Result<std::string> bytes = Fetch(blobs_, digest);
    if (!bytes.ok()) return bytes.error();
    bool passing = false;
    LoadResult loaded =
        LoadSceneBinary(*bytes, "scene", [&](const v1::File& file) -> Result<std::string> {
          Result<std::string> asset = Fetch(blobs_, file.digest());
          passing |= !asset.ok() && asset.error().code == ErrorCode::kUnavailable;
          return asset;
        });
    if (!loaded.ok()) {
      Error error = loaded.errors.front();
      if (passing) error.code = ErrorCode::kUnavailable;
      return error;
    }
    Result<std::shared_ptr<const Animation>> animation = Animation::Make(std::move(loaded.loaded));
    if (!animation.ok()) return animation;
    recent_.emplace_front(digest, *animation);
    if (recent_.size() > kAnimationsKept) recent_.pop_back();
    return animation;
  }

  Blobs& blobs_;
  const int threads_;
  std::list<std::pair<std::string, std::shared_ptr<const Animation>>> recent_;
};

}  // namespace

std::unique_ptr<UnitRenderer> MakeEngineRenderer(Blobs& blobs, int threads) {
  return std::make_unique<EngineRenderer>(blobs, threads);
}

}  // namespace fjord::worker
