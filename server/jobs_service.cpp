#include "server/jobs_service.h"

#include <algorithm>

#include "server/submit.h"
#include "server/unary.h"
#include "server/views.h"
#include "server/watch_call.h"

namespace fjord::server {
namespace {

constexpr uint32_t kDefaultPage = 100;
constexpr uint32_t kMostFrames = 1'000;

Objection NoJob(const std::string& id) {
  return Refusal{Code::kNotFound, "job_id: there is no job " + id};
}

// A reactor that is finished already where the request is not valid.
template <typename Request>
grpc::ServerUnaryReactor* Begin(grpc::CallbackServerContext* context, const Request& request,
                                bool* go) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  const Objection objection = Validate(request);
  if (objection) reactor->Finish(ToStatus(*objection));
  *go = !objection;
  return reactor;
}

}  // namespace

grpc::ServerUnaryReactor* JobsService::Submit(grpc::CallbackServerContext* context,
                                              const v1::SubmitRequest* request,
                                              v1::SubmitResponse* response) {
  bool go = false;
  grpc::ServerUnaryReactor* reactor = Begin(context, *request, &go);
  if (go && !pool_.Post([=, this] { SubmitChecked(*request, response, reactor); })) {
    reactor->Finish(BusyStatus());
  }
  return reactor;
}

void JobsService::SubmitChecked(const v1::SubmitRequest& request, v1::SubmitResponse* response,
                                grpc::ServerUnaryReactor* reactor) {
  Objection refusal;
  const Answer<JobSpec> submission = ReadSubmission(request, blobs_);
  const JobSpec* spec = ValueOf(submission, refusal);
  if (spec == nullptr) return reactor->Finish(ToStatus(*refusal));
  AnswerAfterCommit(coordinator_, reactor, [spec = *spec, response](Machine& machine, Now now) {
    Objection refused;
    const auto answer = machine.Submit(spec, now);
    if (const auto* submitted = ValueOf(answer, refused)) {
      response->set_job_id(std::to_string(submitted->id));
      response->set_existed(submitted->existed);
    }
    return refused;
  });
}

grpc::ServerUnaryReactor* JobsService::GetJob(grpc::CallbackServerContext* context,
                                              const v1::GetJobRequest* request, v1::Job* response) {
  bool go = false;
  grpc::ServerUnaryReactor* reactor = Begin(context, *request, &go);
  if (!go) return reactor;
  AnswerAfterCommit(coordinator_, reactor,
                    [id = request->job_id(), response](Machine& machine, Now) -> Objection {
                      const Job* job = machine.FindJob(*ParseJobId(id));
                      if (job == nullptr) return NoJob(id);
                      *response = ViewJob(machine, *job);
                      return std::nullopt;
                    });
  return reactor;
}

grpc::ServerUnaryReactor* JobsService::ListJobs(grpc::CallbackServerContext* context,
                                                const v1::ListJobsRequest* request,
                                                v1::ListJobsResponse* response) {
  bool go = false;
  grpc::ServerUnaryReactor* reactor = Begin(context, *request, &go);
  if (!go) return reactor;
  const uint32_t size = request->page_size() == 0 ? kDefaultPage : request->page_size();
  const JobId from = request->page_token().empty() ? 1 : *ParseJobId(request->page_token());
  AnswerAfterCommit(coordinator_, reactor, [=](Machine& machine, Now) -> Objection {
    response->set_trouble(machine.trouble());
    size_t bytes = 0;
    for (auto job = machine.jobs().lower_bound(from); job != machine.jobs().end(); ++job) {
      if (response->job_size() == static_cast<int>(size) || bytes > kPageBytes) {
        response->set_next_page_token(std::to_string(job->first));
        break;
      }
      *response->add_job() = ViewJob(machine, job->second);
      bytes += response->job(response->job_size() - 1).ByteSizeLong();
    }
    return std::nullopt;
  });
  return reactor;
}

