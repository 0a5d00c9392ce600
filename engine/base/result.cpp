#include "engine/base/result.h"

#include <cstdio>
#include <cstdlib>

namespace fjord {

std::string Place::ToString() const {
  std::string text = file;
  if (line > 0) {
    text += ':' + std::to_string(line);
    if (column > 0) text += ':' + std::to_string(column);
  }
  return text;
}

std::string Error::ToString() const {
  const std::string where = place.ToString();
  return (where.empty() ? "error: " : where + ": error: ") + message;
}

Error MakeError(ErrorCode code, std::string message, Place place) {
  return Error{code, std::move(message), std::move(place)};
}

Error Invalid(std::string message, Place place) {
  return MakeError(ErrorCode::kInvalid, std::move(message), std::move(place));
}

namespace internal {

void CheckFailed(const char* file, int line, const char* condition, const std::string& details) {
  std::fprintf(stderr, "%s:%d: fatal: broken invariant %s%s\n", file, line, condition,
               details.c_str());
  std::fflush(stderr);
  std::abort();
}

}  // namespace internal
}  // namespace fjord
