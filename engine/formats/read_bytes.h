// A whole file into memory, with a bound, and errors that say what to do.
#pragma once

#include <cstddef>
#include <string>

#include "engine/base/result.h"

namespace fjord {

// kNotFound: no such file; kIo: a folder, a device, no permission, a failing disk; kLimit: more
// than `most` bytes. Never reads past the bound, and never takes more memory: a pipe that does not
// end is refused too.
Result<std::string> ReadBytes(const std::string& path, size_t most);

}  // namespace fjord
