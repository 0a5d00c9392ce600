#include "engine/image/codec.h"

#include "engine/image/exr_header.h"
#include "engine/image/picture_files.h"
#include "engine/image/png_chunks.h"

namespace fjord {
namespace {

constexpr int kLargestSide = 16384;

// Whether the first bytes are those of a PNG or an EXR: a library is never asked to guess.
std::string FormatOf(std::string_view bytes) {
  if (bytes.substr(0, 8) == std::string_view("\x89PNG\r\n\x1a\n", 8)) return "png";
  if (bytes.substr(0, 4) == std::string_view("\x76\x2f\x31\x01", 4)) return "exr";
  return "";
}

Error Broken(const std::string& name, const std::string& why) {
  return Invalid("the picture cannot be read (" + why + "); make it again", Place{name});
}

}  // namespace

Result<std::string> EncodePicture(const Picture& picture, const PictureInfo& info) {
  const Result<const PictureFiles*> files = OpenPictureFiles();
  if (!files.ok()) return files.error();
  std::string text;
  if (!(*files)->encode(picture, FileEnding(picture.format), info, &text))
    return MakeError(ErrorCode::kInternal, text);
  return text;
}

Result<Picture> DecodePicture(std::string_view bytes, const std::string& name, PictureInfo* info) {
  const std::string ending = FormatOf(bytes);
  if (ending.empty()) return Broken(name, "neither PNG nor OpenEXR");
  const Result<> sound =
      ending == "exr" ? CheckExrHeader(bytes, kLargestSide) : CheckPngChunks(bytes, kLargestSide);
  if (!sound.ok()) {
    if (sound.error().code != ErrorCode::kLimit) return Broken(name, sound.error().message);
    return MakeError(ErrorCode::kLimit, sound.error().message, Place{name});
  }
  const Result<const PictureFiles*> files = OpenPictureFiles();
  if (!files.ok()) return files.error();
  Picture picture;
  std::string why;
  if (!(*files)->decode(bytes, ending, &picture, info, &why)) return Broken(name, why);
  return picture;
}

}  // namespace fjord
