#include "client/frame_watch.h"

#include <algorithm>
#include <chrono>

namespace fjord {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLookForInterrupt{50};
constexpr double kLongestSeconds = 1e9;

}  // namespace

FrameWatch::FrameWatch(const std::atomic<bool>* interrupt, double seconds)
    : interrupt_(interrupt), thread_([this, seconds] { Run(seconds); }) {}

FrameWatch::~FrameWatch() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void FrameWatch::Run(double seconds) {
  const auto end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(
                         seconds > 0 ? std::min(seconds, kLongestSeconds) : kLongestSeconds));
  std::unique_lock lock(mutex_);
  while (!stop_) {
    const auto next = std::min(Clock::now() + kLookForInterrupt, end);
    if (wake_.wait_until(lock, next, [this] { return done_; })) return;
    over_ = Clock::now() >= end;
    stop_ = over_ || (interrupt_ != nullptr && interrupt_->load());
  }
}

}  // namespace fjord
