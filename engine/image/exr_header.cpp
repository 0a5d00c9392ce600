#include "engine/image/exr_header.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace fjord {
namespace {

constexpr uint32_t kTiled = 0x200;
constexpr uint32_t kDeep = 0x800;
constexpr uint32_t kMultiPart = 0x1000;
constexpr int kMostAttributes = 1000;
constexpr size_t kLongestName = 256;

class HeaderScan {
 public:
  explicit HeaderScan(std::string_view bytes) : bytes_(bytes) {}

  bool ReadInt(int64_t* value) {
    if (bytes_.size() - at_ < 4) return false;
    uint32_t bits = 0;
    for (size_t k = 0; k < 4; ++k) {
      bits |= uint32_t{static_cast<unsigned char>(bytes_[at_ + k])} << (8 * k);
    }
    *value = static_cast<int32_t>(bits);
    at_ += 4;
    return true;
  }

  bool ReadName(std::string_view* name) {
    const size_t end = bytes_.substr(0, at_ + kLongestName).find('\0', at_);
    if (end == bytes_.npos) return false;
    *name = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return true;
  }

  bool Skip(int64_t count) {
    if (count < 0 || static_cast<uint64_t>(count) > bytes_.size() - at_) return false;
    at_ += static_cast<size_t>(count);
    return true;
  }

 private:
  std::string_view bytes_;
  size_t at_ = 0;
};

bool IsSide(int64_t side, int most) { return side >= 1 && side <= most; }

}  // namespace

Result<> CheckExrHeader(std::string_view bytes, int most_side) {
  const Error broken = Invalid("its header is cut short or damaged");
  HeaderScan scan(bytes);
  int64_t version = 0;
  if (!scan.Skip(4) || !scan.ReadInt(&version)) return broken;
  const auto flags = static_cast<uint32_t>(version);
  if ((flags & (kDeep | kMultiPart)) != 0) return Invalid("deep and multi-part files are not read");
  bool window = false, tiles = (flags & kTiled) == 0;
  for (int i = 0; i < kMostAttributes; ++i) {
    std::string_view name, type;
    if (!scan.ReadName(&name)) return broken;
    if (name.empty()) {
      if (!window || !tiles) return broken;
      return Ok{};
    }
    int64_t size = 0;
    if (!scan.ReadName(&type) || !scan.ReadInt(&size)) return broken;
    HeaderScan value = scan;
    if (!scan.Skip(size)) return broken;
    if (name == "dataWindow" || name == "displayWindow") {
      int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
      if (size != 16 || !value.ReadInt(&x0) || !value.ReadInt(&y0) || !value.ReadInt(&x1) ||
          !value.ReadInt(&y1)) {
        return broken;
      }
      const int64_t width = x1 - x0 + 1, height = y1 - y0 + 1;
      if (width < 1 || height < 1) return broken;
      if (width > most_side || height > most_side) {
        const std::string most = std::to_string(most_side);
        return MakeError(ErrorCode::kLimit, "the picture is " + std::to_string(width) + "x" +
                                                std::to_string(height) + "; at most " + most + "x" +
                                                most + " are read");
      }
      window = window || name == "dataWindow";
    } else if (name == "tiles") {
      int64_t width = 0, height = 0;
      if (size != 9 || !value.ReadInt(&width) || !value.ReadInt(&height) ||
          !IsSide(width, most_side) || !IsSide(height, most_side)) {
        return broken;
      }
      tiles = true;
    }
  }
  return broken;
}

}  // namespace fjord
