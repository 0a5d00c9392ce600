// Group commit: one thread that writes to the journal whatever has gathered while it wrote before,
// and then lets the answers go that rest on it (F1, F2, F9). Order is kept: an answer asked for
// after a record leaves after that record is on disk.
//
// A journal that cannot be written is final: memory is ahead of the disk, so nothing may be
// answered any more. Every waiting and later answer is called with the error, `on_failure` once.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "server/journal.h"

namespace fjord::server {

class JournalWriter {
 public:
  // Called without a lock, from the writer's thread or the caller's; must not block.
  using Answer = std::function<void(const Result<>& committed)>;

  JournalWriter(Journal& journal, std::function<void(const Error&)> on_failure);
  ~JournalWriter();  // writes what is left

  void Append(std::vector<Record> records);
  void After(Answer answer);
  size_t waiting() const;

 private:
  void Run();

  Journal& journal_;
  const std::function<void(const Error&)> on_failure_;

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  // guarded by mutex_
  std::vector<Record> records_;                      // numbers committed_+in flight+1 ...
  std::deque<std::pair<uint64_t, Answer>> answers_;  // after record number
  uint64_t appended_ = 0;
  uint64_t committed_ = 0;
  std::optional<Error> failure_;
  bool stop_ = false;

  std::thread thread_;
};

}  // namespace fjord::server
