// The leases a worker holds, shared between its threads: what is queued, what renders, what is
// being delivered, and until when. Deadlines count from the moment the request was sent that was
// answered, on this machine's monotonic clock (F5); time is passed in. Thread-safe.
//
// H1 A lease past its deadline, less a margin, is cancelled unless its picture is already made: a
// made
//    picture is judged by content and welcome at any time.
// H2 Every lease held is named in renewals and in Join.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "fjord/v1/leases.pb.h"

namespace fjord::worker {

using Time = std::chrono::steady_clock::time_point;
using AttemptKey = std::pair<uint64_t, uint64_t>;  // epoch, sequence

inline AttemptKey KeyOf(const v1::Attempt& attempt) {
  return {attempt.epoch(), attempt.sequence()};
}

struct Lease {
  v1::Grant grant;
  std::atomic<uint64_t> progress{0};  // 0: not begun
  std::atomic<bool> cancel{false};    // lost: nobody waits for it
  // guarded by HeldLeases
  Time deadline;
  bool made = false;              // rendered (or failed) and on its way
  std::optional<Time> stop_at;    // its time limit, once it is being rendered
  std::atomic<bool> over{false};  // cancelled because its time was over: it has failed
};

class HeldLeases {
 public:
  explicit HeldLeases(std::chrono::milliseconds margin) : margin_(margin) {}

  // Queues them for rendering.
  void Add(const v1::AcquireResponse& response, Time sent);
  // The next to render; waits. Null: stopped.
  std::shared_ptr<Lease> Next();
  // Rendering begins: the time limit counts from now.
  void Begin(const std::shared_ptr<Lease>& lease, Time now);
  // Waits until fewer than `most` wait to be rendered and none runs alone. False: stopped.
  bool WaitForRoom(size_t most);
  void MarkMade(const std::shared_ptr<Lease>& lease);
  void Remove(const std::shared_ptr<Lease>& lease);

  std::vector<std::shared_ptr<Lease>> All() const;
  bool empty() const;
  // After a renewal or a Join that adopted it.
  void Extend(const v1::Attempt& attempt, Time sent, std::chrono::milliseconds term);
  // The coordinator has given it up.
  void Lose(const v1::Attempt& attempt);
  // Cancels what is overdue, by its deadline or its time limit; returns when the next one will be.
  std::optional<Time> CancelOverdue(Time now);

  void Stop();

 private:
  void Drop(const std::shared_ptr<Lease>& lease);

  const std::chrono::milliseconds margin_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  // guarded by mutex_
  std::map<AttemptKey, std::shared_ptr<Lease>> leases_;
  std::deque<std::shared_ptr<Lease>> queue_;
  bool stopped_ = false;
};

}  // namespace fjord::worker
