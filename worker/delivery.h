// Brings finished tries to the coordinator, so that a picture travels while the next is made. Owns
// its thread, which ends when the session does, and a queue of at most two.
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

#include "engine/base/result.h"
#include "worker/blobs.h"
#include "worker/held.h"
#include "worker/session.h"
#include "worker/unit_renderer.h"

namespace fjord::worker {

// A finished try.
struct Made {
  std::shared_ptr<Lease> lease;
  Result<RenderedUnit> unit;
};

class Delivery {
 public:
  // All of them outlive the delivery, which removes from `held` what it has delivered.
  Delivery(Session& session, HeldLeases& held, Blobs& blobs);

  // Waits for room in the queue. False: stopped. Thread-safe.
  bool Hand(Made made);

 private:
  void Run();
  void Deliver(const Made& made);
  bool DeliverPicture(Lease& lease, const RenderedUnit& unit);
  bool Put(Lease& lease, const RenderedUnit& unit);
  void ReportFailure(const Lease& lease, const Error& error);

  Session& session_;
  HeldLeases& held_;
  Blobs& blobs_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::deque<Made> made_;  // guarded by mutex_

  std::jthread thread_;  // last: it uses the others
};

}  // namespace fjord::worker
