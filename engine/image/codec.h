// Encoding and decoding picture files, through the module of picture_files.h. Thread-safe.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/image/picture.h"

namespace fjord {

// What goes into the file beside the samples: frame key, seed and parameters, and nothing that is
// not in the key.
using PictureInfo = std::vector<std::pair<std::string, std::string>>;

// The bytes of a .png or .exr file, the same for the same input and library version.
Result<std::string> EncodePicture(const Picture& picture, const PictureInfo& info);

// Decodes what EncodePicture made, and any PNG or EXR of 8, 16, half or float samples; at most
// 16384x16384. `name` is used in errors.
Result<Picture> DecodePicture(std::string_view bytes, const std::string& name,
                              PictureInfo* info = nullptr);

// Writes to a temporary beside `path`, syncs, renames: a reader never sees half a file. kIo where
// something other than a file has that name.
Result<> WriteFileAtomically(const std::string& path, std::string_view bytes);

}  // namespace fjord
