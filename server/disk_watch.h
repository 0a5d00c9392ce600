// Whether the disk takes what the coordinator writes. A write that failed for want of room begins a
// time of trouble; it is over when there is room for that write, which is looked at once a second.
// Both are told. Thread-safe; owns a thread that sleeps while all is well.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace fjord::server {

class DiskWatch {
 public:
  // `tell` gets what people should know; empty: it is over. Called without a lock, from any thread.
  DiskWatch(std::string folder, std::function<void(const std::string& trouble)> tell);
  ~DiskWatch();
  DiskWatch(const DiskWatch&) = delete;
  DiskWatch& operator=(const DiskWatch&) = delete;

  // So many bytes found no room.
  void Full(uint64_t bytes);

 private:
  void Run();
  bool HasRoomFor(uint64_t bytes) const;

  const std::string folder_;
  const std::function<void(const std::string&)> tell_;
  std::mutex mutex_;
  std::condition_variable wake_;
  // guarded by mutex_
  bool full_ = false;
  uint64_t wanted_ = 0;
  bool stop_ = false;
  std::thread thread_;  // last: it uses the others
};

}  // namespace fjord::server
