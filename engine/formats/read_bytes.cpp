#include "engine/formats/read_bytes.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

namespace fjord {
namespace {

Error TooLarge(const std::string& size, size_t most, const Place& place) {
  return MakeError(ErrorCode::kLimit,
                   "the file has " + size + " bytes; at most " + std::to_string(most) + " are read",
                   place);
}

}  // namespace

Result<std::string> ReadBytes(const std::string& path, size_t most) {
  const Place place = {path, 0, 0};
  std::error_code failed;
  if (std::filesystem::is_directory(path, failed)) {
    return MakeError(ErrorCode::kIo, "this is a folder; name a file in it", place);
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) {
    if (errno == ENOENT || errno == ENOTDIR) {
      return MakeError(ErrorCode::kNotFound, "there is no such file; check the name", place);
    }
    return MakeError(ErrorCode::kIo, std::string("cannot be opened: ") + std::strerror(errno),
                     place);
  }
  constexpr size_t kPiece = 1u << 20;
  std::string bytes;
  const auto size = std::filesystem::file_size(path, failed);  // fails for pipes and devices
  if (!failed && size > most) return TooLarge(std::to_string(size), most, place);
  if (!failed) bytes.reserve(static_cast<size_t>(size));
  while (true) {
    const size_t have = bytes.size();
    const size_t want = std::min(kPiece, most + 1 - have);
    bytes.resize(have + want);
    const size_t got = std::fread(bytes.data() + have, 1, want, file.get());
    bytes.resize(have + got);
    if (bytes.size() > most) {
      return TooLarge("more than " + std::to_string(most), most, place);
    }
    if (got < want) {
      if (std::ferror(file.get()) == 0) return bytes;
      return MakeError(ErrorCode::kIo, std::string("cannot be read: ") + std::strerror(errno),
                       place);
    }
  }
}

}  // namespace fjord
