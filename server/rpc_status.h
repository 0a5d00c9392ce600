// From refusals and errors to gRPC's statuses: the one place.
#pragma once

#include <grpcpp/support/status.h>

#include "engine/base/result.h"
#include "server/state/types.h"

namespace fjord::server {

grpc::Status ToStatus(const Refusal& refusal);
grpc::Status ToStatus(const Error& error);
// Of a queue that is full or closed.
grpc::Status BusyStatus();

}  // namespace fjord::server
