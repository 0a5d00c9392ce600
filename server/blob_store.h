// Bytes on disk under their SHA-256: DIR/blobs/ab/cdef... A blob is there whole or not at all.
//
// B1 Put if absent: a blob is written to DIR/tmp, checked against its digest, synced, renamed into
//    place, and its folder synced, before anyone is told that it is there (F2).
// B2 A crash leaves only files in DIR/tmp, which Open removes.
// B3 What a full disk or a wrong digest interrupts leaves nothing.
// B4 A blob whose file is gone, or holds other bytes, is noticed by whoever asks for it (Check,
// Get),
//    is there no more, and can be put again.
// Thread-safe; Has and SizeOf ask memory only, the rest does disk work in the calling thread.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
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

  // kInvalid: more bytes than announced. kLimit: no room.
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

  // Called, from any thread, after a blob was found to be gone. Set before others use the store.
  void OnLost(std::function<void(const Digest&)> on_lost) { on_lost_ = std::move(on_lost); }
  // Called, from any thread, after there was no room for a blob of so many bytes. Set likewise.
  void OnFull(std::function<void(uint64_t bytes)> on_full) { on_full_ = std::move(on_full); }

  bool Has(const Digest& digest) const { return SizeOf(digest).has_value(); }
  std::optional<uint64_t> SizeOf(const Digest& digest) const;
  // Reads the whole blob, but where the file is the one that was written or read before, by its
  // stamp. kAnew: in any case. False: it is not there (any more).
  enum class Reading : uint8_t { kUnlessKnown, kAnew };
  bool Check(const Digest& digest, Reading reading = Reading::kUnlessKnown);
  size_t count() const;
  // kLimit: larger than the store's limit.
  Result<std::unique_ptr<BlobWriter>> Begin(const Digest& digest, uint64_t size);
  Result<bool> Put(const Digest& digest, std::string_view bytes);
  // kNotFound: no such blob.
  Result<std::unique_ptr<BlobReader>> OpenBlob(const Digest& digest);
  // kLimit: larger than `most`. kNotFound also where the file does not hold the blob's bytes.
  Result<std::string> Get(const Digest& digest, uint64_t most);

 private:
  friend class BlobWriter;
  // What tells one state of a file from another without reading it.
  struct Stamp {
    uint64_t size = 0;
    uint64_t inode = 0;
    int64_t changed_ns = 0;
    friend bool operator==(const Stamp&, const Stamp&) = default;
  };
  struct Known {
    uint64_t size = 0;
    std::optional<Stamp> checked;  // the file held the right bytes then
  };
  static std::optional<Stamp> StampOf(int file);
  BlobStore(std::string dir, uint64_t limit) : dir_(std::move(dir)), limit_(limit) {}
  Result<> Prepare();
  std::string FolderOf(const Digest& digest) const;
  std::string PathOf(const Digest& digest) const;
  Result<bool> Place(const Digest& digest, const std::string& from, const Stamp& stamp);
  Error Told(Error error, uint64_t bytes) const;
  void Lose(const Digest& digest, const Stamp& seen, const std::string& why);

  const std::string dir_;
  const uint64_t limit_;
  std::function<void(const Digest&)> on_lost_;
  std::function<void(uint64_t)> on_full_;

  mutable std::mutex mutex_;
  std::map<Digest, Known> known_;  // synced and in place
  std::set<std::string> folders_;
  uint64_t next_tmp_ = 0;
};

}  // namespace fjord::server
