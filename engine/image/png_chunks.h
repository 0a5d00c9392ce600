// A look at a PNG's chunks before a library gets the bytes: one that claims two gigabytes makes it
// take them before it notices that the file is short.
#pragma once

#include <cstdint>
#include <string_view>

#include "engine/base/result.h"

namespace fjord {

// `bytes` start with the signature. Passes files whose chunks, up to IEND, all lie within the
// bytes, and whose sides are 1..most_side. An error's message says what is wrong; its place is
// empty.
Result<> CheckPngChunks(std::string_view bytes, uint32_t most_side);

}  // namespace fjord
