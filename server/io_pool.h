// A few threads for work that waits for the disk, so that no message handler does (F9). The queue
// is bounded: at the bound Post says no, and the caller answers RESOURCE_EXHAUSTED (F8).
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace fjord::server {

class IoPool {
 public:
  IoPool(int threads, size_t bound);
  ~IoPool();  // finishes what was taken

  [[nodiscard]] bool Post(std::function<void()> work);

 private:
  void Run();

  const size_t bound_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> queue_;
  bool stop_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace fjord::server
