// Asks the coordinator for work and keeps one lease waiting while another renders. Owns its thread,
// which ends when the session does; ends the session itself once the coordinator has drained this
// worker and everything it held is delivered.
#pragma once

#include <thread>

#include "worker/held.h"
#include "worker/renewal.h"
#include "worker/session.h"

namespace fjord::worker {

class LeaseLoop {
 public:
  // All of them outlive the loop. Begins by joining.
  // stay: once drained, wait to be released instead of ending.
  LeaseLoop(Session& session, HeldLeases& held, Renewal& renewal, bool stay);

 private:
  void Run();
  Session::Sent Acquire(uint64_t number, v1::AcquireResponse* response, Time* sent);
  void Drain();

  Session& session_;
  HeldLeases& held_;
  Renewal& renewal_;
  const bool stay_;
  std::jthread thread_;  // last: it uses the others
};

}  // namespace fjord::worker
