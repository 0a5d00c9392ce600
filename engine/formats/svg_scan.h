// Numbers between commas and spaces, as all .svg attributes hold them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/formats/svg_path.h"

namespace fjord::formats {

class SvgScan {
 public:
  explicit SvgScan(std::string_view text) : text_(text) {}

  void SkipSpace();  // and at most one comma
  bool AtEnd() const { return at_ >= text_.size(); }
  char Peek() const { return AtEnd() ? '\0' : text_[at_]; }
  void Skip() { ++at_; }
  size_t offset() const { return at_; }
  // Letters only.
  std::string_view ReadWord();
  // A number starts here, spaces skipped.
  bool AtNumber();
  // False, and fault() set, where no good number stands.
  bool ReadNumber(double* value);
  const SvgFault& fault() const { return fault_; }
  SvgFault Fault(std::string message) const { return {at_, std::move(message)}; }

 private:
  std::string_view text_;
  size_t at_ = 0;
  SvgFault fault_;
};

}  // namespace fjord::formats
