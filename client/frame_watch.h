// Stops the rendering of one frame when the user interrupts or the frame's time is over.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace fjord {

class FrameWatch {
 public:
  // `interrupt` may be null; it is looked at a few times a second. seconds 0: any time.
  FrameWatch(const std::atomic<bool>* interrupt, double seconds);
  ~FrameWatch();
  FrameWatch(const FrameWatch&) = delete;
  FrameWatch& operator=(const FrameWatch&) = delete;

  const std::atomic<bool>& stop() const { return stop_; }
  bool time_is_over() const { return over_; }

 private:
  void Run(double seconds);

  const std::atomic<bool>* const interrupt_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> over_{false};
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;   // guarded by mutex_
  std::thread thread_;  // last: starts when the rest is there
};

}  // namespace fjord
