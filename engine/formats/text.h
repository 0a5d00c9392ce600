// Reading text line by line and word by word, with places for messages; printing numbers. No
// locale: std::from_chars and std::to_chars only. Views point into the caller's bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace fjord::text {

struct Line {
  std::string_view text;  // without its end
  int number = 0;         // from 1
};

// Lines end in \n, \r\n or \r; a file's last line needs no end.
class LineReader {
 public:
  explicit LineReader(std::string_view bytes);  // leaves out a byte order mark
  bool Next(Line* line);
  size_t offset() const { return at_; }
  int line_number() const { return number_; }

 private:
  std::string_view bytes_;
  size_t at_ = 0;
  int number_ = 0;
};

struct Word {
  std::string_view text;
  int column = 0;  // from 1, in bytes
};

// Words between spaces and tabs.
class Words {
 public:
  explicit Words(std::string_view line) : line_(line) {}
  bool Next(Word* word);
  int column() const { return static_cast<int>(at_) + 1; }

 private:
  std::string_view line_;
  size_t at_ = 0;
};

// Numbers as people write them: a leading + is taken; "nan", "inf" and hexadecimal are not numbers.
enum class NumberFault { kNone, kNotANumber, kNotFinite, kTooLarge };
NumberFault ParseNumber(std::string_view word, double* value);  // |x| <= limits::kCoordinate
NumberFault ParseInteger(std::string_view word, int64_t* value);
bool LooksLikeNumber(std::string_view word);

// "'1.2.3' is not a number", "nan is not finite; ...", "1e308 is larger than 1e15; ...".
std::string Explain(NumberFault fault, std::string_view word);

// A word of the file, shortened and with unprintable bytes replaced, in quotes.
std::string Quoted(std::string_view word);

// The shortest decimal that reads back as the same number.
void Append(double value, std::string* out);
void Append(float value, std::string* out);
void Append(uint64_t value, std::string* out);

// `text` with line breaks turned into spaces and other control characters left out.
std::string OneLine(std::string_view text);

// The first bytes hold a zero byte or are mostly unprintable: no text.
bool LooksBinary(std::string_view bytes);

}  // namespace fjord::text
