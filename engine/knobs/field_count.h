// How many fields a plain struct has, counted at compile time: so a field without a row in its
// entry's table does not compile.
#pragma once

#include <cstddef>

namespace fjord {

struct AnyField {
  template <typename T>
  constexpr operator T() const noexcept;  // NOLINT: never called, stands for any value
};

// Fields of the aggregate S; a base class counts as one.
template <typename S, typename... Fields>
consteval size_t FieldCount() {
  if constexpr (requires { S{Fields{}..., AnyField{}}; }) {
    return FieldCount<S, Fields..., AnyField>();
  } else {
    return sizeof...(Fields);
  }
}

}  // namespace fjord
