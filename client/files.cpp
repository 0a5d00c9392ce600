#include "client/files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace fjord {
namespace {

namespace fs = std::filesystem;

bool IsPicture(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".png" || ending == ".exr";
}

void Walk(const fs::path& folder, std::vector<std::string>* found, std::error_code* error) {
  std::vector<fs::path> names;
  for (fs::directory_iterator it(folder, *error), end; !*error && it != end; it.increment(*error)) {
    if (it->path().filename().string().front() != '.') names.push_back(it->path());
  }
  std::sort(names.begin(), names.end());
  for (const fs::path& path : names) {
    std::error_code status;
    if (fs::is_directory(path, status)) {
      if (!fs::is_symlink(path, status)) Walk(path, found, error);
    } else if (IsPicture(path)) {
      found->push_back(folder == "." ? path.filename().string() : path.string());
    }
  }
}

}  // namespace

Result<> MakeFolder(const std::string& path, const std::string& option) {
  const Place place{path, 0, 0};
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    fs::create_directories(path, error);
    if (error || !fs::is_directory(path, error)) {
      const std::string why = error ? error.message() : "there is a file of that name";
      return MakeError(ErrorCode::kIo,
                       "the folder cannot be made: " + why + "; name another with " + option,
                       place);
    }
  }
  if (access(path.c_str(), W_OK | X_OK) != 0) {
    return MakeError(ErrorCode::kIo,
                     std::string("the folder cannot be written: ") + std::strerror(errno) +
                         "; name another with " + option,
                     place);
  }
  return Ok{};
}

Result<std::vector<std::string>> ListPictures(const std::string& path) {
  const Place place{path, 0, 0};
  std::error_code error;
  if (!fs::exists(path, error))
    return MakeError(ErrorCode::kNotFound, "there is no such file or folder", place);
  if (!fs::is_directory(path, error)) return std::vector<std::string>{path};
  std::vector<std::string> found;
  Walk(path, &found, &error);
  if (error) return MakeError(ErrorCode::kIo, "cannot be listed: " + error.message(), place);
  return found;
}

std::string FrameFileName(const std::string& name, uint32_t frame, const std::string& ending) {
  std::string number = std::to_string(frame);
  if (number.size() < 4) number.insert(0, 4 - number.size(), '0');
  return name + "." + number + "." + ending;
}

Result<FolderLock> FolderLock::Take(const std::string& folder) {
  const Place place{folder, 0, 0};
  const int fd = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0)
    return MakeError(ErrorCode::kIo, std::string("cannot be opened: ") + std::strerror(errno),
                     place);
  if (flock(fd, LOCK_EX | LOCK_NB) != 0) {
    const int reason = errno;
    close(fd);
    if (reason == EWOULDBLOCK) {
      return MakeError(ErrorCode::kIo,
                       "another fjord is writing into this folder; wait for it or name another "
                       "folder with -o",
                       place);
    }
    return FolderLock(-1);  // a file system without locks: go on without
  }
  return FolderLock(fd);
}

FolderLock::~FolderLock() {
  if (fd_ >= 0) close(fd_);
}

}  // namespace fjord
