// The version of the conversation between client, worker and coordinator, and its fixed numbers.
// Another major number is refused with FAILED_PRECONDITION; a minor one only adds fields.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace fjord {

inline constexpr char kProtocol[] = "1.0";
inline constexpr char kDefaultServer[] = "127.0.0.1:7433";
inline constexpr char kVersion[] = "0.1.0";

inline constexpr size_t kBlobChunk = size_t{1} << 20;    // bytes of data in one message
inline constexpr uint64_t kMaxBlob = uint64_t{1} << 30;  // bytes
inline constexpr int kMaxMessage = 2 << 20;              // bytes of one message
inline constexpr int kMaxMissing = 10'000;               // digests in one question
inline constexpr uint32_t kMaxPage = 1'000;              // jobs or frames in one answer

// The major number of `protocol` is ours.
constexpr bool SpeaksOurProtocol(std::string_view protocol) {
  const std::string_view ours(kProtocol);
  const std::string_view major = ours.substr(0, ours.find('.') + 1);
  return protocol.substr(0, major.size()) == major;
}

}  // namespace fjord
