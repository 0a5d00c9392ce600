#include "worker/retry.h"

#include <algorithm>

namespace fjord::worker {

Act ActOn(Rpc rpc, grpc::StatusCode code) {
  const bool about_unit =
      rpc == Rpc::kComplete || rpc == Rpc::kFail || rpc == Rpc::kPut || rpc == Rpc::kGet;
  switch (code) {
    case grpc::StatusCode::OK:
      return Act::kDone;
    case grpc::StatusCode::ABORTED:
      return rpc == Rpc::kAcquire ? Act::kNext : Act::kRetry;
    case grpc::StatusCode::NOT_FOUND:
      return rpc == Rpc::kPut || rpc == Rpc::kGet ? Act::kDrop
             : rpc == Rpc::kJoin                  ? Act::kStop
                                                  : Act::kJoinAgain;
    case grpc::StatusCode::UNAVAILABLE:
    case grpc::StatusCode::DEADLINE_EXCEEDED:
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
    case grpc::StatusCode::CANCELLED:
    case grpc::StatusCode::UNKNOWN:
    case grpc::StatusCode::INTERNAL:
      return Act::kRetry;
    case grpc::StatusCode::INVALID_ARGUMENT:
    case grpc::StatusCode::ALREADY_EXISTS:
    case grpc::StatusCode::OUT_OF_RANGE:
    case grpc::StatusCode::DATA_LOSS:
    case grpc::StatusCode::PERMISSION_DENIED:
      return about_unit ? Act::kDrop : Act::kStop;
    case grpc::StatusCode::FAILED_PRECONDITION:
    case grpc::StatusCode::UNIMPLEMENTED:
    case grpc::StatusCode::UNAUTHENTICATED:
    case grpc::StatusCode::DO_NOT_USE:
      break;
  }
  return Act::kStop;
}

std::chrono::milliseconds Backoff::Next() {
  const std::chrono::milliseconds pause = next_;
  next_ = std::min(next_ * 2, max_);
  state_ ^= state_ << 13;
  state_ ^= state_ >> 7;
  state_ ^= state_ << 17;
  const int64_t half = pause.count() / 2;
  return std::chrono::milliseconds(half + static_cast<int64_t>(state_ % (half + 1)));
}

}  // namespace fjord::worker
