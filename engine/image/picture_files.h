// The seam between codec.cpp and OpenImageIO. OpenImageIO brings 250 shared libraries,
// which take a quarter of a second to load; so what needs it is a module of its own,
// fjord_picture_files.so, opened when the first picture is read or written. Most commands never do.
//
// F1 The module holds no state of Fjord's and links none of its libraries: plain functions.
// F2 Once opened it stays.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/image/codec.h"

namespace fjord {

// `ending` is "png" or "exr". False: the string says why. Thread-safe.
struct PictureFiles {
  bool (*encode)(const Picture& picture, const std::string& ending, const PictureInfo& info,
                 std::string* bytes_or_why);
  // `info` may be null. The header has passed the checks of codec.cpp.
  bool (*decode)(std::string_view bytes, const std::string& ending, Picture* picture,
                 PictureInfo* info, std::string* why);
};

// The one function of the module. Its name counts up when PictureFiles changes, so that a program
// and a module that do not belong together part with a message.
extern "C" __attribute__((visibility("default"))) const PictureFiles* FjordPictureFiles3();

// Opens the module at the first call; looks for it relative to the running program, as it is
// installed (../lib/fjord) and as it is built. Thread-safe.
Result<const PictureFiles*> OpenPictureFiles();

}  // namespace fjord
