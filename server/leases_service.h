// fjord.v1.Leases: what workers say, brought to the actor.
#pragma once

#include "fjord/v1/leases.grpc.pb.h"
#include "server/blob_store.h"
#include "server/coordinator.h"

namespace fjord::server {

class LeasesService : public v1::Leases::CallbackService {
 public:
  LeasesService(Coordinator& coordinator, const BlobStore& blobs)
      : coordinator_(coordinator), blobs_(blobs) {}

  grpc::ServerUnaryReactor* Join(grpc::CallbackServerContext* context,
                                 const v1::JoinRequest* request,
                                 v1::JoinResponse* response) override;
  grpc::ServerUnaryReactor* Acquire(grpc::CallbackServerContext* context,
                                    const v1::AcquireRequest* request,
                                    v1::AcquireResponse* response) override;
  grpc::ServerUnaryReactor* Renew(grpc::CallbackServerContext* context,
                                  const v1::RenewRequest* request,
                                  v1::RenewResponse* response) override;
  grpc::ServerUnaryReactor* Complete(grpc::CallbackServerContext* context,
                                     const v1::CompleteRequest* request,
                                     v1::CompleteResponse* response) override;
  grpc::ServerUnaryReactor* Fail(grpc::CallbackServerContext* context,
                                 const v1::FailRequest* request,
                                 v1::FailResponse* response) override;
  grpc::ServerUnaryReactor* Leave(grpc::CallbackServerContext* context,
                                  const v1::LeaveRequest* request,
                                  v1::LeaveResponse* response) override;

 private:
  Coordinator& coordinator_;
  const BlobStore& blobs_;
};

}  // namespace fjord::server
