// fjord.v1.Blobs over the blob store. Disk work runs on the I/O pool; a slow peer holds no thread.
#pragma once

#include <atomic>

#include "fjord/v1/blobs.grpc.pb.h"
#include "server/blob_store.h"
#include "server/io_pool.h"

namespace fjord::server {

class BlobsService : public v1::Blobs::CallbackService {
 public:
  BlobsService(BlobStore& blobs, IoPool& pool) : blobs_(blobs), pool_(pool) {}

  grpc::ServerUnaryReactor* Missing(grpc::CallbackServerContext* context,
                                    const v1::MissingRequest* request,
                                    v1::MissingResponse* response) override;
  grpc::ServerReadReactor<v1::PutBlobRequest>* Put(grpc::CallbackServerContext* context,
                                                   v1::PutBlobResponse* response) override;
  grpc::ServerWriteReactor<v1::GetBlobResponse>* Get(grpc::CallbackServerContext* context,
                                                     const v1::GetBlobRequest* request) override;

 private:
  BlobStore& blobs_;
  IoPool& pool_;
  std::atomic<int> streams_{0};  // uploads and downloads under way
};

}  // namespace fjord::server
