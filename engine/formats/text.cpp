#include "engine/formats/text.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "engine/formats/limits.h"

namespace fjord::text {
namespace {

bool IsSpace(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

std::string_view WithoutPlus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
  return word;
}

// "nan", "-inf", "infinity", "nan(...)", which std::from_chars would take and people do not mean,
// and what some C libraries print instead: "1.#QNAN", "-1.#INF".
bool IsNotFinite(std::string_view word) {
  if (!word.empty() && (word[0] == '-' || word[0] == '+')) word.remove_prefix(1);
  std::string lower;
  for (const char c : word.substr(0, 9)) {
    lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return lower == "nan" || lower == "inf" || lower == "infinity" || lower.rfind("nan(", 0) == 0 ||
         lower.rfind("1.#", 0) == 0;
}

}  // namespace

LineReader::LineReader(std::string_view bytes) : bytes_(bytes) {
  if (bytes_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;
}

bool LineReader::Next(Line* line) {
  if (at_ >= bytes_.size()) return false;
  size_t end = bytes_.find_first_of("\r\n", at_);
  if (end == std::string_view::npos) end = bytes_.size();
  line->text = bytes_.substr(at_, end - at_);
  line->number = ++number_;
  if (end < bytes_.size() && bytes_[end] == '\r' && end + 1 < bytes_.size() &&
      bytes_[end + 1] == '\n') {
    ++end;
  }
  at_ = std::min(end + 1, bytes_.size());
  return true;
}

bool Words::Next(Word* word) {
  while (at_ < line_.size() && IsSpace(line_[at_])) ++at_;
  if (at_ >= line_.size()) return false;
  const size_t begin = at_;
  while (at_ < line_.size() && !IsSpace(line_[at_])) ++at_;
  *word = {line_.substr(begin, at_ - begin), static_cast<int>(begin) + 1};
  return true;
}

NumberFault ParseNumber(std::string_view word, double* value) {
  if (IsNotFinite(word)) return NumberFault::kNotFinite;
  const std::string_view digits = WithoutPlus(word);
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, *value);
  if (stop != end || error == std::errc::invalid_argument) return NumberFault::kNotANumber;
  if (error != std::errc()) {
    // Out of range: too small is nothing, too large is an error.
    const bool small = digits.find("e-") != digits.npos || digits.find("E-") != digits.npos ||
                       digits.find_first_of("eE") == digits.npos;
    if (!small || digits.find_first_of("eE") == digits.npos) return NumberFault::kTooLarge;
    *value = 0;
  }
  if (*value > limits::kCoordinate || *value < -limits::kCoordinate) return NumberFault::kTooLarge;
  return NumberFault::kNone;
}

NumberFault ParseInteger(std::string_view word, int64_t* value) {
  const std::string_view digits = WithoutPlus(word);
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, *value);
  if (stop != end || error == std::errc::invalid_argument) return NumberFault::kNotANumber;
  return error == std::errc() ? NumberFault::kNone : NumberFault::kTooLarge;
}

bool LooksLikeNumber(std::string_view word) {
  double value = 0;
  return ParseNumber(word, &value) != NumberFault::kNotANumber;
}

std::string Explain(NumberFault fault, std::string_view word) {
  switch (fault) {
    case NumberFault::kNotFinite:
      return Quoted(word) + " is not finite; write a number";
    case NumberFault::kTooLarge:
      return Quoted(word) + " is too large; numbers up to 1e15 are taken";
    case NumberFault::kNotANumber:
    case NumberFault::kNone:
      break;
  }
  return Quoted(word) + " is not a number";
}

std::string Quoted(std::string_view word) {
  constexpr size_t kMost = 40;
  std::string quoted = "'";
  for (const char c : word.substr(0, kMost)) quoted += c >= ' ' && c < 0x7f ? c : '?';
  return quoted + (word.size() > kMost ? "...'" : "'");
}

void Append(double value, std::string* out) {
  std::array<char, 32> buffer{};
  out->append(buffer.data(),
              std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr);
}

void Append(float value, std::string* out) {
  std::array<char, 32> buffer{};
  out->append(buffer.data(),
              std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr);
}

void Append(uint64_t value, std::string* out) {
  std::array<char, 32> buffer{};
  out->append(buffer.data(),
              std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr);
}

std::string OneLine(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c == '\n' || c == '\r' || c == '\t') {
      line += ' ';
    } else if (static_cast<unsigned char>(c) >= ' ' && c != 0x7f) {
      line += c;
    }
  }
  return line;
}

bool LooksBinary(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, 4096);
  size_t odd = 0;
  for (const char c : head) {
    const auto u = static_cast<unsigned char>(c);
    if (u == 0) return true;
    odd += u < ' ' && c != '\n' && c != '\r' && c != '\t' && c != '\f' && c != '\v' ? 1 : 0;
  }
  return odd * 10 > head.size();
}

}  // namespace fjord::text
