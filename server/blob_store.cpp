#include "server/blob_store.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "server/state/types.h"

namespace fjord::server {
namespace fs = std::filesystem;
namespace {

constexpr size_t kCheckBytes = size_t{1} << 20;  // read at a time

Error DiskError(const std::string& doing, const std::string& path, int cause) {
  std::string message = doing + ": " + strerror(cause);
  const bool full = cause == ENOSPC || cause == EDQUOT;
  if (full) message += "; make room in the coordinator's data folder";
  return MakeError(full ? ErrorCode::kLimit : ErrorCode::kIo, std::move(message), {path});
}

Result<> SyncFolder(const std::string& path) {
  const int folder = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return DiskError("cannot open the folder", path, errno);
  const int failed = fsync(folder) != 0 ? errno : 0;
  close(folder);
  if (failed != 0) return DiskError("cannot sync the folder", path, failed);
  return {};
}

}  // namespace

BlobWriter::~BlobWriter() {
  if (file_ < 0) return;
  close(file_);
  unlink(path_.c_str());
}

Result<> BlobWriter::Append(std::string_view bytes) {
  if (bytes.size() > size_ - written_) {
    return Invalid("blob " + digest_.Hex() + " has more bytes than the " + std::to_string(size_) +
                   " announced");
  }
  sha_.Update(bytes);
  written_ += bytes.size();
  while (!bytes.empty()) {
    const ssize_t count = write(file_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      return store_.Told(DiskError("cannot store blob " + digest_.Hex(), path_, errno), size_);
    bytes.remove_prefix(static_cast<size_t>(count));
  }
  return {};
}

Result<bool> BlobWriter::Commit() {
  if (written_ != size_) {
    return Invalid("blob " + digest_.Hex() + " ended after " + std::to_string(written_) + " of " +
                   std::to_string(size_) + " bytes");
  }
  if (const Digest actual = sha_.Finish(); actual != digest_) {
    return Invalid("digest: the bytes announced as " + digest_.Hex() + " are " + actual.Hex());
  }
  if (fsync(file_) != 0)
    return store_.Told(DiskError("cannot sync blob " + digest_.Hex(), path_, errno), size_);
  const std::optional<BlobStore::Stamp> stamp = BlobStore::StampOf(file_);
  if (!stamp) return DiskError("cannot store blob " + digest_.Hex(), path_, errno);
  Result<bool> placed = store_.Place(digest_, path_, *stamp);
  if (!placed.ok()) return store_.Told(placed.error(), size_);
  close(file_);
  file_ = -1;
  return placed;
}

BlobReader::~BlobReader() { close(file_); }

Result<std::string> BlobReader::Read(size_t most) {
  std::string bytes(most, '\0');
  size_t filled = 0;
  while (filled < most) {
    const ssize_t count = read(file_, bytes.data() + filled, most - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return DiskError("cannot read", path_, errno);
    if (count == 0) break;
    filled += static_cast<size_t>(count);
  }
  bytes.resize(filled);
  return bytes;
}

Result<std::unique_ptr<BlobStore>> BlobStore::Open(const std::string& dir, uint64_t limit) {
  std::unique_ptr<BlobStore> store(new BlobStore(dir, limit));
  if (const Result<> ready = store->Prepare(); !ready.ok()) return ready.error();
  return store;
}

Result<> BlobStore::Prepare() {
  std::error_code failure;
  fs::remove_all(dir_ + "/tmp", failure);
  if (!failure) fs::create_directories(dir_ + "/tmp", failure);
  if (!failure) fs::create_directories(dir_ + "/blobs", failure);
  if (failure) {
    return MakeError(ErrorCode::kIo, "the store cannot be made: " + failure.message(), {dir_});
  }
  for (const fs::directory_entry& folder : fs::directory_iterator(dir_ + "/blobs", failure)) {
    const std::string prefix = folder.path().filename().string();
    folders_.insert(prefix);
    std::error_code inner;
    for (const fs::directory_entry& file : fs::directory_iterator(folder.path(), inner)) {
      if (const auto digest = ParseDigest(prefix + file.path().filename().string())) {
        std::error_code gone;
        const uint64_t size = file.file_size(gone);
        if (!gone) known_[*digest] = {size, {}};
      }
    }
  }
  if (failure) {
    return MakeError(ErrorCode::kIo, "the store cannot be read: " + failure.message(), {dir_});
  }
  // A coordinator that was killed may have renamed files whose folders were not synced yet.
  if (!known_.empty()) {
    const int folder = open(dir_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0 || syncfs(folder) != 0) {
      const int cause = errno;
      if (folder >= 0) close(folder);
      return DiskError("the store cannot be synced", dir_, cause);
    }
    close(folder);
  }
  return {};
}

std::string BlobStore::FolderOf(const Digest& digest) const {
  return dir_ + "/blobs/" + digest.Hex().substr(0, 2);
}

std::string BlobStore::PathOf(const Digest& digest) const {
  return FolderOf(digest) + "/" + digest.Hex().substr(2);
}

Error BlobStore::Told(Error error, uint64_t bytes) const {
  if (error.code == ErrorCode::kLimit && on_full_) on_full_(bytes);
  return error;
}

std::optional<uint64_t> BlobStore::SizeOf(const Digest& digest) const {
  const std::lock_guard lock(mutex_);
  const auto place = known_.find(digest);
  if (place == known_.end()) return std::nullopt;
  return place->second.size;
}

std::optional<BlobStore::Stamp> BlobStore::StampOf(int file) {
  struct stat info {};
  if (fstat(file, &info) != 0) return std::nullopt;
  return Stamp{static_cast<uint64_t>(info.st_size), info.st_ino,
               info.st_mtim.tv_sec * int64_t{1'000'000'000} + info.st_mtim.tv_nsec};
}

bool BlobStore::Check(const Digest& digest, Reading reading) {
  if (!Has(digest)) return false;
  const int file = open(PathOf(digest).c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    if (errno == ENOENT) Lose(digest, {}, "its file is gone");
    return errno != ENOENT;
  }
  const std::optional<Stamp> stamp = StampOf(file);
  BlobReader reader(file, stamp ? stamp->size : 0, PathOf(digest));
  if (!stamp) return true;
  if (reading == Reading::kUnlessKnown) {
    const std::lock_guard lock(mutex_);
    const auto place = known_.find(digest);
    if (place != known_.end() && place->second.checked == stamp) return true;
  }
  Sha256 sha;
  while (true) {
    const Result<std::string> bytes = reader.Read(kCheckBytes);
    if (!bytes.ok()) {
      Lose(digest, *stamp, "its file cannot be read: " + bytes.error().message);
      return false;
    }
    if (bytes->empty()) break;
    sha.Update(*bytes);
  }
  if (sha.Finish() != digest) {
    Lose(digest, *stamp, "its file of " + std::to_string(stamp->size) + " bytes holds others");
    return false;
  }
  const std::lock_guard lock(mutex_);
  if (const auto place = known_.find(digest); place != known_.end()) place->second.checked = stamp;
  return true;
}

// `seen`: the file that is wrong; another may have been put in its place meanwhile.
void BlobStore::Lose(const Digest& digest, const Stamp& seen, const std::string& why) {
  const std::string path = PathOf(digest);
  {
    const std::lock_guard lock(mutex_);
    struct stat info {};
    const bool there = stat(path.c_str(), &info) == 0;
    if (there && info.st_ino != seen.inode) return;
    if (known_.erase(digest) == 0) return;
    if (there) unlink(path.c_str());
  }
  spdlog::warn("blob {} is lost, {}: {}", digest.Hex(), why, path);
  if (on_lost_) on_lost_(digest);
}

size_t BlobStore::count() const {
  const std::lock_guard lock(mutex_);
  return known_.size();
}

Result<std::unique_ptr<BlobWriter>> BlobStore::Begin(const Digest& digest, uint64_t size) {
  if (size > limit_) {
    return MakeError(ErrorCode::kLimit, "size: a blob of " + std::to_string(size) +
                                            " bytes is over the limit of " +
                                            std::to_string(limit_));
  }
  std::string path = dir_ + "/tmp/";
  {
    const std::lock_guard lock(mutex_);
    path += std::to_string(++next_tmp_);
  }
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (file < 0) return Told(DiskError("cannot make a file in the store", path, errno), size);
  return std::unique_ptr<BlobWriter>(new BlobWriter(*this, digest, size, std::move(path), file));
}

// From the temporary place to the lasting one; false: it was not there before.
Result<bool> BlobStore::Place(const Digest& digest, const std::string& from, const Stamp& stamp) {
  const std::string folder = FolderOf(digest);
  const std::string prefix = digest.Hex().substr(0, 2);
  bool fresh_folder = false;
  {
    const std::lock_guard lock(mutex_);
    if (known_.contains(digest)) {
      unlink(from.c_str());
      return true;
    }
    fresh_folder = !folders_.contains(prefix);
  }
  if (fresh_folder) {
    if (mkdir(folder.c_str(), 0755) != 0 && errno != EEXIST) {
      return DiskError("cannot make a folder in the store", folder, errno);
    }
    if (const Result<> synced = SyncFolder(dir_ + "/blobs"); !synced.ok()) return synced.error();
  }
  const std::string to = PathOf(digest);
  if (rename(from.c_str(), to.c_str()) != 0) return DiskError("cannot store a blob", to, errno);
  if (const Result<> synced = SyncFolder(folder); !synced.ok()) return synced.error();
  const std::lock_guard lock(mutex_);
  folders_.insert(prefix);
  return !known_.emplace(digest, Known{stamp.size, stamp}).second;
}

Result<bool> BlobStore::Put(const Digest& digest, std::string_view bytes) {
  if (Check(digest)) return true;
  Result<std::unique_ptr<BlobWriter>> writer = Begin(digest, bytes.size());
  if (!writer.ok()) return writer.error();
  if (const Result<> appended = writer.value()->Append(bytes); !appended.ok())
    return appended.error();
  return writer.value()->Commit();
}

Result<std::unique_ptr<BlobReader>> BlobStore::OpenBlob(const Digest& digest) {
  const std::string path = PathOf(digest);
  if (!Has(digest))
    return MakeError(ErrorCode::kNotFound, "no blob " + digest.Hex() + " in the store");
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0 && errno == ENOENT) {
    Lose(digest, {}, "its file is gone");
    return MakeError(ErrorCode::kNotFound, "the store has lost blob " + digest.Hex());
  }
  struct stat info {};
  if (file < 0 || fstat(file, &info) != 0) {
    const int cause = errno;
    if (file >= 0) close(file);
    return DiskError("cannot open blob " + digest.Hex(), path, cause);
  }
  return std::unique_ptr<BlobReader>(
      new BlobReader(file, static_cast<uint64_t>(info.st_size), path));
}

Result<std::string> BlobStore::Get(const Digest& digest, uint64_t most) {
  Result<std::unique_ptr<BlobReader>> reader = OpenBlob(digest);
  if (!reader.ok()) return reader.error();
  if (reader.value()->size() > most) {
    return MakeError(ErrorCode::kLimit, "blob " + digest.Hex() + " of " +
                                            std::to_string(reader.value()->size()) +
                                            " bytes is over the limit of " + std::to_string(most));
  }
  Result<std::string> bytes = reader.value()->Read(static_cast<size_t>(reader.value()->size()));
  if (!bytes.ok() || Sha256Of(*bytes) == digest) return bytes;
  Check(digest, Reading::kAnew);
  return MakeError(ErrorCode::kNotFound, "the store has lost blob " + digest.Hex());
}

}  // namespace fjord::server
