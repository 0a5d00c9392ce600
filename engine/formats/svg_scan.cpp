#include "engine/formats/svg_scan.h"

#include "engine/formats/text.h"

namespace fjord::formats {
namespace {

bool IsSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }
bool IsDigit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

void SvgScan::SkipSpace() {
  bool comma = false;
  while (!AtEnd() && (IsSpace(text_[at_]) || (text_[at_] == ',' && !comma))) {
    comma = comma || text_[at_] == ',';
    ++at_;
  }
}

std::string SvgScan::ReadWord() {
  std::string word;
  for (; !AtEnd(); ++at_) {
    const char c = Peek();
    if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'))) break;
    word += c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return word;
}

bool SvgScan::AtNumber() {
  SkipSpace();
  const char c = Peek();
  return IsDigit(c) || c == '-' || c == '+' || c == '.';
}

// The grammar lets numbers touch: "1-2" and "1.5.5" are two numbers each, "1e-2" is one.
bool SvgScan::ReadNumber(double* value) {
  SkipSpace();
  size_t end = at_;
  const auto peek = [&] { return end < text_.size() ? text_[end] : '\0'; };
  if (peek() == '-' || peek() == '+') ++end;
  while (IsDigit(peek())) ++end;
  if (peek() == '.') ++end;
  while (IsDigit(peek())) ++end;
  if (peek() == 'e' || peek() == 'E') {
    size_t digits = end + 1;
    if (digits < text_.size() && (text_[digits] == '-' || text_[digits] == '+')) ++digits;
    if (digits < text_.size() && IsDigit(text_[digits])) {
      end = digits;
      while (IsDigit(peek())) ++end;
    }
  }
  const std::string_view number = text_.substr(at_, end - at_);
  const text::NumberFault bad = text::ParseNumber(number, value);
  if (bad != text::NumberFault::kNone) {
    fault_ = Fault(AtEnd() ? "a number is missing"
                           : text::Explain(bad, number.empty() ? text_.substr(at_, 12) : number));
    return false;
  }
  at_ = end;
  return true;
}

bool SvgScan::ReadFlag(bool* value) {
  SkipSpace();
  const char c = Peek();
  if (c != '0' && c != '1') {
    fault_ = Fault("a flag of an arc is 0 or 1");
    return false;
  }
  *value = c == '1';
  ++at_;
  return true;
}

}  // namespace fjord::formats
