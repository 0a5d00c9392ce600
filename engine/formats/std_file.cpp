// .std and .epf (S27): free text up to a line `data NPTS NPOLYS`, then NPTS lines `x y z` and
// NPOLYS lines `n i1..in`, vertices from 1. Blank lines and lines that start with # are passed
// over.
#include <algorithm>
#include <array>
#include <charconv>

#include "engine/formats/limits.h"
#include "engine/formats/readers.h"
#include "engine/formats/text.h"

namespace fjord::formats {
namespace {

using text::NumberFault;

constexpr uint8_t kShortest = 255;
constexpr int kMostDecimals = 20;

// Digits after the point of a plain decimal; kShortest for other forms.
uint8_t DecimalsOf(std::string_view word) {
  const size_t point = word.find('.');
  if (word.find_first_not_of("-.0123456789") != word.npos) return kShortest;
  const size_t digits = point == word.npos ? 0 : word.size() - point - 1;
  return digits <= kMostDecimals ? static_cast<uint8_t>(digits) : kShortest;
}

class StdReader {
 public:
  StdReader(std::string_view bytes, const std::string& name)
      : lines_(bytes), bytes_(bytes), name_(name) {}

  Result<ShapeFile> Read() {
    if (auto ok = FindData(); !ok) return ok.error();
    if (auto ok = ReadPoints(); !ok) return ok.error();
    if (auto ok = ReadFaces(); !ok) return ok.error();
    while (NextLine()) {
      return Fail(1, "more lines than the data line counts (" + std::to_string(points_) +
                         " points, " + std::to_string(faces_) + " polygons); correct the counts");
    }
    if (too_long_) return LineTooLong(At(1));
    return std::move(shape_);
  }

 private:
  Place At(int column) const { return {name_, line_.number, column}; }
  Error Fail(int column, std::string message) const {
    return Invalid(std::move(message), At(column));
  }

  // The next line that says something.
  bool NextLine() {
    while (lines_.Next(&line_)) {
      if (line_.text.size() > limits::kLineBytes) {
        too_long_ = true;
        return false;
      }
      const size_t first = line_.text.find_first_not_of(" \t");
      if (first != line_.text.npos && line_.text[first] != '#') return true;
    }
    return false;
  }

  Result<> FindData() {
    bool found = false;
    int bare = 0;  // a line of the word `data` alone
    while (!found && lines_.Next(&line_)) {
      if (line_.text.size() > limits::kLineBytes) return LineTooLong(At(1));
      text::Words words(line_.text);
      text::Word word;
      found = IsStdDataLine(line_.text);
      if (!found && words.Next(&word) && word.text == "data" && !words.Next(&word) && bare == 0) {
        bare = line_.number;
      }
    }
    if (!found) {
      return Invalid(
          "no line `data NPTS NPOLYS` with two counts; a .std file needs one before its "
          "points",
          {name_, bare, bare > 0 ? 1 : 0});
    }
    text::Words words(line_.text);
    text::Word word;
    words.Next(&word);
    if (auto ok = ReadCount(&words, "points", limits::kVertices, &points_); !ok) return ok.error();
    if (auto ok = ReadCount(&words, "polygons", limits::kIndices / 3, &faces_); !ok) {
      return ok.error();
    }
    if (words.Next(&word)) return Fail(word.column, "`data` takes two counts, NPTS and NPOLYS");
    const size_t left = bytes_.size() - lines_.offset();
    // The shortest point is "0 0 0" and a line end, the shortest polygon "3 1 2 3" and one.
    if (points_ * 6 + faces_ * 8 > left + 2) {
      return Fail(1, "the data line counts " + std::to_string(points_) + " points and " +
                         std::to_string(faces_) + " polygons, but only " + std::to_string(left) +
                         " bytes follow; the file is cut short or the counts are wrong");
    }
    return Ok{};
  }

  Result<> ReadCount(text::Words* words, const char* what, size_t most, size_t* count) {
    text::Word word;
    if (!words->Next(&word)) {
      return Fail(words->column(),
                  std::string("the number of ") + what + " is missing after `data`");
    }
    int64_t value = 0;
    const NumberFault fault = text::ParseInteger(word.text, &value);
    if (fault == NumberFault::kNotANumber) {
      return Fail(word.column, "the number of " + std::string(what) +
                                   " must be a whole number, not " + text::Quoted(word.text));
    }
    if (fault == NumberFault::kNone && value < 1) {
      return Fail(word.column, "the number of " + std::string(what) + " must be at least 1, not " +
                                   text::Quoted(word.text));
    }
    if (fault != NumberFault::kNone || static_cast<uint64_t>(value) > most) {
      return MakeError(ErrorCode::kLimit,
                       text::Quoted(word.text) + " " + what + " are more than " +
                           std::to_string(most) + ", the most a file may hold",
                       At(word.column));
    }
    *count = static_cast<size_t>(value);
    return Ok{};
  }

  Error EndsEarly(size_t have, size_t want, const char* what) const {
    if (too_long_) return LineTooLong(At(1));
    return Invalid("the file ends after " + std::to_string(have) + " of " + std::to_string(want) +
                       " " + what + "; it is cut short or the data line counts wrongly",
                   {name_, lines_.line_number(), 0});
  }

