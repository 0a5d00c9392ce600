#include "engine/image/png_chunks.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace fjord {
namespace {

uint32_t BigEndian(std::string_view bytes, size_t at) {
  uint32_t value = 0;
  for (size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  return value;
}

}  // namespace

Result<> CheckPngChunks(std::string_view bytes, uint32_t most_side) {
  constexpr size_t kAround = 12;  // length, type, checksum
  const Error broken = Invalid("its chunks are cut short or damaged");
  for (size_t at = 8; bytes.size() - at >= kAround;) {
    const uint32_t length = BigEndian(bytes, at);
    const std::string_view type = bytes.substr(at + 4, 4);
    if (length > bytes.size() - at - kAround) return broken;
    if (at == 8) {
      if (type != "IHDR" || length != 13) return broken;
      const uint32_t width = BigEndian(bytes, at + 8), height = BigEndian(bytes, at + 12);
      if (width == 0 || height == 0) return broken;
      if (width > most_side || height > most_side) {
        const std::string most = std::to_string(most_side);
        return MakeError(ErrorCode::kLimit, "the picture is " + std::to_string(width) + "x" +
                                                std::to_string(height) + "; at most " + most + "x" +
                                                most + " are read");
      }
    }
    if (type == "IEND") return Ok{};
    at += kAround + length;
  }
  return broken;
}

}  // namespace fjord
