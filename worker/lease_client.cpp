#include "worker/lease_client.h"

#include <mutex>
#include <set>

namespace fjord::worker {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kDeadline{10'000};
constexpr milliseconds kLeaveDeadline{2'000};

class GrpcLeaseClient : public LeaseClient {
 public:
  explicit GrpcLeaseClient(std::shared_ptr<grpc::Channel> channel)
      : stub_(v1::Leases::NewStub(std::move(channel))) {}

  Reply<v1::JoinResponse> Join(const v1::JoinRequest& request) override {
    return Call<v1::JoinResponse>(&v1::Leases::Stub::Join, request, kDeadline);
  }
  Reply<v1::AcquireResponse> Acquire(const v1::AcquireRequest& request) override {
    return Call<v1::AcquireResponse>(&v1::Leases::Stub::Acquire, request,
                                     milliseconds(request.wait_ms()) + kDeadline);
  }
  Reply<v1::RenewResponse> Renew(const v1::RenewRequest& request) override {
    return Call<v1::RenewResponse>(&v1::Leases::Stub::Renew, request, kDeadline);
  }
  Reply<v1::CompleteResponse> Complete(const v1::CompleteRequest& request) override {
    return Call<v1::CompleteResponse>(&v1::Leases::Stub::Complete, request, kDeadline);
  }
  Reply<v1::FailResponse> Fail(const v1::FailRequest& request) override {
    return Call<v1::FailResponse>(&v1::Leases::Stub::Fail, request, kDeadline);
  }
  Reply<v1::LeaveResponse> Leave(const v1::LeaveRequest& request) override {
    return Call<v1::LeaveResponse>(&v1::Leases::Stub::Leave, request, kLeaveDeadline, true);
  }
  void Shutdown() override {
    const std::lock_guard lock(mutex_);
    shut_ = true;
    for (grpc::ClientContext* context : calls_) context->TryCancel();
  }

 private:
  template <typename Response, typename Request>
  Reply<Response> Call(grpc::Status (v1::Leases::Stub::*method)(grpc::ClientContext*,
                                                                const Request&, Response*),
                       const Request& request, milliseconds deadline, bool always = false) {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + deadline);
    {
      const std::lock_guard lock(mutex_);
      if (shut_ && !always) return {{grpc::StatusCode::CANCELLED, "the worker is stopping"}, {}};
      calls_.insert(&context);
    }
    Reply<Response> reply;
    reply.status = ((*stub_).*method)(&context, request, &reply.value);
    const std::lock_guard lock(mutex_);
    calls_.erase(&context);
    return reply;
  }

  const std::unique_ptr<v1::Leases::Stub> stub_;
  std::mutex mutex_;
  std::set<grpc::ClientContext*> calls_;
  bool shut_ = false;
};

}  // namespace

std::unique_ptr<LeaseClient> MakeGrpcLeaseClient(std::shared_ptr<grpc::Channel> channel) {
  return std::make_unique<GrpcLeaseClient>(std::move(channel));
}

}  // namespace fjord::worker
