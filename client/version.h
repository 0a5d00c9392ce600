// The version of these programs (CMakeLists.txt).
#pragma once

namespace fjord {

inline constexpr const char* kFjordVersion = FJORD_VERSION;

}  // namespace fjord
