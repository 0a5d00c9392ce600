// Exit codes of every Fjord program. Scripts rest on them.
#pragma once

#include "engine/base/result.h"

namespace fjord {

inline constexpr int kExitDone = 0;
inline constexpr int kExitFailed = 1;       // the scene, job or check failed
inline constexpr int kExitUsage = 2;        // the command line is wrong
inline constexpr int kExitUnreachable = 3;  // the server cannot be reached

inline int ExitCodeOf(const Error& error) {
  switch (error.code) {
    case ErrorCode::kUsage:
      return kExitUsage;
    case ErrorCode::kUnavailable:
      return kExitUnreachable;
    default:
      return kExitFailed;
  }
}

}  // namespace fjord
