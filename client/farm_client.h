// The coordinator as the client's commands see it: plain calls with deadlines; what goes wrong
// comes back as one error that names the server and the remedy. Not for sharing between threads.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "fjord/v1/blobs.grpc.pb.h"
#include "fjord/v1/jobs.grpc.pb.h"

namespace fjord {

// Seconds that a server may be silent.
struct Patience {
  double first = 0;  // that has not answered this client yet
  double again = 0;  // that has: it is being started again
};

class FarmClient {
 public:
  // "host:port"; empty: $FJORD_SERVER, then kDefaultServer. Connects with the first call. What is
  // no address makes every call kUsage.
  // A server that does not answer is asked again for so long.
  explicit FarmClient(const std::string& address, Patience patience = {});

  // Of a server that has answered before.
  double patience_seconds() const { return patience_.again; }
  // Waits no more once the flag is set. It must outlive this.
  void StopWaitingOn(const std::atomic<bool>* flag) { stop_waiting_ = flag; }

  const std::string& address() const { return address_; }

  Result<v1::SubmitResponse> Submit(const v1::SubmitRequest& request);
  Result<v1::Job> GetJob(const std::string& job);
  // trouble, if not null: what stands in every job's way, or empty.
  Result<std::vector<v1::Job>> ListJobs(std::string* trouble = nullptr);
  Result<std::vector<v1::Frame>> ListFrames(const std::string& job);
  Result<v1::Job> Command(const v1::CommandRequest& request);
  Result<std::vector<v1::WorkerInfo>> ListWorkers(std::string* trouble = nullptr);
  Result<v1::WorkerInfo> CommandWorker(const v1::CommandWorkerRequest& request);

  // Calls on_change with each message until the job has ended, `limit` has passed, or on_change
  // says false. Ok in all these cases.
  Result<> Watch(const std::string& job, std::chrono::milliseconds limit,
                 const std::function<bool(const v1::WatchResponse&)>& on_change);

  // Uploads those blobs (digest -> bytes) that the store does not have; gives their number.
  Result<size_t> PutMissing(const std::map<std::string, std::string>& blobs);

  // The bytes of a blob, checked against the digest.
  Result<std::string> GetBlob(const std::string& digest);

 private:
  template <typename Response>
  Result<Response> Finished(const grpc::Status& status, Response response) const;
  Error Failure(const grpc::Status& status) const;
  // The call until it is answered, or patience ends.
  grpc::Status Persist(const std::function<grpc::Status()>& call);
  Result<> Put(const std::string& digest, const std::string& bytes);

  std::string address_;
  std::optional<Error> no_address_;
  const Patience patience_;
  bool answered_ = false;
  const std::atomic<bool>* stop_waiting_ = nullptr;
  std::unique_ptr<v1::Jobs::Stub> jobs_;
  std::unique_ptr<v1::Blobs::Stub> blobs_;
};

// What a failed call means to the user.
Error ErrorOfStatus(const grpc::Status& status, const std::string& address);

}  // namespace fjord
