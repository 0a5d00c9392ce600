// Result<T>: a value, or an error that a person can act on.
//
// Bad input and a failing environment are returned as errors, never thrown; a broken invariant of
// our own aborts through FJORD_CHECK (check.h). Nothing here allocates beyond the message.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/base/check.h"

namespace fjord {

enum class ErrorCode {
  kInvalid,      // the input is wrong: a scene, a file, a number
  kUsage,        // the command line is wrong
  kNotFound,     // a file, job or blob that should be there is not
  kIo,           // reading or writing failed: permissions, space, device
  kUnavailable,  // the other side cannot be reached
  kLimit,        // a stated bound was met
  kCancelled,
  kInternal,
};

// A position in a user's text. line and column count from 1; 0 means unknown.
struct Place {
  std::string file;
  int line = 0;
  int column = 0;

  // "file:line:column", as far as known.
  std::string ToString() const;
};

// `message` says what is wrong and what to do about it, without the place.
struct Error {
  ErrorCode code = ErrorCode::kInternal;
  std::string message;
  Place place;

  // "file:line:column: error: message", or "error: message" without a place.
  std::string ToString() const;
};

// Several defects of one input, reported together.
using Errors = std::vector<Error>;

struct Ok {};

template <typename T = Ok>
class [[nodiscard]] Result {
 public:
  Result() requires std::is_same_v<T, Ok> : value_(Ok{}) {}
  Result(T value) : value_(std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : value_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  bool ok() const { return std::holds_alternative<T>(value_); }
  explicit operator bool() const { return ok(); }

  T& value() & {
    FJORD_CHECK(ok(), error().message);
    return std::get<T>(value_);
  }
  const T& value() const& {
    FJORD_CHECK(ok(), error().message);
    return std::get<T>(value_);
  }
  T&& value() && {
    FJORD_CHECK(ok(), error().message);
    return std::get<T>(std::move(value_));
  }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  const Error& error() const { return std::get<Error>(value_); }

 private:
  std::variant<T, Error> value_;
};

Error Invalid(std::string message, Place place = {});
Error MakeError(ErrorCode code, std::string message, Place place = {});

}  // namespace fjord
