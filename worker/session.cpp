#include "worker/session.h"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/printable.h"
#include "proto/fjord/protocol.h"
#include "worker/identity.h"

namespace fjord::worker {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

std::string HostName() {
  char name[256] = "unknown";
  gethostname(name, sizeof name - 1);
  return name;
}

SessionConfig WithId(SessionConfig config) {
  if (config.worker_id.empty()) config.worker_id = HostName() + "-" + std::to_string(getpid());
  return config;
}

}  // namespace

Session::Session(SessionConfig config, LeaseClient& client, HeldLeases& held)
    : config_(WithId(std::move(config))),
      name_(config_.session.empty() ? NewSessionName() : config_.session),
      client_(client),
      held_(held) {}

Backoff Session::NewBackoff() const {
  return Backoff(kFirstPause, kLongestPause, std::hash<std::string>{}(name_));
}

bool Session::Pause(milliseconds length) {
  std::unique_lock lock(mutex_);
  wake_.wait_for(lock, stop_token(), length, [] { return false; });
  return !stopping();
}

void Session::End(Result<> result) {
  {
    const std::lock_guard lock(mutex_);
    if (!ended_) ended_ = std::move(result);
  }
  stop_.request_stop();
  wake_.notify_all();
}

Result<> Session::WaitForEnd() {
  std::unique_lock lock(mutex_);
  wake_.wait(lock, [this] { return ended_.has_value(); });
  return *ended_;
}

std::optional<Result<>> Session::WaitForEnd(milliseconds length) {
  std::unique_lock lock(mutex_);
  wake_.wait_for(lock, length, [this] { return ended_.has_value(); });
  return ended_;
}

void Session::Refuse(const grpc::Status& status) {
  End(MakeError(ErrorCode::kUnavailable, "the coordinator at " + config_.server +
                                             " refuses this worker: " + status.error_message()));
}

// None: ask again.
std::optional<Session::Sent> Session::Judge(Rpc rpc, const grpc::Status& status, uint64_t joins,
                                            Trouble* trouble) {
  const Act act = ActOn(rpc, status.error_code());
  if (act == Act::kDone || act == Act::kNext) {
    if (trouble->said) spdlog::info("the coordinator at {} answers again", config_.server);
    return act == Act::kDone ? Sent::kAnswered : Sent::kDropped;
  }
  if (act == Act::kDrop) {
    spdlog::warn("given up: {}", Printable(status.error_message()));
    return Sent::kDropped;
  }
  if (act == Act::kStop) {
    Refuse(status);
    return Sent::kStopped;
  }
  if (act == Act::kJoinAgain) {
    if (JoinUnlessJoinedSince(joins)) return std::nullopt;
    return Sent::kStopped;
  }
  if (rpc == Rpc::kJoin && status.error_code() == grpc::StatusCode::ABORTED) {
    if (!std::exchange(trouble->waits, true))
      spdlog::info("waiting: {}", Printable(status.error_message()));
  } else if (!stopping() && !std::exchange(trouble->said, true)) {
    const bool silent = status.error_code() != grpc::StatusCode::RESOURCE_EXHAUSTED;
    spdlog::warn("the coordinator at {} {} ({}); trying again", config_.server,
                 silent ? "does not answer" : "can not take more now",
                 Printable(status.error_message()));
  }
  if (Pause(trouble->backoff.Next())) return std::nullopt;
  return Sent::kStopped;
}

Session::Sent Session::JudgeOnce(Rpc rpc, const grpc::Status& status, uint64_t joins) {
  switch (ActOn(rpc, status.error_code())) {
    case Act::kDone:
      return Sent::kAnswered;
    case Act::kJoinAgain:
      return JoinUnlessJoinedSince(joins) ? Sent::kDropped : Sent::kStopped;
    case Act::kStop:
      Refuse(status);
      return Sent::kStopped;
    case Act::kRetry:
    case Act::kNext:
    case Act::kDrop:
      break;
  }
  return Sent::kDropped;
}

v1::JoinRequest Session::JoinRequestOfThisWorker() const {
  v1::JoinRequest request;
  request.set_worker_id(config_.worker_id);
  request.set_session_id(name_);
  request.set_host(HostName());
  request.set_version(kVersion);
  request.set_protocol(kProtocol);
  request.set_threads(
      static_cast<uint32_t>(config_.threads > 0 ? config_.threads : HardwareThreads()));
  for (const std::string& tag : config_.tags) request.add_tag(tag);
  for (const std::string& session : config_.ended) request.add_ended(session);
  return request;
}

void Session::AddHeld(v1::JoinRequest* request) const {
  request->clear_holding();
  for (const std::shared_ptr<Lease>& lease : held_.All()) {
    v1::JoinRequest::Holding& holding = *request->add_holding();
    *holding.mutable_attempt() = lease->grant.attempt();
    *holding.mutable_unit() = lease->grant.unit();
  }
}

// Extends the leases that the coordinator has taken over, loses the others; returns how many are
// kept.
size_t Session::KeepAdopted(const v1::JoinRequest& request, const v1::JoinResponse& response,
                            Time sent) {
  std::vector<AttemptKey> adopted;
  for (const v1::Attempt& attempt : response.adopted()) {
    adopted.push_back(KeyOf(attempt));
    held_.Extend(attempt, sent, milliseconds(response.term_ms()));
  }
  for (const v1::JoinRequest::Holding& holding : request.holding()) {
    const AttemptKey key = KeyOf(holding.attempt());
    if (std::find(adopted.begin(), adopted.end(), key) == adopted.end()) {
      held_.Lose(holding.attempt());
    }
  }
  return adopted.size();
}

// False: stopped. Does nothing if another thread has joined since `seen_joins` were counted.
bool Session::JoinUnlessJoinedSince(uint64_t seen_joins) {
  const std::lock_guard lock(join_mutex_);
  if (joins_ != seen_joins) return true;
  v1::JoinRequest request = JoinRequestOfThisWorker();
  const Time first_asked = steady_clock::now();
  Time sent;
  v1::JoinResponse response;
  const Sent answer = Ask(
      Rpc::kJoin,
      [&] {
        AddHeld(&request);
        sent = steady_clock::now();
        request.set_waited_ms(static_cast<uint32_t>(
            std::chrono::duration_cast<milliseconds>(sent - first_asked).count()));
        return client_.Join(request);
      },
      &response);
  if (answer != Sent::kAnswered) return false;
  term_ms_ = response.term_ms();
  renew_ms_ = std::max<uint32_t>(response.renew_every_ms(), 1);
  const size_t kept = KeepAdopted(request, response, sent);
  ++joins_;
  spdlog::info("joined {} as {} (epoch {}, {} of {} leases kept)", config_.server,
               Printable(config_.worker_id), response.epoch(), kept, request.holding_size());
  return true;
}

}  // namespace fjord::worker
