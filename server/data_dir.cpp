#include "server/data_dir.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "server/journal_format.h"

namespace fjord::server {

Result<std::unique_ptr<DataDir>> DataDir::Open(const std::string& path) {
  std::error_code failure;
  std::filesystem::create_directories(path, failure);
  if (failure) {
    return MakeError(ErrorCode::kIo, "the data folder cannot be made: " + failure.message(),
                     {path});
  }
  const std::string lock_path = path + "/" + kLockFile;
  const int lock = open(lock_path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock < 0) {
    return MakeError(ErrorCode::kIo,
                     std::string("the data folder cannot be written: ") + strerror(errno), {path});
  }
  if (flock(lock, LOCK_EX | LOCK_NB) != 0) {
    char holder[32] = {};
    const ssize_t length = read(lock, holder, sizeof holder - 1);
    close(lock);
    const std::string who = length > 0 ? " (process " + std::string(holder, length) + ")" : "";
    return MakeError(
        ErrorCode::kUnavailable,
        "another coordinator" + who +
            " works in this data folder: stop it, or give this one a folder of its own with --data",
        {path});
  }
  const std::string self = std::to_string(getpid());
  if (ftruncate(lock, 0) != 0 || write(lock, self.data(), self.size()) < 0) {
    const std::string cause = strerror(errno);
    close(lock);
    return MakeError(ErrorCode::kIo, "the data folder cannot be written: " + cause, {path});
  }
  return std::unique_ptr<DataDir>(new DataDir(path, lock));
}

DataDir::~DataDir() { close(lock_); }

}  // namespace fjord::server
