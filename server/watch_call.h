// One Watch stream. Newest wins: while a message is on its way, changes gather; the next message
// carries the job as it is then and the frames that changed. All members are touched on the actor's
// thread only, but for the message under way.
#pragma once

#include <grpcpp/grpcpp.h>

#include <set>

#include "fjord/v1/jobs.pb.h"
#include "server/coordinator.h"

namespace fjord::server {

class WatchCall : public grpc::ServerWriteReactor<v1::WatchResponse>, public Watcher {
 public:
  WatchCall(Coordinator& coordinator, const v1::WatchRequest& request);

  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  // Through the actor: tasks posted before still find the call.
  void OnDone() override {
    coordinator_.PostInner([this](Machine&, Now) { delete this; });
  }

  void Changed(const Machine& machine, const std::set<uint32_t>& frames) override;
  void Closed() override;

 private:
  void Begin(const Machine& machine);
  void SendIfDue(const Machine& machine);
  void End(const grpc::Status& status);

  Coordinator& coordinator_;
  JobId job_ = 0;
  std::set<uint32_t> pending_;  // frames (indexes) not sent yet
  bool dirty_ = false;
  bool writing_ = false;
  bool last_ = false;   // what is on its way says that the job has ended
  bool ended_ = false;  // Finish was called, or will be when the write is done
  grpc::Status status_;
  v1::WatchResponse message_;
};

}  // namespace fjord::server
