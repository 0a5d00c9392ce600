#include "client/local_render.h"

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "client/frame_watch.h"
#include "engine/animation/frame_key.h"
#include "engine/base/parallel.h"
#include "engine/image/codec.h"
#include "engine/render/frame_renderer.h"

namespace fjord {
namespace {

using Clock = std::chrono::steady_clock;

std::string SecondsText(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%g s", seconds);
  return text;
}

struct FinishedFrame {
  uint32_t number = 0;
  ManifestFrame entry;
  Picture picture;
  PictureInfo info;
};

Result<> Store(FinishedFrame frame, FrameFolder* folder) {
  frame.entry.pixel_digest = PixelDigest(frame.picture).Hex();
  const Result<std::string> bytes = EncodePicture(frame.picture, frame.info);
  if (!bytes.ok()) return bytes.error();
  return folder->Add(frame.number, std::move(frame.entry), *bytes);
}

// Encodes and writes on a thread of its own; at most kMostWaiting pictures wait.
class FrameWriter {
 public:
  FrameWriter(FrameFolder* folder, FrameProgress* progress)
      : folder_(folder), progress_(progress), thread_([this] { Run(); }) {}

  ~FrameWriter() { Join(); }

  // False after an error.
  bool Put(FinishedFrame frame) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_.size() < kMostWaiting || error_; });
    if (error_) return false;
    waiting_.push_back(std::move(frame));
    changed_.notify_all();
    return true;
  }

  // Waits until everything is written.
  Result<> Finish() {
    Join();
    if (error_) return *error_;
    return Ok{};
  }

 private:
  static constexpr size_t kMostWaiting = 2;

  void Join() {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
      changed_.notify_all();
    }
    if (thread_.joinable()) thread_.join();
  }

  void Run() {
    for (;;) {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return !waiting_.empty() || ended_; });
      if (waiting_.empty()) return;
      FinishedFrame frame = std::move(waiting_.front());
      waiting_.pop_front();
      changed_.notify_all();
      lock.unlock();
      if (Result<> stored = Store(std::move(frame), folder_); !stored.ok()) {
        lock.lock();
        error_ = stored.error();
        waiting_.clear();
        changed_.notify_all();
        return;
      }
      progress_->FrameDone();
    }
  }

  FrameFolder* const folder_;
  FrameProgress* const progress_;
  std::mutex mutex_;
  std::condition_variable changed_;
  // Guarded by mutex_.
  std::deque<FinishedFrame> waiting_;
  std::optional<Error> error_;
  bool ended_ = false;
  std::thread thread_;  // last: starts when the rest is there
};

Result<RenderedFrame> RenderInTime(const v1::FrameScene& frame, uint32_t number,
                                   const LocalRenderJob& job, RenderOptions options) {
  if (job.frame_seconds <= 0) {
    options.cancel = job.cancel;
    return RenderFrame(frame, options);
  }
  const FrameWatch watch(job.cancel, job.frame_seconds);
  options.cancel = &watch.stop();
  Result<RenderedFrame> rendered = RenderFrame(frame, options);
  if (rendered.ok() || !watch.time_is_over()) return rendered;
  return MakeError(ErrorCode::kLimit, "frame " + std::to_string(number) + " took longer than its " +
                                          SecondsText(job.frame_seconds) +
                                          " (--frame-limit); give it more time, or make less "
                                          "of it, as with a larger epsilon or pixels");
}

Result<> RenderFrames(const LocalRenderJob& job, FrameFolder* folder, FrameProgress* progress,
                      LocalRenderReport* report) {
  const int threads = job.threads > 0 ? job.threads : HardwareThreads();
  std::optional<FrameWriter> writer;
  if (threads > 1) writer.emplace(folder, progress);
  RenderOptions options;
  options.threads = threads;
  options.progress = [progress](double share) { progress->Share(share); };
  for (uint32_t index = 0; index < job.frames.size(); ++index) {
    const uint32_t number = job.frames[index];
    if (job.cancel != nullptr && job.cancel->load())
      return MakeError(ErrorCode::kCancelled, "interrupted");
    AssetSet assets;
    const Result<v1::FrameScene> frame = job.animation->Inbetween(number, &assets);
    if (!frame.ok()) return frame.error();
    const Result<Digest> key = FrameKey(*frame);
    if (!key.ok()) return key.error();
    if (folder->Has(number, key->Hex())) {
      ++report->kept;
      progress->FrameKept();
      continue;
    }
    if (job.allow) {
      if (Result<> allowed = job.allow(*frame, &assets, number); !allowed.ok()) return allowed;
    }
    const auto start = Clock::now();
    options.assets = &assets;
    Result<RenderedFrame> rendered = RenderInTime(*frame, number, job, options);
    if (!rendered.ok()) return rendered.error();
    const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start);
    Result<PictureInfo> info = DescribeFrame(*frame);
    if (!info.ok()) return info.error();
    FinishedFrame finished{number, {}, std::move(rendered->picture), std::move(info).value()};
    finished.entry.frame_key = key->Hex();
    finished.entry.triangles_made = rendered->stats.triangles;
    finished.entry.milliseconds = static_cast<uint64_t>(took.count());
    report->triangles_made += rendered->stats.triangles;
    ++report->rendered;
    if (writer) {
      if (!writer->Put(std::move(finished))) break;
    } else {
      if (Result<> stored = Store(std::move(finished), folder); !stored.ok()) return stored.error();
      progress->FrameDone();
    }
  }
  if (writer) return writer->Finish();
  return Ok{};
}

}  // namespace

Result<> RenderLocally(const LocalRenderJob& job, FrameFolder* folder, FrameProgress* progress,
                       LocalRenderReport* report) {
  const Result<> rendered = RenderFrames(job, folder, progress, report);
  const Result<> flushed = folder->Flush();
  return rendered.ok() ? flushed : rendered;
}

}  // namespace fjord
