// Keeps the held leases alive, and stops the work on those whose time is over. Owns two threads,
// which end when the session does: one renews as often as the coordinator asks, one waits for the
// next deadline. They are two so that a renewal that hangs never delays a deadline (F5).
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "worker/held.h"
#include "worker/session.h"

namespace fjord::worker {

class Renewal {
 public:
  // Both outlive the renewal.
  Renewal(Session& session, HeldLeases& held);

  // Leases were added to `held`, granted to a call that was sent at `sent`. Thread-safe.
  void Added(Time sent);
  // The deadlines have changed otherwise. Thread-safe.
  void Look();

 private:
  void RenewLoop();
  void RenewOnce();
  void GuardLoop();

  Session& session_;
  HeldLeases& held_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  // guarded by mutex_
  bool renew_now_ = false;
  bool look_now_ = false;  // at the deadlines

  std::jthread renewing_;  // last: they use the others
  std::jthread guarding_;
};

}  // namespace fjord::worker
