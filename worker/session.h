// A worker's conversation with the coordinator: who the worker is, joining (again, when the
// coordinator does not know it), asking until there is an answer, and the end, of which every
// thread of the worker hears through stop_token(). Thread-safe.
//
// N1 One thread joins at a time, and no thread joins again for what another has repaired.
// N2 After End no call is retried, and nothing waits in here.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "worker/held.h"
#include "worker/lease_client.h"
#include "worker/retry.h"

namespace fjord::worker {

// Between two tries of one call.
inline constexpr std::chrono::milliseconds kFirstPause{50};
inline constexpr std::chrono::milliseconds kLongestPause{500};

struct SessionConfig {
  std::string server;
  std::string worker_id;
  int threads = 0;  // of one frame; 0: one a core
  std::vector<std::string> tags;
  std::string session;             // empty: a random name
  std::vector<std::string> ended;  // sessions of earlier processes of this worker, known to be over
};

class Session {
 public:
  // What became of a call.
  enum class Sent : uint8_t { kAnswered, kDropped, kStopped };

  // `client` and `held` outlive the session.
  Session(SessionConfig config, LeaseClient& client, HeldLeases& held);

  const std::string& name() const { return name_; }
  LeaseClient& client() { return client_; }
  bool has_joined() const { return joins_ > 0; }
  std::chrono::milliseconds term() const { return std::chrono::milliseconds(term_ms_); }
  std::chrono::milliseconds renew_every() const { return std::chrono::milliseconds(renew_ms_); }
  Backoff NewBackoff() const;

  // Joins for the first time. False: stopped.
  bool Join() { return JoinUnlessJoinedSince(0); }

  // Calls, and calls again as the table in docs/wire.md says, until there is an answer.
  template <typename Response, typename Call>
  Sent Ask(Rpc rpc, Call call, Response* response) {
    Trouble trouble{NewBackoff()};
    while (!stopping()) {
      const uint64_t joins = joins_;
      Reply<Response> reply = call();
      if (const std::optional<Sent> sent = Judge(rpc, reply.status, joins, &trouble)) {
        *response = std::move(reply.value);
        return *sent;
      }
    }
    return Sent::kStopped;
  }

  // Calls once: where the call would be repeated, the answer is kDropped.
  template <typename Response, typename Call>
  Sent AskOnce(Rpc rpc, Call call, Response* response) {
    const uint64_t joins = joins_;
    Reply<Response> reply = call();
    *response = std::move(reply.value);
    return JudgeOnce(rpc, reply.status, joins);
  }

  // Waits. False: stopped.
  bool Pause(std::chrono::milliseconds length);

  // The first end counts. It stops every thread of the worker.
  void End(Result<> result);
  std::stop_token stop_token() const { return stop_.get_token(); }
  bool stopping() const { return stop_.stop_requested(); }
  Result<> WaitForEnd();
  // None: not ended within `length`.
  std::optional<Result<>> WaitForEnd(std::chrono::milliseconds length);

 private:
  // Of one call that is asked again and again.
  struct Trouble {
    Backoff backoff;
    bool said = false;
    bool waits = false;  // for another session of this worker to be heard of, or gone
  };

  std::optional<Sent> Judge(Rpc rpc, const grpc::Status& status, uint64_t joins, Trouble* trouble);
  Sent JudgeOnce(Rpc rpc, const grpc::Status& status, uint64_t joins);
  void Refuse(const grpc::Status& status);
  bool JoinUnlessJoinedSince(uint64_t seen_joins);
  v1::JoinRequest JoinRequestOfThisWorker() const;
  void AddHeld(v1::JoinRequest* request) const;
  size_t KeepAdopted(const v1::JoinRequest& request, const v1::JoinResponse& response, Time sent);

  const SessionConfig config_;
  const std::string name_;
  LeaseClient& client_;
  HeldLeases& held_;
  std::stop_source stop_;

  std::mutex join_mutex_;  // held by the one thread that joins
  std::atomic<uint64_t> joins_{0};
  std::atomic<int64_t> term_ms_{10'000};
  std::atomic<int64_t> renew_ms_{1'000};

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::optional<Result<>> ended_;  // guarded by mutex_
};

}  // namespace fjord::worker
