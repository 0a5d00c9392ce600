// Bytes by digest, to and from the coordinator's store, with a bounded cache on disk. Everything
// that comes in is checked against its digest. Thread-safe.
#pragma once

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <memory>
#include <string>

#include "fjord/v1/blobs.grpc.pb.h"

namespace fjord::worker {

class Blobs {
 public:
  virtual ~Blobs() = default;
  // The status tells what to do (retry.h); DATA_LOSS: the bytes are not those of the digest.
  virtual grpc::Status Get(const std::string& digest, std::string* bytes) = 0;
  // `progress` grows with each chunk sent.
  virtual grpc::Status Put(const std::string& digest, const std::string& bytes,
                           std::atomic<uint64_t>* progress) = 0;
  // Ends the calls under way and refuses all later ones, from any thread.
  virtual void Shutdown() {}
};

// cache_dir: empty for none; otherwise a folder that keeps at most `cache_bytes`, the oldest go
// first.
std::unique_ptr<Blobs> MakeGrpcBlobs(std::shared_ptr<grpc::Channel> channel, std::string cache_dir,
                                     uint64_t cache_bytes);

}  // namespace fjord::worker
