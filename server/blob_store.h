// Bytes on disk under their SHA-256: DIR/blobs/ab/cdef... A blob is there whole or not at all.
//
// B1 Put if absent: a blob is written to DIR/tmp, checked against its digest, synced, renamed into
//    place, and its folder synced, before anyone is told that it is there (F2).
// B2 A crash leaves only files in DIR/tmp, which Open removes.
// B3 What a full disk or a wrong digest interrupts leaves nothing.
// Thread-safe; Has asks memory only, the rest does disk work in the calling thread.
#pragma once

#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>

#include "engine/base/digest.h"
#include "engine/base/result.h"

namespace fjord::server {

class BlobStore;

// One upload. Dropped before Commit, it leaves nothing.
class BlobWriter {
 public:
  ~BlobWriter();
  BlobWriter(const BlobWriter&) = delete;
  BlobWriter& operator=(const BlobWriter&) = delete;

  // kInvalid: more bytes than announced.
  Result<> Append(std::string_view bytes);
  // kInvalid: too few bytes, or another digest. True: the blob was there already.
  Result<bool> Commit();

 private:
  friend class BlobStore;
  BlobWriter(BlobStore& store, const Digest& digest, uint64_t size, std::string path, int file)
      : store_(store), digest_(digest), size_(size), path_(std::move(path)), file_(file) {}

  BlobStore& store_;
  const Digest digest_;
  const uint64_t size_;
  const std::string path_;
  int file_;
  uint64_t written_ = 0;
  Sha256 sha_;
};

class BlobReader {
 public:
  ~BlobReader();
  BlobReader(const BlobReader&) = delete;
  BlobReader& operator=(const BlobReader&) = delete;

  uint64_t size() const { return size_; }
  // At most `most` bytes from where the last Read ended; empty at the end.
  Result<std::string> Read(size_t most);

 private:
  friend class BlobStore;
  BlobReader(int file, uint64_t size, std::string path)
      : file_(file), size_(size), path_(std::move(path)) {}

  const int file_;
  const uint64_t size_;
  const std::string path_;
};

class BlobStore {
 public:
  static Result<std::unique_ptr<BlobStore>> Open(const std::string& dir, uint64_t limit);

  bool Has(const Digest& digest) const;
  size_t count() const;
  // kLimit: larger than the store's limit.
  Result<std::unique_ptr<BlobWriter>> Begin(const Digest& digest, uint64_t size);
  Result<bool> Put(const Digest& digest, std::string_view bytes);
  // kNotFound: no such blob.
  Result<std::unique_ptr<BlobReader>> OpenBlob(const Digest& digest) const;
  // kLimit: larger than `most`.
  Result<std::string> Get(const Digest& digest, uint64_t most) const;

 private:
  friend class BlobWriter;
  BlobStore(std::string dir, uint64_t limit) : dir_(std::move(dir)), limit_(limit) {}
  Result<> Prepare();
  std::string FolderOf(const Digest& digest) const;
  std::string PathOf(const Digest& digest) const;
  Result<bool> Place(const Digest& digest, const std::string& from);

  const std::string dir_;
  const uint64_t limit_;

  mutable std::mutex mutex_;
  std::set<Digest> known_;  // synced and in place
  std::set<std::string> folders_;
  uint64_t next_tmp_ = 0;
};

}  // namespace fjord::server
