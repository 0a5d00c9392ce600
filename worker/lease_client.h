// What a worker says to the coordinator. Blocking calls with deadlines; thread-safe.
#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <memory>
#include <string>

#include "fjord/v1/leases.grpc.pb.h"

namespace fjord::worker {

template <typename T>
struct Reply {
  grpc::Status status;
  T value;
};

class LeaseClient {
 public:
  virtual ~LeaseClient() = default;
  virtual Reply<v1::JoinResponse> Join(const v1::JoinRequest& request) = 0;
  virtual Reply<v1::AcquireResponse> Acquire(const v1::AcquireRequest& request) = 0;
  virtual Reply<v1::RenewResponse> Renew(const v1::RenewRequest& request) = 0;
  virtual Reply<v1::CompleteResponse> Complete(const v1::CompleteRequest& request) = 0;
  virtual Reply<v1::FailResponse> Fail(const v1::FailRequest& request) = 0;
  virtual Reply<v1::LeaveResponse> Leave(const v1::LeaveRequest& request) = 0;
  // Ends the calls that wait and refuses all later ones but Leave, from any thread.
  virtual void Shutdown() = 0;
};

std::unique_ptr<LeaseClient> MakeGrpcLeaseClient(std::shared_ptr<grpc::Channel> channel);

}  // namespace fjord::worker
