// FJORD_CHECK(condition, details...): a broken invariant of our own stops the program at once, with
// the place, the condition and the values named. Never for user input.
#pragma once

#include <sstream>
#include <string>

namespace fjord::internal {

[[noreturn]] void CheckFailed(const char* file, int line, const char* condition,
                              const std::string& details);

template <typename... Parts>
std::string CheckDetails(const Parts&... parts) {
  std::ostringstream out;
  ((out << ' ' << parts), ...);
  return out.str();
}

}  // namespace fjord::internal

#define FJORD_CHECK(condition, ...)                                                 \
  do {                                                                              \
    if (!(condition)) [[unlikely]] {                                                \
      ::fjord::internal::CheckFailed(__FILE__, __LINE__, #condition,                \
                                     ::fjord::internal::CheckDetails(__VA_ARGS__)); \
    }                                                                               \
  } while (false)
