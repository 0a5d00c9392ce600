// Retrying as values: how long to wait, and what each status code means for each call. docs/wire.md
// has the same table for people; tests walk all codes.
#pragma once

#include <grpcpp/support/status.h>

#include <chrono>
#include <cstdint>

namespace fjord::worker {

enum class Rpc : uint8_t { kJoin, kAcquire, kRenew, kComplete, kFail, kLeave, kPut, kGet };

enum class Act : uint8_t {
  kDone,       // answered
  kRetry,      // ask again after a pause: the other side is away, busy or stopping
  kJoinAgain,  // the coordinator does not know the session: join, then ask again
  kNext,       // this request number is used up: ask with the next
  kDrop,       // final for this unit alone: give it up
  kStop,       // final for this worker: end with the message
};

Act ActOn(Rpc rpc, grpc::StatusCode code);

// Pauses that double from `min` to `max`, each drawn from the upper half of its length, so that
// many workers do not come back at one moment.
class Backoff {
 public:
  Backoff(std::chrono::milliseconds min, std::chrono::milliseconds max, uint64_t seed)
      : min_(min), max_(max), next_(min), state_(seed | 1) {}

  std::chrono::milliseconds Next();
  void Reset() { next_ = min_; }

 private:
  const std::chrono::milliseconds min_;
  const std::chrono::milliseconds max_;
  std::chrono::milliseconds next_;
  uint64_t state_;
};

}  // namespace fjord::worker