  Result<> ReadPoints() {
    shape_.mesh.points.reserve(points_);
    shape_.vertex_line.reserve(points_);
    shape_.decimals.reserve(3 * points_);
    for (size_t v = 0; v < points_; ++v) {
      if (!NextLine()) return EndsEarly(v, points_, "points");
      text::Words words(line_.text);
      text::Word word;
      Vec3 point(0);
      for (int k = 0; k < 3; ++k) {
        if (!words.Next(&word)) {
          return Fail(words.column(), "point " + std::to_string(v + 1) + " has " +
                                          std::to_string(k) + " coordinates; write x y z");
        }
        const NumberFault fault = text::ParseNumber(word.text, &point[k]);
        if (fault != NumberFault::kNone) {
          return Fail(word.column,
                      "point " + std::to_string(v + 1) + ": " + text::Explain(fault, word.text));
        }
        shape_.decimals.push_back(DecimalsOf(word.text));
      }
      if (words.Next(&word)) {
        return Fail(word.column, "point " + std::to_string(v + 1) +
                                     " has more than three coordinates; write x y z");
      }
      shape_.mesh.points.push_back(point);
      shape_.vertex_line.push_back(line_.number);
    }
    return Ok{};
  }

  Result<> ReadFaces() {
    shape_.mesh.face_size.reserve(faces_);
    shape_.face_line.reserve(faces_);
    for (size_t f = 0; f < faces_; ++f) {
      if (!NextLine()) return EndsEarly(f, faces_, "polygons");
      const std::string name = "polygon " + std::to_string(f + 1);
      text::Words words(line_.text);
      text::Word word;
      words.Next(&word);
      int64_t corners = 0;
      if (text::ParseInteger(word.text, &corners) != NumberFault::kNone) {
        return Fail(word.column, name + " starts with the number of its vertices, not " +
                                     text::Quoted(word.text));
      }
      if (corners < 3) {
        return Fail(word.column,
                    name + " has " + std::to_string(corners) + " vertices; at least 3 are needed");
      }
      int64_t read = 0;
      while (words.Next(&word)) {
        int64_t vertex = 0;
        if (text::ParseInteger(word.text, &vertex) != NumberFault::kNone) {
          return Fail(word.column, name + ": " + text::Quoted(word.text) + " is no vertex number");
        }
        if (vertex < 1 || vertex > static_cast<int64_t>(points_)) {
          return Fail(word.column, name + " names vertex " + std::to_string(vertex) +
                                       "; vertices are 1 to " + std::to_string(points_));
        }
        if (shape_.mesh.face_vertex.size() >= limits::kIndices)
          return TooManyIndices(At(word.column));
        if (++read > corners) break;
        shape_.mesh.face_vertex.push_back(static_cast<uint32_t>(vertex - 1));
      }
      if (read != corners) {
        return Fail(read > corners ? word.column : words.column(),
                    name + " says " + std::to_string(corners) + " vertices and lists " +
                        (read > corners ? "more" : std::to_string(read)));
      }
      shape_.mesh.face_size.push_back(static_cast<uint32_t>(corners));
      shape_.face_line.push_back(line_.number);
    }
    return Ok{};
  }

  text::LineReader lines_;
  const std::string_view bytes_;
  const std::string& name_;
  text::Line line_;
  bool too_long_ = false;
  size_t points_ = 0;
  size_t faces_ = 0;
  ShapeFile shape_;
};

void AppendAs(double value, uint8_t decimals, std::string* out) {
  std::array<char, 64> buffer{};
  if (decimals <= kMostDecimals) {
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                   std::chars_format::fixed, decimals);
    double back = 0;
    if (end.ec == std::errc() && std::from_chars(buffer.data(), end.ptr, back).ec == std::errc() &&
        back == value) {
      out->append(buffer.data(), end.ptr);
      return;
    }
  }
  text::Append(value, out);
}

}  // namespace

bool IsStdDataLine(std::string_view line) {
  text::Words words(line.substr(0, 200));
  text::Word word;
  return words.Next(&word) && word.text == "data" && words.Next(&word) &&
         text::LooksLikeNumber(word.text);
}

Result<ShapeFile> ReadStd(std::string_view bytes, const std::string& name) {
  return StdReader(bytes, name).Read();
}

std::string WriteStd(const ShapeFile& shape, const Comment& comment) {
  std::string out;
  for (const std::string& line : comment) {
    const std::string clean = text::OneLine(line);
    out += (IsStdDataLine(clean) ? "# " : "") + clean + '\n';
  }
  size_t points = shape.mesh.points.size();
  for (const Polyline& curve : shape.curves) points += curve.points.size();
  out += "data ";
  text::Append(uint64_t{points}, &out);
  out += ' ';
  text::Append(uint64_t{shape.mesh.FaceCount() + shape.curves.size()}, &out);
  out += '\n';

  size_t coordinate = 0;
  const auto add_point = [&](const Vec3& p) {
    for (int k = 0; k < 3; ++k) {
      AppendAs(p[k], coordinate < shape.decimals.size() ? shape.decimals[coordinate] : kShortest,
               &out);
      ++coordinate;
      out += k < 2 ? ' ' : '\n';
    }
  };
  for (const Vec3& p : shape.mesh.points) add_point(p);
  for (const Polyline& curve : shape.curves) {
    for (const Vec3& p : curve.points) add_point(p);
  }
  size_t corner = 0;
  for (const uint32_t size : shape.mesh.face_size) {
    text::Append(uint64_t{size}, &out);
    for (size_t k = 0; k < size; ++k) {
      out += ' ';
      text::Append(uint64_t{shape.mesh.face_vertex[corner++]} + 1, &out);
    }
    out += '\n';
  }
  uint64_t next = shape.mesh.points.size() + 1;
  for (const Polyline& curve : shape.curves) {
    text::Append(uint64_t{curve.points.size()}, &out);
    for (size_t k = 0; k < curve.points.size(); ++k) {
      out += ' ';
      text::Append(next++, &out);
    }
    out += '\n';
  }
  return out;
}

}  // namespace fjord::formats
