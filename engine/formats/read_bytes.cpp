#include "engine/formats/read_bytes.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

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
  if (std::filesystem::is_character_file(path, failed) ||
      std::filesystem::is_block_file(path, failed)) {
    return MakeError(ErrorCode::kIo, "this is a device, which may never end; name a file", place);
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
  const auto size = std::filesystem::file_size(path, failed);  // fails for pipes
  if (!failed && size > most) return TooLarge(std::to_string(size), most, place);
  // In pieces, so that what does not end never takes more than the bound.
  constexpr size_t kPiece = 1u << 20;
  const size_t whole = failed ? kPiece : static_cast<size_t>(size) + 1;
  std::vector<std::string> pieces;
  size_t have = 0;
  while (true) {
    std::string& piece = pieces.emplace_back();
    const size_t want =
        std::min(pieces.size() == 1 ? std::max(whole, kPiece) : kPiece, most + 1 - have);
    piece.resize(want);
    const size_t got = std::fread(piece.data(), 1, want, file.get());
    piece.resize(got);
    have += got;
    if (have > most) return TooLarge("more than " + std::to_string(most), most, place);
    if (got == want) continue;
    if (std::ferror(file.get()) == 0) break;
    return MakeError(ErrorCode::kIo, std::string("cannot be read: ") + std::strerror(errno), place);
  }
  std::string bytes = std::move(pieces[0]);
  bytes.reserve(have);
  for (size_t i = 1; i < pieces.size(); ++i) {
    bytes += pieces[i];
    pieces[i] = std::string();
  }
  return bytes;
}

}  // namespace fjord
