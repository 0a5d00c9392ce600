// Talking to a coordinator as clients and workers do, one blocking call a line.
#pragma once

#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>
#include <vector>

#include "engine/base/digest.h"
#include "fjord/v1/blobs.grpc.pb.h"
#include "fjord/v1/jobs.grpc.pb.h"
#include "fjord/v1/leases.grpc.pb.h"
#include "fjord/v1/scene.pb.h"
#include "proto/fjord/protocol.h"

namespace fjord::farm_test {

template <typename T>
struct Said {
  grpc::Status status;
  T value;
  bool ok() const { return status.ok(); }
  grpc::StatusCode code() const { return status.error_code(); }
};

class Talk {
 public:
  explicit Talk(const std::string& address) {
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
    channel_ = grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
    jobs_ = v1::Jobs::NewStub(channel_);
    leases_ = v1::Leases::NewStub(channel_);
    blobs_ = v1::Blobs::NewStub(channel_);
  }
  const std::shared_ptr<grpc::Channel>& channel() const { return channel_; }
  v1::Jobs::Stub& jobs() { return *jobs_; }

  // --- blobs ---
  grpc::Status Put(const std::string& digest, uint64_t size, const std::vector<std::string>& chunks,
                   bool* existed = nullptr) {
    grpc::ClientContext context;
    Deadline(context);
    v1::PutBlobResponse response;
    const auto writer = blobs_->Put(&context, &response);
    v1::PutBlobRequest request;
    request.set_digest(digest);
    request.set_size(size);
    for (const std::string& chunk : chunks) {
      request.set_data(chunk);
      if (!writer->Write(request)) break;
      request.Clear();
    }
    writer->WritesDone();
    const grpc::Status status = writer->Finish();
    if (existed != nullptr) *existed = response.existed();
    return status;
  }
  std::string PutBytes(const std::string& bytes) {
    const std::string digest = Sha256Of(bytes).Hex();
    const grpc::Status status = Put(digest, bytes.size(), {bytes});
    return status.ok() ? digest : "error: " + status.error_message();
  }
  Said<std::string> Get(const std::string& digest) {
    grpc::ClientContext context;
    Deadline(context);
    v1::GetBlobRequest request;
    request.set_digest(digest);
    const auto reader = blobs_->Get(&context, request);
    v1::GetBlobResponse response;
    Said<std::string> said;
    while (reader->Read(&response)) said.value += response.data();
    said.status = reader->Finish();
    return said;
  }
  Said<v1::MissingResponse> Missing(const std::vector<std::string>& digests) {
    v1::MissingRequest request;
    for (const std::string& digest : digests) request.add_digest(digest);
    return Call<v1::MissingResponse>(*blobs_, &v1::Blobs::Stub::Missing, request);
  }

  // --- jobs ---
  Said<v1::SubmitResponse> Submit(const v1::SubmitRequest& request) {
    return Call<v1::SubmitResponse>(*jobs_, &v1::Jobs::Stub::Submit, request);
  }
  // A scene of so many frames that only a test's planner can plan.
  Said<v1::SubmitResponse> SubmitFrames(uint32_t frames, const std::string& id = "r") {
    v1::Scene scene;
    scene.set_name("test");
    scene.mutable_output()->set_frames(frames);
    v1::SubmitRequest request;
    request.set_protocol(kProtocol);
    request.set_request_id(id);
    request.set_scene_digest(PutBytes(scene.SerializeAsString()));
    return Submit(request);
  }
  Said<v1::Job> GetJob(const std::string& id) {
    v1::GetJobRequest request;
    request.set_job_id(id);
    return Call<v1::Job>(*jobs_, &v1::Jobs::Stub::GetJob, request);
  }
  Said<v1::ListFramesResponse> Frames(const std::string& id, uint32_t from = 0, uint32_t size = 0) {
    v1::ListFramesRequest request;
    request.set_job_id(id);
    request.set_from_frame(from);
    request.set_page_size(size);
    return Call<v1::ListFramesResponse>(*jobs_, &v1::Jobs::Stub::ListFrames, request);
  }
  Said<v1::ListJobsResponse> Jobs(uint32_t size = 0, const std::string& token = "") {
    v1::ListJobsRequest request;
    request.set_page_size(size);
    request.set_page_token(token);
    return Call<v1::ListJobsResponse>(*jobs_, &v1::Jobs::Stub::ListJobs, request);
  }
  Said<v1::Job> Command(const std::string& id, v1::CommandRequest::Kind kind) {
    v1::CommandRequest request;
    request.set_job_id(id);
    request.set_kind(kind);
    return Call<v1::Job>(*jobs_, &v1::Jobs::Stub::Command, request);
  }
  Said<v1::ListWorkersResponse> Workers() {
    return Call<v1::ListWorkersResponse>(*jobs_, &v1::Jobs::Stub::ListWorkers, {});
  }
  // Follows the job until it ends; every message seen.
  Said<std::vector<v1::WatchResponse>> WatchToTheEnd(const std::string& id, int seconds = 60) {
    grpc::ClientContext context;
    Deadline(context, seconds);
    v1::WatchRequest request;
    request.set_job_id(id);
    const auto reader = jobs_->Watch(&context, request);
    Said<std::vector<v1::WatchResponse>> said;
    v1::WatchResponse response;
    while (reader->Read(&response)) said.value.push_back(response);
    said.status = reader->Finish();
    return said;
  }

