// fjord.v1.Jobs: what clients say, brought to the actor.
#pragma once

#include "fjord/v1/jobs.grpc.pb.h"
#include "server/blob_store.h"
#include "server/coordinator.h"
#include "server/io_pool.h"

namespace fjord::server {

class JobsService : public v1::Jobs::CallbackService {
 public:
  JobsService(Coordinator& coordinator, BlobStore& blobs, IoPool& pool)
      : coordinator_(coordinator), blobs_(blobs), pool_(pool) {}

  grpc::ServerUnaryReactor* Submit(grpc::CallbackServerContext* context,
                                   const v1::SubmitRequest* request,
                                   v1::SubmitResponse* response) override;
  grpc::ServerUnaryReactor* GetJob(grpc::CallbackServerContext* context,
                                   const v1::GetJobRequest* request, v1::Job* response) override;
  grpc::ServerUnaryReactor* ListJobs(grpc::CallbackServerContext* context,
                                     const v1::ListJobsRequest* request,
                                     v1::ListJobsResponse* response) override;
  grpc::ServerUnaryReactor* ListFrames(grpc::CallbackServerContext* context,
                                       const v1::ListFramesRequest* request,
                                       v1::ListFramesResponse* response) override;
  grpc::ServerWriteReactor<v1::WatchResponse>* Watch(grpc::CallbackServerContext* context,
                                                     const v1::WatchRequest* request) override;
  grpc::ServerUnaryReactor* Command(grpc::CallbackServerContext* context,
                                    const v1::CommandRequest* request, v1::Job* response) override;
  grpc::ServerUnaryReactor* ListWorkers(grpc::CallbackServerContext* context,
                                        const v1::ListWorkersRequest* request,
                                        v1::ListWorkersResponse* response) override;
  grpc::ServerUnaryReactor* CommandWorker(grpc::CallbackServerContext* context,
                                          const v1::CommandWorkerRequest* request,
                                          v1::WorkerInfo* response) override;

 private:
  void SubmitChecked(const v1::SubmitRequest& request, v1::SubmitResponse* response,
                     grpc::ServerUnaryReactor* reactor);

  Coordinator& coordinator_;
  BlobStore& blobs_;
  IoPool& pool_;
};

}  // namespace fjord::server
