#include "server/planner.h"

namespace fjord::server {
namespace {

constexpr size_t kFirstAnswer = 4;  // frames after which workers may already begin

}  // namespace

Planner::Planner(FramePlanner& frames, std::function<void(Answer)> answer)
    : frames_(frames), answer_(std::move(answer)), thread_([this] { Run(); }) {}

Planner::~Planner() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  frames_.Stop();
  wake_.notify_one();
  thread_.join();
}

void Planner::Ask(PlanRequest request) {
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back(std::move(request));
  }
  wake_.notify_one();
}

bool Planner::Stopped() {
  const std::lock_guard lock(mutex_);
  return stop_;
}

void Planner::Run() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stop_ || !queue_.empty(); });
    if (stop_) return;
    const PlanRequest request = std::move(queue_.front());
    queue_.pop_front();
    lock.unlock();
    Answer answer{request.job, {}, {}};
    const Result<uint32_t> last = frames_.LastFrame(request.scene);
    if (Stopped()) return;
    if (!last.ok()) {
      answer.unusable = last.error();
      answer_(std::move(answer));
    } else {
      for (const uint32_t frame : request.frames) {
        if (Stopped()) return;
        answer.keys.emplace_back(frame, frames_.KeyOf(request.scene, frame));
        if (answer.keys.size() == kFirstAnswer) {
          answer_(std::move(answer));
          answer = Answer{request.job, {}, {}};
        }
      }
      if (!answer.keys.empty()) answer_(std::move(answer));
    }
    lock.lock();
  }
}

}  // namespace fjord::server
