// The state as the messages show it. Pure.
#pragma once

#include "fjord/v1/jobs.pb.h"
#include "server/state/machine.h"

namespace fjord::server {

// A page ends when it has grown to this, however few its entries: messages stay well below the
// limit.
inline constexpr size_t kPageBytes = size_t{1} << 20;

v1::Job ViewJob(const Machine& machine, const Job& job);
v1::Frame ViewFrame(const Machine& machine, const Job& job, uint32_t index);
v1::WorkerInfo ViewWorker(const Machine& machine, const Worker& worker);

}  // namespace fjord::server
