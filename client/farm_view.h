// What `watch` shows of a job: built from messages, drawn as lines. No clock and no terminal in
// here.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/frame_set.h"
#include "fjord/v1/jobs.pb.h"

namespace fjord {

struct ViewStyle {
  int width = 80;
  bool color = false;
  bool unicode = false;
};

class FarmView {
 public:
  void SetFrames(const std::vector<v1::Frame>& frames);          // all of them
  void Apply(const v1::WatchResponse& message, double seconds);  // seconds since the watch began
  void SetWorkers(std::vector<v1::WorkerInfo> workers) { workers_ = std::move(workers); }

  const v1::Job& job() const { return job_; }

  // The live view: head, bar, map of frames, workers.
  std::vector<std::string> Lines(const ViewStyle& style, double seconds) const;
  // One plain line.
  std::string PlainLine(double seconds) const;
  // The map alone: a cell a frame, or for several where they do not fit into `rows` rows.
  std::vector<std::string> FrameMap(const ViewStyle& style, size_t rows) const;

 private:
  enum class Cell : uint8_t { kWaiting, kRunning, kDone, kCached, kFailed };
  void Put(const v1::Frame& frame);
  std::string RateText(double seconds) const;

  v1::Job job_;
  uint32_t workers_alive_ = 0;
  FrameSet frames_;          // of the job, once it is known
  std::vector<Cell> cells_;  // a frame each
  std::vector<v1::WorkerInfo> workers_;
  bool begun_ = false;
  uint32_t rendered_at_start_ = 0;  // done, not cached, when the watch began
  double began_ = 0;
};

}  // namespace fjord
