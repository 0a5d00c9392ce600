#include "server/watch_call.h"

#include "server/rpc_status.h"
#include "server/validate.h"
#include "server/views.h"

namespace fjord::server {
namespace {

grpc::Status NoSuchJob(JobId id) {
  return {grpc::StatusCode::NOT_FOUND, "job_id: there is no job " + std::to_string(id)};
}

constexpr int kMostChanged = 1'000;  // frames in one message

}  // namespace

WatchCall::WatchCall(Coordinator& coordinator, const v1::WatchRequest& request)
    : coordinator_(coordinator) {
  if (const Objection objection = Validate(request)) {
    Finish(ToStatus(*objection));
    return;
  }
  job_ = *ParseJobId(request.job_id());
  if (!coordinator_.Post([this](Machine& machine, Now) { Begin(machine); })) Finish(BusyStatus());
}

void WatchCall::Begin(const Machine& machine) {
  if (ended_) return;
  const Job* job = machine.FindJob(job_);
  if (job == nullptr) {
    return End(NoSuchJob(job_));
  }
  if (!coordinator_.Watch(job_, this)) return End(BusyStatus());
  for (uint32_t index = 0; index < job->frames.size(); ++index) {
    if (job->frames[index].state != FrameState::kWaiting) pending_.insert(index);
  }
  dirty_ = true;
  SendIfDue(machine);
}

void WatchCall::Changed(const Machine& machine, const std::set<uint32_t>& frames) {
  pending_.insert(frames.begin(), frames.end());
  dirty_ = true;
  SendIfDue(machine);
}

void WatchCall::SendIfDue(const Machine& machine) {
  if (writing_ || ended_ || !dirty_) return;
  if (machine.FindJob(job_) == nullptr) return End(NoSuchJob(job_));
  const Job& job = *machine.FindJob(job_);
  message_.Clear();
  *message_.mutable_job() = ViewJob(machine, job);
  message_.set_workers(static_cast<uint32_t>(machine.roster().AliveCount()));
  size_t bytes = 0;
  while (!pending_.empty() && message_.changed_size() < kMostChanged && bytes < kPageBytes) {
    *message_.add_changed() = ViewFrame(machine, job, *pending_.begin());
    bytes += message_.changed(message_.changed_size() - 1).ByteSizeLong();
    pending_.erase(pending_.begin());
  }
  dirty_ = !pending_.empty();
  last_ = job.ended() && !dirty_;
  writing_ = true;
  // Nothing is shown that could still be lost.
  coordinator_.AfterCommit([this](const Result<>& committed) {
    if (committed.ok()) return StartWrite(&message_);
    coordinator_.PostInner([this, status = ToStatus(committed.error())](Machine&, Now) {
      writing_ = false;
      End(status);
    });
  });
}

void WatchCall::OnWriteDone(bool ok) {
  coordinator_.PostInner([this, ok](Machine& machine, Now) {
    writing_ = false;
    if (ended_) {
      Finish(status_);
    } else if (!ok) {
      End(grpc::Status::CANCELLED);
    } else if (last_ && !dirty_) {
      End(grpc::Status::OK);
    } else {
      SendIfDue(machine);
    }
  });
}

void WatchCall::OnCancel() {
  coordinator_.PostInner([this](Machine&, Now) { End(grpc::Status::CANCELLED); });
}

void WatchCall::Closed() {
  End(ToStatus(Refusal{Code::kUnavailable, "the coordinator is stopping"}));
}

void WatchCall::End(const grpc::Status& status) {
  if (ended_) return;
  ended_ = true;
  status_ = status;
  coordinator_.Unwatch(job_, this);
  if (!writing_) Finish(status_);
}

}  // namespace fjord::server
