// Makes inbetweens only to know their keys, just ahead of the scheduler and off its thread.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "engine/base/result.h"
#include "server/state/machine.h"

namespace fjord::server {

// What the planner asks: the coordinator's engine, or a test's.
class FramePlanner {
 public:
  virtual ~FramePlanner() = default;
  // Frames 1..N of a scene; an error means that the scene is not usable at all.
  virtual Result<uint32_t> LastFrame(const Digest& scene) = 0;
  // An error means this frame alone.
  virtual Result<Digest> KeyOf(const Digest& scene, uint32_t frame) = 0;
  // From another thread: what is under way ends soon, and so does all that is asked later.
  virtual void Stop() {}
};

// One thread that works through requests in order. Answers are given on that thread.
class Planner {
 public:
  struct Answer {
    JobId job = 0;
    std::optional<Error> unusable;  // the scene as a whole
    std::vector<std::pair<uint32_t, Result<Digest>>> keys;
  };
  Planner(FramePlanner& frames, std::function<void(Answer)> answer);
  ~Planner();  // drops what waits

  void Ask(PlanRequest request);

 private:
  void Run();
  bool Stopped();

  FramePlanner& frames_;
  const std::function<void(Answer)> answer_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<PlanRequest> queue_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace fjord::server
