// Rows of a .ply body, ASCII or binary, one at a time.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/ply_header.h"
#include "engine/formats/text.h"

namespace fjord::formats {

// Refers to the caller's bytes, name and header.
class PlyBody {
 public:
  PlyBody(std::string_view bytes, const std::string& name, const PlyHeader& header);

  // As many bytes are left as `element` needs at the least.
  Result<> ExpectBytesFor(const PlyElement& element) const;
  // Reads row `row` (from 0) of an element with one or more properties.
  Result<> ReadRow(const PlyElement& element, uint64_t row);
  Result<> ExpectEnd();

  // Of the row read last, by property. A single value may be any double, NaN too; in ASCII files
  // NaN also stands for numbers beyond 1e15.
  double Value(size_t property) const { return numbers_[begin_[property]]; }
  std::span<const double> List(size_t property) const {
    return std::span<const double>(numbers_).subspan(begin_[property],
                                                     begin_[property + 1] - begin_[property]);
  }
  int line() const { return line_; }  // of the number read last; 0 in binary files

  // "face 17: ..." with that line.
  Error Fail(const PlyElement& element, uint64_t row, const std::string& message) const;

 private:
  Result<> NextWord(const PlyElement& element, uint64_t row, text::Word* word);
  Result<> Read(const PlyElement& element, uint64_t row, PlyType type, bool count, double* value);

  const PlyEncoding encoding_;
  const std::string& name_;
  std::string_view rest_;   // binary
  text::LineReader lines_;  // ASCII
  text::Words words_{""};
  int header_lines_;
  int line_ = 0;
  std::vector<double> numbers_;
  std::vector<size_t> begin_;
};

}  // namespace fjord::formats
