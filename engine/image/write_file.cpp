#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "engine/image/codec.h"

namespace fjord {
namespace {

Error FileError(const std::string& path, const std::string& what, int error) {
  std::string remedy;
  if (error == ENOSPC || error == EDQUOT) remedy = "; free some space there";
  if (error == EACCES || error == EPERM || error == EROFS)
    remedy = "; choose a folder you may write";
  if (error == ENOENT || error == ENOTDIR) remedy = "; make the folder first";
  return MakeError(ErrorCode::kIo, what + ": " + std::strerror(error) + remedy, Place{path});
}

// Whether `path` may be replaced by a file: it is one, or nothing is there. A folder, a device or a
// pipe would be lost.
Result<> CheckReplaceable(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return errno == ELOOP ? Result<>(FileError(path, "cannot be written", errno)) : Ok{};
  if (S_ISREG(status.st_mode)) return Ok{};
  return MakeError(ErrorCode::kIo,
                   std::string("cannot be written: it is ") +
                       (S_ISDIR(status.st_mode) ? "a folder" : "no regular file") +
                       "; choose another name",
                   Place{path});
}

// Everything written, or the errno of what failed.
int WriteAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<size_t>(written));
  }
  return ::fsync(fd) == 0 ? 0 : errno;
}

}  // namespace

Result<> WriteFileAtomically(const std::string& path, std::string_view bytes) {
  if (Result<> replaceable = CheckReplaceable(path); !replaceable.ok()) return replaceable;
  static std::atomic<uint64_t> counter{0};
  const size_t slash = path.find_last_of('/');
  const std::string folder = slash == std::string::npos ? "."
                             : slash == 0               ? "/"
                                                        : path.substr(0, slash);
  const std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  const std::string temporary = (slash == std::string::npos ? "" : path.substr(0, slash + 1)) +
                                "." + name + "." + std::to_string(::getpid()) + "." +
                                std::to_string(counter.fetch_add(1)) + ".tmp";
  const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd < 0) return FileError(path, "cannot be written", errno);
  int failed = WriteAll(fd, bytes);
  if (::close(fd) != 0 && failed == 0) failed = errno;
  if (failed == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) failed = errno;
  if (failed != 0) {
    ::unlink(temporary.c_str());
    return FileError(path, "cannot be written", failed);
  }
  // The name is durable once its folder is.
  const int folder_fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder_fd >= 0) {
    const int synced = ::fsync(folder_fd);
    const int error = errno;
    ::close(folder_fd);
    if (synced != 0 && error != EINVAL && error != EROFS) {
      return FileError(path, "the folder cannot be synced", error);
    }
  }
  return {};
}

}  // namespace fjord
