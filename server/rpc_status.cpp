#include "server/rpc_status.h"

namespace fjord::server {

grpc::Status ToStatus(const Refusal& refusal) {
  const auto code = [&] {
    switch (refusal.code) {
      case Code::kInvalid:
        return grpc::StatusCode::INVALID_ARGUMENT;
      case Code::kNotFound:
        return grpc::StatusCode::NOT_FOUND;
      case Code::kExists:
        return grpc::StatusCode::ALREADY_EXISTS;
      case Code::kPrecondition:
        return grpc::StatusCode::FAILED_PRECONDITION;
      case Code::kDenied:
        return grpc::StatusCode::PERMISSION_DENIED;
      case Code::kAborted:
        return grpc::StatusCode::ABORTED;
      case Code::kLimit:
        return grpc::StatusCode::RESOURCE_EXHAUSTED;
      case Code::kUnavailable:
        break;
    }
    return grpc::StatusCode::UNAVAILABLE;
  };
  return {code(), refusal.message};
}

grpc::Status ToStatus(const Error& error) {
  const auto code = [&] {
    switch (error.code) {
      case ErrorCode::kInvalid:
      case ErrorCode::kUsage:
        return grpc::StatusCode::INVALID_ARGUMENT;
      case ErrorCode::kNotFound:
        return grpc::StatusCode::NOT_FOUND;
      case ErrorCode::kLimit:
        return grpc::StatusCode::RESOURCE_EXHAUSTED;
      case ErrorCode::kCancelled:
        return grpc::StatusCode::CANCELLED;
      case ErrorCode::kIo:
      case ErrorCode::kUnavailable:
        return grpc::StatusCode::UNAVAILABLE;
      case ErrorCode::kInternal:
        break;
    }
    return grpc::StatusCode::INTERNAL;
  };
  return {code(), error.message};
}

grpc::Status BusyStatus() {
  return {grpc::StatusCode::RESOURCE_EXHAUSTED,
          "the coordinator has more to do than it can hold, or is stopping: try again"};
}

}  // namespace fjord::server
