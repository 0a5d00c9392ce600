#include "worker/lease_loop.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>

namespace fjord::worker {
namespace {

using std::chrono::milliseconds;

constexpr size_t kAhead = 1;  // leases that wait while one renders
constexpr milliseconds kLongestWait{20'000};

}  // namespace

LeaseLoop::LeaseLoop(Session& session, HeldLeases& held, Renewal& renewal, bool stay)
    : session_(session), held_(held), renewal_(renewal), stay_(stay), thread_([this] { Run(); }) {}

void LeaseLoop::Run() {
  if (!session_.Join()) return;
  uint64_t number = 0;
  bool drained = false;
  while (held_.WaitForRoom(kAhead)) {
    v1::AcquireResponse response;
    Time sent;
    if (Acquire(++number, &response, &sent) == Session::Sent::kStopped) return;
    if (response.grant_size() > 0) {
      held_.Add(response, sent);
      renewal_.Added(sent);
    }
    if (response.drain() && !stay_) {
      Drain();
      return;
    }
    if (response.drain() != drained) {
      drained = response.drain();
      spdlog::info(drained ? "drained: this worker gets nothing more until it is released"
                           : "released: this worker gets work again");
    }
    // Nobody parks a drained worker's call.
    if (drained && !session_.Pause(session_.renew_every())) return;
  }
}

Session::Sent LeaseLoop::Acquire(uint64_t number, v1::AcquireResponse* response, Time* sent) {
  v1::AcquireRequest request;
  request.set_session_id(session_.name());
  request.set_want(1);
  request.set_request(number);
  return session_.Ask(
      Rpc::kAcquire,
      [&] {
        const milliseconds wait = std::min(kLongestWait, session_.term() / 3);
        request.set_wait_ms(static_cast<uint32_t>(wait.count()));
        *sent = std::chrono::steady_clock::now();
        return session_.client().Acquire(request);
      },
      response);
}

void LeaseLoop::Drain() {
  while (!held_.empty() && session_.Pause(session_.renew_every())) {
  }
  if (session_.stopping()) return;
  spdlog::info("drained: the coordinator gives this worker nothing more");
  session_.End({});
}

}  // namespace fjord::worker
