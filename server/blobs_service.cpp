#include "server/blobs_service.h"

#include "proto/fjord/protocol.h"
#include "server/rpc_status.h"
#include "server/validate.h"

namespace fjord::server {
namespace {

constexpr int kMaxStreams = 256;

// Counts a stream for as long as it lives.
class Place {
 public:
  explicit Place(std::atomic<int>& count) : count_(count), free_(++count <= kMaxStreams) {}
  ~Place() { --count_; }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  bool free() const { return free_; }

 private:
  std::atomic<int>& count_;
  const bool free_;
};

class PutCall : public grpc::ServerReadReactor<v1::PutBlobRequest> {
 public:
  PutCall(BlobStore& blobs, IoPool& pool, std::atomic<int>& streams, v1::PutBlobResponse* response)
      : blobs_(blobs), pool_(pool), place_(streams), response_(response) {
    if (place_.free()) {
      StartRead(&request_);
    } else {
      Finish(BusyStatus());
    }
  }
  void OnReadDone(bool ok) override {
    if (!pool_.Post([this, ok] { ok ? Take() : End(); })) Finish(BusyStatus());
  }
  void OnDone() override { delete this; }

 private:
  void Take() {
    if (const Objection objection = Validate(request_, writer_ == nullptr)) {
      return Finish(ToStatus(*objection));
    }
    if (writer_ == nullptr) {
      const Digest digest = *ParseDigest(request_.digest());
      if (blobs_.Check(digest)) {
        response_->set_existed(true);
        return Finish(grpc::Status::OK);
      }
      Result<std::unique_ptr<BlobWriter>> writer = blobs_.Begin(digest, request_.size());
      if (!writer.ok()) return Finish(ToStatus(writer.error()));
      writer_ = std::move(*writer);
    }
    if (const Result<> taken = writer_->Append(request_.data()); !taken.ok()) {
      return Finish(ToStatus(taken.error()));
    }
    StartRead(&request_);
  }

  void End() {
    if (writer_ == nullptr) {
      return Finish({grpc::StatusCode::INVALID_ARGUMENT, "digest: no message came"});
    }
    const Result<bool> placed = writer_->Commit();
    if (!placed.ok()) return Finish(ToStatus(placed.error()));
    response_->set_existed(*placed);
    Finish(grpc::Status::OK);
  }

  BlobStore& blobs_;
  IoPool& pool_;
  const Place place_;
  v1::PutBlobResponse* const response_;
  v1::PutBlobRequest request_;
  std::unique_ptr<BlobWriter> writer_;
};

class GetCall : public grpc::ServerWriteReactor<v1::GetBlobResponse> {
 public:
  GetCall(BlobStore& blobs, IoPool& pool, std::atomic<int>& streams,
          const v1::GetBlobRequest& request)
      : pool_(pool), place_(streams) {
    if (const Objection objection = Validate(request)) {
      Finish(ToStatus(*objection));
      return;
    }
    const Digest digest = *ParseDigest(request.digest());
    const bool taken = place_.free() && pool_.Post([this, &blobs, digest] {
      // Nobody is given the first bytes of a blob that is damaged.
      (void)blobs.Check(digest, BlobStore::Reading::kAnew);
      Result<std::unique_ptr<BlobReader>> reader = blobs.OpenBlob(digest);
      if (!reader.ok()) return Finish(ToStatus(reader.error()));
      reader_ = std::move(*reader);
      response_.set_size(reader_->size());
      Send();
    });
    if (!taken) Finish(BusyStatus());
  }
  void OnWriteDone(bool ok) override {
    if (!ok) return Finish(grpc::Status::CANCELLED);
    response_.clear_size();
    if (!pool_.Post([this] { Send(); })) Finish(BusyStatus());
  }
  void OnDone() override { delete this; }

 private:
  void Send() {
    Result<std::string> bytes = reader_->Read(kBlobChunk);
    if (!bytes.ok()) return Finish(ToStatus(bytes.error()));
    sent_ += bytes->size();
    const bool last = bytes->size() < kBlobChunk || sent_ == reader_->size();
    response_.set_data(std::move(*bytes));
    if (last) {
      StartWriteAndFinish(&response_, {}, grpc::Status::OK);
    } else {
      StartWrite(&response_);
    }
  }

  IoPool& pool_;
  const Place place_;
  v1::GetBlobResponse response_;
  std::unique_ptr<BlobReader> reader_;
  uint64_t sent_ = 0;
};

}  // namespace

grpc::ServerUnaryReactor* BlobsService::Missing(grpc::CallbackServerContext* context,
                                                const v1::MissingRequest* request,
                                                v1::MissingResponse* response) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  if (const Objection objection = Validate(*request)) {
    reactor->Finish(ToStatus(*objection));
    return reactor;
  }
  const bool taken = pool_.Post([this, request, response, reactor] {
    for (const std::string& digest : request->digest()) {
      if (!blobs_.Check(*ParseDigest(digest))) response->add_digest(digest);
    }
    reactor->Finish(grpc::Status::OK);
  });
  if (!taken) reactor->Finish(BusyStatus());
  return reactor;
}

grpc::ServerReadReactor<v1::PutBlobRequest>* BlobsService::Put(grpc::CallbackServerContext*,
                                                               v1::PutBlobResponse* response) {
  return new PutCall(blobs_, pool_, streams_, response);
}

grpc::ServerWriteReactor<v1::GetBlobResponse>* BlobsService::Get(
    grpc::CallbackServerContext*, const v1::GetBlobRequest* request) {
  return new GetCall(blobs_, pool_, streams_, *request);
}

}  // namespace fjord::server
