// Numbers between commas and spaces, as all .svg attributes hold them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace fjord::formats {

struct SvgFault {
  size_t offset = 0;
  std::string message;  // empty: no fault
  bool ok() const { return message.empty(); }
};

class SvgScan {
 public:
  explicit SvgScan(std::string_view text) : text_(text) {}

  void SkipSpace();  // and at most one comma
  bool AtEnd() const { return at_ >= text_.size(); }
  char Peek() const { return AtEnd() ? '\0' : text_[at_]; }
  void Skip() { ++at_; }
  size_t offset() const { return at_; }
  // Letters only, in small form.
  std::string ReadWord();
  // A number starts here, spaces skipped.
  bool AtNumber();
  // False, and fault() set, where no good number stands.
  bool ReadNumber(double* value);
  bool ReadFlag(bool* value);  // one character, 0 or 1; what follows may touch it
  const SvgFault& fault() const { return fault_; }
  SvgFault Fault(std::string message) const { return {at_, std::move(message)}; }

 private:
  std::string_view text_;
  size_t at_ = 0;
  SvgFault fault_;
};

}  // namespace fjord::formats
