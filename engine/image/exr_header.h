// A look at an OpenEXR header before a library gets the bytes: a few hundred damaged bytes can ask
// it for gigabytes and half a minute.
#pragma once

#include <string_view>

#include "engine/base/result.h"

namespace fjord {

// `bytes` start with the magic number. An error's message says what is wrong with the file; its
// place is empty. Passes flat pictures of one part of which every side, and every tile's,
// is 1..most_side.
Result<> CheckExrHeader(std::string_view bytes, int most_side);

}  // namespace fjord
