// Files of the client: whole files, folders of pictures, names that are written.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/read_bytes.h"

namespace fjord {

// The whole of a file of at most 1 GiB; errors name the path and the remedy.
inline Result<std::string> ReadFile(const std::string& path) {
  return ReadBytes(path, size_t{1} << 30);
}

// Makes the folder and its parents where missing; kIo where that fails or it cannot be written.
// `option`: the one that names another.
Result<> MakeFolder(const std::string& path, const std::string& option = "-o");

// .png and .exr files: a file itself; of a folder, all below it in name order. Hidden ones are left
// out, and so are links to folders, which may go round in circles.
Result<std::vector<std::string>> ListPictures(const std::string& path);

// NAME.0001.png. Four digits, more where the number needs them.
std::string FrameFileName(const std::string& name, uint32_t frame, const std::string& ending);

// A lock on a folder for as long as this lives; another process that holds it: kIo, naming the
// folder.
class FolderLock {
 public:
  static Result<FolderLock> Take(const std::string& folder);
  FolderLock(FolderLock&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FolderLock& operator=(FolderLock&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~FolderLock();

 private:
  explicit FolderLock(int fd) : fd_(fd) {}
  int fd_;
};

}  // namespace fjord