grpc::ServerUnaryReactor* JobsService::ListFrames(grpc::CallbackServerContext* context,
                                                  const v1::ListFramesRequest* request,
                                                  v1::ListFramesResponse* response) {
  bool go = false;
  grpc::ServerUnaryReactor* reactor = Begin(context, *request, &go);
  if (!go) return reactor;
  const uint32_t size = request->page_size() == 0 ? kMostFrames : request->page_size();
  AnswerAfterCommit(
      coordinator_, reactor,
      [id = request->job_id(), from = request->from_frame(), size, response](Machine& machine,
                                                                             Now) -> Objection {
        const Job* job = machine.FindJob(*ParseJobId(id));
        if (job == nullptr) return NoJob(id);
        uint32_t index = job->row.spec.frames.IndexFrom(from);
        size_t bytes = 0;
        for (; index < job->frames.size(); ++index) {
          if (response->frame_size() == static_cast<int>(size) || bytes > kPageBytes) {
            response->set_next_frame(job->FrameNumber(index));
            break;
          }
          *response->add_frame() = ViewFrame(machine, *job, index);
          bytes += response->frame(response->frame_size() - 1).ByteSizeLong();
        }
        return std::nullopt;
      });
  return reactor;
}

grpc::ServerWriteReactor<v1::WatchResponse>* JobsService::Watch(grpc::CallbackServerContext*,
                                                                const v1::WatchRequest* request) {
  return new WatchCall(coordinator_, *request);
}

grpc::ServerUnaryReactor* JobsService::Command(grpc::CallbackServerContext* context,
                                               const v1::CommandRequest* request,
                                               v1::Job* response) {
  bool go = false;
  grpc::ServerUnaryReactor* reactor = Begin(context, *request, &go);
  if (!go) return reactor;
  AnswerAfterCommit(
      coordinator_, reactor,
      [id = *ParseJobId(request->job_id()), kind = static_cast<JobCommand>(request->kind()),
       priority = request->priority(), response](Machine& machine, Now now) {
        Objection refusal;
        if (const Job* job = machine.FindJob(id); kind == JobCommand::kDelete && job != nullptr) {
          *response = ViewJob(machine, *job);  // as it was
        }
        const auto answer = machine.Command(id, kind, priority, now);
        if (ValueOf(answer, refusal) && kind != JobCommand::kDelete) {
          *response = ViewJob(machine, *machine.FindJob(id));
        }
        return refusal;
      });
  return reactor;
}

grpc::ServerUnaryReactor* JobsService::ListWorkers(grpc::CallbackServerContext* context,
                                                   const v1::ListWorkersRequest*,
                                                   v1::ListWorkersResponse* response) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  AnswerAfterCommit(coordinator_, reactor, [response](Machine& machine, Now) -> Objection {
    response->set_trouble(machine.trouble());
    for (const auto& [id, worker] : machine.roster().workers()) {
      *response->add_worker() = ViewWorker(machine, worker);
    }
    return std::nullopt;
  });
  return reactor;
}

grpc::ServerUnaryReactor* JobsService::CommandWorker(grpc::CallbackServerContext* context,
                                                     const v1::CommandWorkerRequest* request,
                                                     v1::WorkerInfo* response) {
  bool go = false;
  grpc::ServerUnaryReactor* reactor = Begin(context, *request, &go);
  if (!go) return reactor;
  AnswerAfterCommit(coordinator_, reactor,
                    [id = request->worker_id(), kind = static_cast<WorkerCommand>(request->kind()),
                     response](Machine& machine, Now now) {
                      Objection refusal;
                      const auto answer = machine.CommandWorker(id, kind, now);
                      if (ValueOf(answer, refusal)) {
                        *response = ViewWorker(machine, *machine.roster().FindWorker(id));
                      }
                      return refusal;
                    });
  return reactor;
}

}  // namespace fjord::server