  // --- leases ---
  Said<v1::JoinResponse> Join(const std::string& worker, const std::string& session,
                              const std::vector<v1::Grant>& holdings = {}) {
    v1::JoinRequest request;
    request.set_worker_id(worker);
    request.set_session_id(session);
    request.set_protocol(kProtocol);
    for (const v1::Grant& grant : holdings) {
      v1::JoinRequest::Holding& holding = *request.add_holding();
      *holding.mutable_attempt() = grant.attempt();
      *holding.mutable_unit() = grant.unit();
    }
    return Join(request);
  }
  Said<v1::JoinResponse> Join(const v1::JoinRequest& request) {
    return Call<v1::JoinResponse>(*leases_, &v1::Leases::Stub::Join, request);
  }
  Said<v1::AcquireResponse> Acquire(const std::string& session, uint64_t number,
                                    uint32_t wait_ms = 5'000) {
    v1::AcquireRequest request;
    request.set_session_id(session);
    request.set_request(number);
    request.set_want(1);
    request.set_wait_ms(wait_ms);
    return Call<v1::AcquireResponse>(*leases_, &v1::Leases::Stub::Acquire, request);
  }
  Said<v1::RenewResponse> Renew(const std::string& session, const v1::Grant& grant) {
    v1::RenewRequest request;
    request.set_session_id(session);
    *request.add_progress()->mutable_attempt() = grant.attempt();
    return Call<v1::RenewResponse>(*leases_, &v1::Leases::Stub::Renew, request);
  }
  // Puts a "picture" and completes with it.
  Said<v1::CompleteResponse> Complete(const std::string& session, const v1::Grant& grant,
                                      const std::string& picture) {
    return CompleteWith(session, grant, Sha256Of(picture).Hex(), PutBytes(picture));
  }
  Said<v1::CompleteResponse> CompleteWith(const std::string& session, const v1::Grant& grant,
                                          const std::string& pixel, const std::string& blob) {
    v1::CompleteRequest request;
    request.set_session_id(session);
    *request.mutable_attempt() = grant.attempt();
    v1::UnitResult& result = *request.add_result();
    *result.mutable_unit() = grant.unit(0);
    result.set_pixel_digest(pixel);
    result.set_blob_digest(blob);
    result.set_render_ms(10);
    return Call<v1::CompleteResponse>(*leases_, &v1::Leases::Stub::Complete, request);
  }
  Said<v1::FailResponse> Fail(const std::string& session, const v1::Grant& grant) {
    v1::FailRequest request;
    request.set_session_id(session);
    *request.mutable_attempt() = grant.attempt();
    request.set_error("it broke");
    return Call<v1::FailResponse>(*leases_, &v1::Leases::Stub::Fail, request);
  }
  Said<v1::LeaveResponse> Leave(const std::string& session) {
    v1::LeaveRequest request;
    request.set_session_id(session);
    return Call<v1::LeaveResponse>(*leases_, &v1::Leases::Stub::Leave, request);
  }

 private:
  static void Deadline(grpc::ClientContext& context, int seconds = 30) {
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(seconds));
  }
  template <typename Response, typename Stub, typename Request>
  Said<Response> Call(Stub& stub,
                      grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                      const Request& request) {
    grpc::ClientContext context;
    Deadline(context);
    Said<Response> said;
    said.status = (stub.*method)(&context, request, &said.value);
    return said;
  }

  std::shared_ptr<grpc::Channel> channel_;
  std::unique_ptr<v1::Jobs::Stub> jobs_;
  std::unique_ptr<v1::Leases::Stub> leases_;
  std::unique_ptr<v1::Blobs::Stub> blobs_;
};

}  // namespace fjord::farm_test
