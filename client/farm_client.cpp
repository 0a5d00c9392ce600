#include "client/farm_client.h"

#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "engine/base/digest.h"
#include "proto/fjord/protocol.h"

namespace fjord {
namespace {

constexpr std::chrono::seconds kCallLimit{20};
constexpr std::chrono::minutes kBlobLimit{10};
constexpr int kLargestAnswer = 64 << 20;  // a page of frames with long errors

std::string AddressOr(std::string address) {
  const char* from_environment = std::getenv("FJORD_SERVER");
  if (address.empty() && from_environment != nullptr) address = from_environment;
  if (address.empty()) return kDefaultServer;
  if (address.find(':') == std::string::npos) address += std::strchr(kDefaultServer, ':');
  return address;
}

std::shared_ptr<grpc::Channel> MakeChannel(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(kLargestAnswer);
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 1000);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

Error OtherVersion(const std::string& server, const std::string& said) {
  return MakeError(ErrorCode::kUnavailable, server + " speaks another version than this fjord " +
                                                kVersion + " (protocol " + kProtocol +
                                                "): " + said + "; use programs of one version");
}

// A context with a deadline.
struct Call {
  explicit Call(std::chrono::milliseconds limit = kCallLimit) {
    context.set_deadline(std::chrono::system_clock::now() + limit);
  }
  grpc::ClientContext context;
};

}  // namespace

Error ErrorOfStatus(const grpc::Status& status, const std::string& address) {
  const std::string& said = status.error_message();
  const std::string server = "the server at " + address;
  switch (status.error_code()) {
    case grpc::StatusCode::UNAVAILABLE:
      return MakeError(ErrorCode::kUnavailable,
                       "no Fjord server answers at " + address + " (" + said +
                           "); start one with `fjord farm`, or name another with --server or "
                           "$FJORD_SERVER");
    case grpc::StatusCode::DEADLINE_EXCEEDED:
      return MakeError(ErrorCode::kUnavailable,
                       server +
                           " did not answer in time; it may be overloaded or gone: try again, or "
                           "name another with --server");
    case grpc::StatusCode::UNIMPLEMENTED:
      return OtherVersion(server, said);
    case grpc::StatusCode::FAILED_PRECONDITION:
      if (said.find("protocol") != std::string::npos) return OtherVersion(server, said);
      return MakeError(ErrorCode::kInvalid, server + ": " + said);
    case grpc::StatusCode::NOT_FOUND:
      return MakeError(ErrorCode::kNotFound, server + ": " + said);
    case grpc::StatusCode::INVALID_ARGUMENT:
    case grpc::StatusCode::ALREADY_EXISTS:
    case grpc::StatusCode::OUT_OF_RANGE:
      return MakeError(ErrorCode::kInvalid, server + ": " + said);
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
      return MakeError(ErrorCode::kLimit, server + ": " + said);
    case grpc::StatusCode::CANCELLED:
      return MakeError(ErrorCode::kCancelled, server + ": the call was ended: " + said);
    default:
      return MakeError(ErrorCode::kInternal, server + ": " + said + " (code " +
                                                 std::to_string(status.error_code()) + ")");
  }
}

FarmClient::FarmClient(const std::string& address) : address_(AddressOr(address)) {
  const std::shared_ptr<grpc::Channel> channel = MakeChannel(address_);
  jobs_ = v1::Jobs::NewStub(channel);
  blobs_ = v1::Blobs::NewStub(channel);
}

template <typename Response>
Result<Response> FarmClient::Finished(const grpc::Status& status, Response response) const {
  if (!status.ok()) return ErrorOfStatus(status, address_);
  return response;
}

Result<v1::SubmitResponse> FarmClient::Submit(const v1::SubmitRequest& request) {
  Call call;
  v1::SubmitResponse response;
  const grpc::Status status = jobs_->Submit(&call.context, request, &response);
  return Finished(status, std::move(response));
}

Result<v1::Job> FarmClient::GetJob(const std::string& job) {
  Call call;
  v1::GetJobRequest request;
  request.set_job_id(job);
  v1::Job response;
  const grpc::Status status = jobs_->GetJob(&call.context, request, &response);
  return Finished(status, std::move(response));
}

Result<std::vector<v1::Job>> FarmClient::ListJobs() {
  std::vector<v1::Job> jobs;
  v1::ListJobsRequest request;
  request.set_page_size(kMaxPage);
  do {
    Call call;
    v1::ListJobsResponse response;
    const grpc::Status status = jobs_->ListJobs(&call.context, request, &response);
    if (!status.ok()) return ErrorOfStatus(status, address_);
    jobs.insert(jobs.end(), response.job().begin(), response.job().end());
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
    Call call;
    v1::ListFramesResponse response;
    const grpc::Status status = jobs_->ListFrames(&call.context, request, &response);
    if (!status.ok()) return ErrorOfStatus(status, address_);
    frames.insert(frames.end(), response.frame().begin(), response.frame().end());
    if (response.next_frame() <= request.from_frame()) return frames;
    request.set_from_frame(response.next_frame());
  }
}

Result<v1::Job> FarmClient::Command(const v1::CommandRequest& request) {
  Call call;
  v1::Job response;
  const grpc::Status status = jobs_->Command(&call.context, request, &response);
  return Finished(status, std::move(response));
}

Result<std::vector<v1::WorkerInfo>> FarmClient::ListWorkers() {
  Call call;
  v1::ListWorkersResponse response;
  const grpc::Status status = jobs_->ListWorkers(&call.context, {}, &response);
  if (!status.ok()) return ErrorOfStatus(status, address_);
  return std::vector<v1::WorkerInfo>(response.worker().begin(), response.worker().end());
}

Result<v1::WorkerInfo> FarmClient::CommandWorker(const v1::CommandWorkerRequest& request) {
  Call call;
  v1::WorkerInfo response;
  const grpc::Status status = jobs_->CommandWorker(&call.context, request, &response);
  return Finished(status, std::move(response));
}

Result<> FarmClient::Watch(const std::string& job, std::chrono::milliseconds limit,
                           const std::function<bool(const v1::WatchResponse&)>& on_change) {
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
  return ErrorOfStatus(status, address_);
}

Result<size_t> FarmClient::PutMissing(const std::map<std::string, std::string>& blobs) {
  size_t put = 0;
  for (auto it = blobs.begin(); it != blobs.end();) {
    v1::MissingRequest request;
    for (int i = 0; i < kMaxMissing && it != blobs.end(); ++i, ++it) request.add_digest(it->first);
    Call call;
    v1::MissingResponse missing;
    const grpc::Status status = blobs_->Missing(&call.context, request, &missing);
    if (!status.ok()) return ErrorOfStatus(status, address_);
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
  const grpc::Status status = stream->Finish();
  if (!status.ok()) return ErrorOfStatus(status, address_);
  return Ok{};
}

Result<std::string> FarmClient::GetBlob(const std::string& digest) {
  Call call(kBlobLimit);
  v1::GetBlobRequest request;
  request.set_digest(digest);
  const auto stream = blobs_->Get(&call.context, request);
  std::string bytes;
  v1::GetBlobResponse part;
  while (bytes.size() <= kMaxBlob && stream->Read(&part)) bytes += part.data();
  const bool too_large = bytes.size() > kMaxBlob;
  if (too_large) call.context.TryCancel();
  const grpc::Status status = stream->Finish();
  if (too_large)
    return MakeError(ErrorCode::kLimit, "blob " + digest + " is larger than any may be");
  if (!status.ok()) return ErrorOfStatus(status, address_);
  if (Sha256Of(bytes).Hex() != digest) {
    return MakeError(ErrorCode::kIo, "what the server at " + address_ + " sent for blob " + digest +
                                         " does not match its digest; try again");
  }
  return bytes;
}

}  // namespace fjord
