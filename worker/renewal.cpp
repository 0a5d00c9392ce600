#include "worker/renewal.h"

#include <chrono>
#include <memory>
#include <optional>

namespace fjord::worker {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

Renewal::Renewal(Session& session, HeldLeases& held)
    : session_(session),
      held_(held),
      renewing_([this] { RenewLoop(); }),
      guarding_([this] { GuardLoop(); }) {}

void Renewal::Added(Time sent) {
  {
    const std::lock_guard lock(mutex_);
    // The lease counts from when the call was sent, which may be a while ago.
    if (steady_clock::now() - sent > session_.renew_every()) renew_now_ = true;
    look_now_ = true;
  }
  wake_.notify_all();
}

void Renewal::Look() {
  {
    const std::lock_guard lock(mutex_);
    look_now_ = true;
  }
  wake_.notify_all();
}

void Renewal::RenewLoop() {
  while (!session_.stopping()) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, session_.stop_token(), session_.renew_every(),
                   [this] { return renew_now_; });
    renew_now_ = false;
    lock.unlock();
    if (!session_.stopping() && session_.has_joined()) RenewOnce();
  }
}

// Once, whatever comes of it: the next renewal is due anyway.
void Renewal::RenewOnce() {
  v1::RenewRequest request;
  request.set_session_id(session_.name());
  for (const std::shared_ptr<Lease>& lease : held_.All()) {
    v1::RenewRequest::Progress& entry = *request.add_progress();
    *entry.mutable_attempt() = lease->grant.attempt();
    entry.set_count(lease->progress.load(std::memory_order_relaxed));
  }
  const Time sent = steady_clock::now();
  v1::RenewResponse response;
  const Session::Sent answer = session_.AskOnce(
      Rpc::kRenew, [&] { return session_.client().Renew(request); }, &response);
  if (answer != Session::Sent::kAnswered) return;
  for (const v1::RenewResponse::Verdict& verdict : response.verdict()) {
    if (verdict.go_on()) {
      held_.Extend(verdict.attempt(), sent, milliseconds(verdict.term_ms()));
    } else {
      held_.Lose(verdict.attempt());
    }
  }
}

void Renewal::GuardLoop() {
  while (!session_.stopping()) {
    const std::optional<Time> next = held_.CancelOverdue(steady_clock::now());
    std::unique_lock lock(mutex_);
    const auto awake = [this] { return look_now_; };
    if (next) {
      wake_.wait_until(lock, session_.stop_token(), *next, awake);
    } else {
      wake_.wait(lock, session_.stop_token(), awake);
    }
    look_now_ = false;
  }
}

}  // namespace fjord::worker
