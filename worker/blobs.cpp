#include "worker/blobs.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <sstream>
#include <vector>

#include "engine/base/digest.h"
#include "engine/image/codec.h"
#include "proto/fjord/protocol.h"

namespace fjord::worker {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::seconds kDeadline{120};
const grpc::Status kStopping{grpc::StatusCode::CANCELLED, "the worker is stopping"};

class GrpcBlobs : public Blobs {
 public:
  GrpcBlobs(std::shared_ptr<grpc::Channel> channel, std::string cache_dir, uint64_t cache_bytes)
      : stub_(v1::Blobs::NewStub(std::move(channel))),
        cache_dir_(std::move(cache_dir)),
        cache_bytes_(cache_bytes) {}

  grpc::Status Get(const std::string& digest, std::string* bytes) override {
    if (FromCache(digest, bytes)) return grpc::Status::OK;
    grpc::ClientContext context;
    const Call call(*this, context);
    if (!call.allowed()) return kStopping;
    v1::GetBlobRequest request;
    request.set_digest(digest);
    const auto reader = stub_->Get(&context, request);
    v1::GetBlobResponse response;
    bytes->clear();
    while (reader->Read(&response)) {
      if (bytes->size() + response.data().size() > kMaxBlob) {
        context.TryCancel();
        return {grpc::StatusCode::OUT_OF_RANGE, "blob " + digest + " is over the limit"};
      }
      *bytes += response.data();
    }
    const grpc::Status status = reader->Finish();
    if (!status.ok()) return status;
    if (Sha256Of(*bytes).Hex() != digest) {
      return {grpc::StatusCode::DATA_LOSS,
              "the bytes that came for " + digest + " are not its bytes"};
    }
    ToCache(digest, *bytes);
    return status;
  }

  grpc::Status Put(const std::string& digest, const std::string& bytes,
                   std::atomic<uint64_t>* progress) override {
    grpc::ClientContext context;
    const Call call(*this, context);
    if (!call.allowed()) return kStopping;
    v1::PutBlobResponse response;
    const auto writer = stub_->Put(&context, &response);
    v1::PutBlobRequest request;
    request.set_digest(digest);
    request.set_size(bytes.size());
    size_t sent = 0;
    do {
      const size_t count = std::min(kBlobChunk, bytes.size() - sent);
      request.set_data(bytes.substr(sent, count));
      // Refused early, or there already: Finish tells.
      if (!writer->Write(request)) break;
      request.Clear();
      sent += count;
      if (progress != nullptr) progress->fetch_add(1, std::memory_order_relaxed);
    } while (sent < bytes.size());
    writer->WritesDone();
    return writer->Finish();
  }

  void Shutdown() override {
    const std::lock_guard lock(mutex_);
    shut_ = true;
    for (grpc::ClientContext* context : calls_) context->TryCancel();
  }

 private:
  // Known to Shutdown while it lives.
  class Call {
   public:
    Call(GrpcBlobs& blobs, grpc::ClientContext& context) : blobs_(blobs), context_(context) {
      context.set_deadline(std::chrono::system_clock::now() + kDeadline);
      const std::lock_guard lock(blobs.mutex_);
      allowed_ = !blobs.shut_;
      blobs.calls_.insert(&context);
    }
    ~Call() {
      const std::lock_guard lock(blobs_.mutex_);
      blobs_.calls_.erase(&context_);
    }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;
    bool allowed() const { return allowed_; }

   private:
    GrpcBlobs& blobs_;
    grpc::ClientContext& context_;
    bool allowed_;
  };

  std::string PathOf(const std::string& digest) const { return cache_dir_ + "/" + digest; }

  bool FromCache(const std::string& digest, std::string* bytes) {
    if (cache_dir_.empty()) return false;
    std::ifstream file(PathOf(digest), std::ios::binary);
    if (!file) return false;
    std::ostringstream content;
    content << file.rdbuf();
    *bytes = content.str();
    if (Sha256Of(*bytes).Hex() == digest) return true;
    std::error_code ignored;
    fs::remove(PathOf(digest), ignored);
    return false;
  }

  // A cache that cannot be written is only slower.
  void ToCache(const std::string& digest, const std::string& bytes) {
    if (cache_dir_.empty() || bytes.size() > cache_bytes_) return;
    const std::lock_guard lock(cache_mutex_);
    std::error_code failure;
    fs::create_directories(cache_dir_, failure);
    struct Entry {
      fs::file_time_type time;
      uint64_t size;
      fs::path path;
    };
    std::vector<Entry> entries;
    uint64_t total = bytes.size();
    for (const fs::directory_entry& file : fs::directory_iterator(cache_dir_, failure)) {
      if (!IsDigestHex(file.path().filename().string())) continue;
      std::error_code gone;
      const Entry entry{file.last_write_time(gone), file.file_size(gone), file.path()};
      if (gone) continue;
      total += entry.size;
      entries.push_back(entry);
    }
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return a.time < b.time; });
    for (const Entry& entry : entries) {
      if (total <= cache_bytes_) break;
      fs::remove(entry.path, failure);
      total -= entry.size;
    }
    (void)WriteFileAtomically(PathOf(digest), bytes);
  }

  const std::unique_ptr<v1::Blobs::Stub> stub_;
  const std::string cache_dir_;
  const uint64_t cache_bytes_;
  std::mutex cache_mutex_;
  std::mutex mutex_;
  std::set<grpc::ClientContext*> calls_;
  bool shut_ = false;
};

}  // namespace

std::unique_ptr<Blobs> MakeGrpcBlobs(std::shared_ptr<grpc::Channel> channel, std::string cache_dir,
                                     uint64_t cache_bytes) {
  return std::make_unique<GrpcBlobs>(std::move(channel), std::move(cache_dir), cache_bytes);
}

}  // namespace fjord::worker
