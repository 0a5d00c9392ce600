// Unary calls that are answered by the actor.
#pragma once

#include <grpcpp/grpcpp.h>

#include <functional>
#include <variant>

#include "server/coordinator.h"
#include "server/rpc_status.h"
#include "server/validate.h"

namespace fjord::server {

// Runs `work` on the actor and lets what it answers leave after the commit of what it rests on.
// `work` fills the response and returns a refusal or nothing.
template <typename Work>
void AnswerAfterCommit(Coordinator& coordinator, grpc::ServerUnaryReactor* reactor, Work work) {
  const bool taken = coordinator.Post(
      [&coordinator, reactor, work = std::move(work)](Machine& machine, Now now) mutable {
        const Objection refusal = work(machine, now);
        const grpc::Status status = refusal ? ToStatus(*refusal) : grpc::Status::OK;
        coordinator.AfterCommit([reactor, status](const Result<>& committed) {
          reactor->Finish(committed.ok() ? status : ToStatus(committed.error()));
        });
      });
  if (!taken) reactor->Finish(BusyStatus());
}

// The value, or the refusal in `refusal`.
template <typename T>
const T* ValueOf(const Answer<T>& answer, Objection& refusal) {
  if (const Refusal* refused = std::get_if<Refusal>(&answer)) refusal = *refused;
  return std::get_if<T>(&answer);
}

}  // namespace fjord::server
