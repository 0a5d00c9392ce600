// In place of codec.cpp where only the engine is built: without OpenImageIO no file can be read.
#include "engine/image/codec.h"

namespace fjord {

Result<std::string> EncodePicture(const Picture&, const PictureInfo&) {
  return MakeError(ErrorCode::kInternal, "this program was built without picture files");
}

Result<Picture> DecodePicture(std::string_view, const std::string& name, PictureInfo*) {
  return MakeError(ErrorCode::kInternal, name + ": this program was built without picture files");
}

}  // namespace fjord
