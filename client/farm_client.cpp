#include "client/farm_client.h"

#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <utility>

#include "client/console.h"
#include "engine/base/digest.h"
#include "proto/fjord/address.h"
#include "proto/fjord/protocol.h"

namespace fjord {
namespace {

constexpr std::chrono::seconds kCallLimit{20};
constexpr std::chrono::minutes kBlobLimit{10};
constexpr std::chrono::milliseconds kBeforeRetry{200};
constexpr int kLargestAnswer = 64 << 20;  // a page of frames with long errors

std::string AddressOr(const std::string& address) {
  const char* from_environment = std::getenv("FJORD_SERVER");
  if (!address.empty()) return address;
  return from_environment != nullptr && *from_environment != 0 ? from_environment : kDefaultServer;
}

std::shared_ptr<grpc::Channel> MakeChannel(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(kLargestAnswer);
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 1000);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

// A context with a deadline.
struct Call {
  explicit Call(std::chrono::milliseconds limit = kCallLimit) {
    context.set_deadline(std::chrono::system_clock::now() + limit);
  }
  grpc::ClientContext context;
};

}  // namespace

FarmClient::FarmClient(const std::string& address, Patience patience)
    : address_(AddressOr(address)), patience_(patience) {
  if (const std::string defect = AddressDefect(address_); !defect.empty()) {
    no_address_ =
        MakeError(ErrorCode::kUsage, (address.empty() ? "$FJORD_SERVER " : "--server ") + defect);
    return;
  }
  const std::shared_ptr<grpc::Channel> channel = MakeChannel(address_);
  jobs_ = v1::Jobs::NewStub(channel);
  blobs_ = v1::Blobs::NewStub(channel);
}

Error FarmClient::Failure(const grpc::Status& status) const {
  return no_address_ ? *no_address_ : ErrorOfStatus(status, address_);
}

grpc::Status FarmClient::Persist(const std::function<grpc::Status()>& call) {
  if (no_address_) return {grpc::StatusCode::INVALID_ARGUMENT, no_address_->message};
  const auto start = std::chrono::steady_clock::now();
  bool said = false;
  while (true) {
    const grpc::Status status = call();
    if (status.error_code() != grpc::StatusCode::UNAVAILABLE) {
      answered_ = true;
      return status;
    }
    const double patience = answered_ ? patience_.again : patience_.first;
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
    if (waited.count() >= patience) return status;
    if (stop_waiting_ != nullptr && stop_waiting_->load()) return status;
    if (!said) {
      char seconds[32];
      std::snprintf(seconds, sizeof seconds, "%g", patience);
      console::Note("the server at " + address_ + " does not answer; trying again for " + seconds +
                    " s");
    }
    said = true;
    std::this_thread::sleep_for(kBeforeRetry);
  }
}

template <typename Response>
Result<Response> FarmClient::Finished(const grpc::Status& status, Response response) const {
  if (!status.ok()) return Failure(status);
  return response;
}

Result<v1::SubmitResponse> FarmClient::Submit(const v1::SubmitRequest& request) {
  v1::SubmitResponse response;
  const grpc::Status status = Persist([&] {
    Call call;
    return jobs_->Submit(&call.context, request, &response);
  });
  return Finished(status, std::move(response));
}

Result<v1::Job> FarmClient::GetJob(const std::string& job) {
  v1::GetJobRequest request;
  request.set_job_id(job);
  v1::Job response;
  const grpc::Status status = Persist([&] {
    Call call;
    return jobs_->GetJob(&call.context, request, &response);
  });
  return Finished(status, std::move(response));
}

Result<std::vector<v1::Job>> FarmClient::ListJobs(std::string* trouble) {
  std::vector<v1::Job> jobs;
  v1::ListJobsRequest request;
  request.set_page_size(kMaxPage);
  do {
    v1::ListJobsResponse response;
    const grpc::Status status = Persist([&] {
      Call call;
      return jobs_->ListJobs(&call.context, request, &response);
    });
    if (!status.ok()) return Failure(status);
    jobs.insert(jobs.end(), response.job().begin(), response.job().end());
    if (trouble != nullptr) *trouble = response.trouble();
    request.set_page_token(response.next_page_token());
  } while (!request.page_token().empty());
  return jobs;
}

Result<std::vector<v1::Frame>> FarmClient::ListFrames(const std::string& job) {
  std::vector<v1::Frame> frames;
  v1::ListFramesRequest request;
  request.set_job_id(job);
  request.set_page_size(kMaxPage);
  for (;;) {
    v1::ListFramesResponse response;
    const grpc::Status status = Persist([&] {
      Call call;
      return jobs_->ListFrames(&call.context, request, &response);
    });
    if (!status.ok()) return Failure(status);
    frames.insert(frames.end(), response.frame().begin(), response.frame().end());
    if (response.next_frame() <= request.from_frame()) return frames;
    request.set_from_frame(response.next_frame());
  }
}

Result<v1::Job> FarmClient::Command(const v1::CommandRequest& request) {
  v1::Job response;
  const grpc::Status status = Persist([&] {
    Call call;
    return jobs_->Command(&call.context, request, &response);
  });
  return Finished(status, std::move(response));
}

Result<std::vector<v1::WorkerInfo>> FarmClient::ListWorkers(std::string* trouble) {
  v1::ListWorkersResponse response;
  const grpc::Status status = Persist([&] {
    Call call;
    return jobs_->ListWorkers(&call.context, {}, &response);
  });
  if (!status.ok()) return Failure(status);
  if (trouble != nullptr) *trouble = response.trouble();
  return std::vector<v1::WorkerInfo>(response.worker().begin(), response.worker().end());
}

Result<v1::WorkerInfo> FarmClient::CommandWorker(const v1::CommandWorkerRequest& request) {
  v1::WorkerInfo response;
  const grpc::Status status = Persist([&] {
    Call call;
    return jobs_->CommandWorker(&call.context, request, &response);
  });
  return Finished(status, std::move(response));
}

Result<> FarmClient::Watch(const std::string& job, std::chrono::milliseconds limit,
                           const std::function<bool(const v1::WatchResponse&)>& on_change) {
  if (no_address_) return *no_address_;
  Call call(limit);
  v1::WatchRequest request;
  request.set_job_id(job);
  const auto stream = jobs_->Watch(&call.context, request);
  v1::WatchResponse response;
  bool ended_here = false;
  while (!ended_here && stream->Read(&response)) ended_here = !on_change(response);
  if (ended_here) {
    call.context.TryCancel();
    stream->Finish();
    return Ok{};
  }
  const grpc::Status status = stream->Finish();
  if (status.ok() || status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED) return Ok{};
  return Failure(status);
}

Result<size_t> FarmClient::PutMissing(const std::map<std::string, std::string>& blobs) {
  size_t put = 0;
  for (auto it = blobs.begin(); it != blobs.end();) {
    v1::MissingRequest request;
    for (int i = 0; i < kMaxMissing && it != blobs.end(); ++i, ++it) request.add_digest(it->first);
    v1::MissingResponse missing;
    const grpc::Status status = Persist([&] {
      Call call;
      return blobs_->Missing(&call.context, request, &missing);
    });
    if (!status.ok()) return Failure(status);
    for (const std::string& digest : missing.digest()) {
      const auto blob = blobs.find(digest);
      if (blob == blobs.end()) continue;
      if (const Result<> sent = Put(digest, blob->second); !sent.ok()) return sent.error();
      ++put;
    }
  }
  return put;
}

Result<> FarmClient::Put(const std::string& digest, const std::string& bytes) {
  if (bytes.size() > kMaxBlob) {
    return MakeError(ErrorCode::kLimit, "an asset has " + std::to_string(bytes.size() >> 20) +
                                            " MiB; the farm takes at most " +
                                            std::to_string(kMaxBlob >> 20));
  }
  const grpc::Status status = Persist([&] {
    Call call(kBlobLimit);
    v1::PutBlobResponse response;
    const auto stream = blobs_->Put(&call.context, &response);
    size_t sent = 0;
    do {
      v1::PutBlobRequest part;
      if (sent == 0) {
        part.set_digest(digest);
        part.set_size(bytes.size());
      }
      const size_t size = std::min(kBlobChunk, bytes.size() - sent);
      part.set_data(bytes.substr(sent, size));
      sent += size;
      if (!stream->Write(part)) break;
    } while (sent < bytes.size());
    stream->WritesDone();
    return stream->Finish();
  });
  if (!status.ok()) return Failure(status);
  return Ok{};
}

Result<std::string> FarmClient::GetBlob(const std::string& digest) {
  v1::GetBlobRequest request;
  request.set_digest(digest);
  std::string bytes;
  bool too_large = false;
  const grpc::Status status = Persist([&] {
    Call call(kBlobLimit);
    const auto stream = blobs_->Get(&call.context, request);
    bytes.clear();
    v1::GetBlobResponse part;
    while (bytes.size() <= kMaxBlob && stream->Read(&part)) bytes += part.data();
    too_large = bytes.size() > kMaxBlob;
    if (too_large) call.context.TryCancel();
    return stream->Finish();
  });
  if (too_large)
    return MakeError(ErrorCode::kLimit, "blob " + digest + " is larger than any may be");
  if (!status.ok()) return Failure(status);
  if (Sha256Of(bytes).Hex() != digest) {
    return MakeError(ErrorCode::kIo, "what the server at " + address_ + " sent for blob " + digest +
                                         " does not match its digest; try again");
  }
  return bytes;
}

}  // namespace fjord
