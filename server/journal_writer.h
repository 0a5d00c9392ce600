// Group commit: one thread that writes to the journal whatever has gathered while it wrote before,
// and then lets the answers go that rest on it (F1, F2, F9). Order is kept: an answer asked for
// after a record leaves after that record is on disk.
//
// While the disk is full the same rows are tried again and again; what rests on them is answered
// with that error, which promises nothing: who asks again finds what came of it.
//
// A journal that cannot be written for another reason is final: memory is ahead of the disk, so
// nothing may be answered any more. Every waiting and later answer is called with the error,
// `on_failure` once.
#pragma once

#include <chrono>
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

  // on_full: the disk is full; called at each try.
  JournalWriter(Journal& journal, std::function<void(const Error&)> on_failure,
                std::function<void()> on_full = {},
                std::chrono::milliseconds pause = std::chrono::seconds(1));
  ~JournalWriter();  // writes what is left

  void Append(std::vector<Record> records);
  void After(Answer answer);
  size_t waiting() const;

 private:
  void Run();
  Result<> Write(const std::vector<Record>& batch, std::unique_lock<std::mutex>& lock);

  Journal& journal_;
  const std::function<void(const Error&)> on_failure_;
  const std::function<void()> on_full_;
  const std::chrono::milliseconds pause_;

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  // guarded by mutex_
  std::vector<Record> records_;                      // numbers committed_+in flight+1 ...
  std::deque<std::pair<uint64_t, Answer>> answers_;  // after record number
  uint64_t appended_ = 0;
  uint64_t committed_ = 0;
  std::optional<Error> failure_;
  std::optional<Error> full_;  // now
  bool stop_ = false;

  std::thread thread_;
};

}  // namespace fjord::server
