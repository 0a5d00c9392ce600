#include "engine/formats/ply_body.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "engine/base/clamp.h"
#include "engine/formats/limits.h"

namespace fjord::formats {
namespace {

template <typename T>
double As(std::array<char, 8> bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return static_cast<double>(value);
}

double Decode(const char* at, PlyType type, PlyEncoding encoding) {
  std::array<char, 8> bytes{};
  const size_t size = PlyTypeBytes(type);
  std::memcpy(bytes.data(), at, size);
  const bool little = std::endian::native == std::endian::little;
  if ((encoding == PlyEncoding::kLittle) != little)
    std::reverse(bytes.begin(), bytes.begin() + size);
  switch (type) {
    case PlyType::kInt8:
      return As<int8_t>(bytes);
    case PlyType::kUint8:
      return As<uint8_t>(bytes);
    case PlyType::kInt16:
      return As<int16_t>(bytes);
    case PlyType::kUint16:
      return As<uint16_t>(bytes);
    case PlyType::kInt32:
      return As<int32_t>(bytes);
    case PlyType::kUint32:
      return As<uint32_t>(bytes);
    case PlyType::kFloat:
      return As<float>(bytes);
    case PlyType::kDouble:
      break;
  }
  return As<double>(bytes);
}

}  // namespace

PlyBody::PlyBody(std::string_view bytes, const std::string& name, const PlyHeader& header)
    : encoding_(header.encoding),
      name_(name),
      rest_(bytes.substr(header.bytes)),
      lines_(rest_),
      header_lines_(header.lines) {}

Error PlyBody::Fail(const PlyElement& element, uint64_t row, const std::string& message) const {
  return Invalid(element.name + " " + std::to_string(row + 1) + ": " + message, {name_, line_, 0});
}

Result<> PlyBody::ExpectBytesFor(const PlyElement& element) const {
  uint64_t least = 0;
  for (const PlyProperty& property : element.properties) {
    if (encoding_ == PlyEncoding::kAscii) {
      least += 2;  // a digit and a space
    } else {
      least += PlyTypeBytes(property.list ? property.count : property.type);
    }
  }
  const uint64_t left =
      encoding_ == PlyEncoding::kAscii ? rest_.size() - lines_.offset() + 2 : rest_.size();
  if (element.count <= left / least) return Ok{};
  return Invalid("the header counts " + std::to_string(element.count) + " of element " +
                     element.name + ", but only " + std::to_string(left) +
                     " bytes are left; the file is cut short or the count is wrong",
                 {name_, element.line, 1});
}

Result<> PlyBody::Read(const PlyElement& element, uint64_t row, PlyType type, bool count,
                       double* value) {
  if (encoding_ == PlyEncoding::kAscii) {
    text::Word word;
    if (auto ok = NextWord(element, row, &word); !ok) return ok;
    const text::NumberFault fault = text::ParseNumber(word.text, value);
    if (fault == text::NumberFault::kNotANumber) {
      return Fail(element, row, text::Explain(fault, word.text));
    }
    // As in binary files: whoever needs the value looks at it, and other properties hold anything.
    if (fault != text::NumberFault::kNone) *value = std::numeric_limits<double>::quiet_NaN();
  } else {
    const size_t size = PlyTypeBytes(type);
    if (rest_.size() < size) return Fail(element, row, "the file ends here; it is cut short");
    *value = Decode(rest_.data(), type, encoding_);
    rest_.remove_prefix(size);
  }
  if (!count) return Ok{};
  if (!(*value >= 0 && *value <= static_cast<double>(limits::kIndices))) {
    return Fail(element, row, "the length of a list is negative or absurd");
  }
  return Ok{};
}

// The next word, on this line or a later one: the format counts numbers, not lines.
Result<> PlyBody::NextWord(const PlyElement& element, uint64_t row, text::Word* word) {
  while (!words_.Next(word)) {
    text::Line line;
    if (!lines_.Next(&line)) {
      line_ = header_lines_ + lines_.line_number();
      return Fail(element, row, "the file ends here; it is cut short or the header counts wrongly");
    }
    line_ = header_lines_ + line.number;
    if (line.text.size() > limits::kLineBytes) {
      return MakeError(ErrorCode::kLimit, "a line longer than 16 MiB", {name_, line_, 1});
    }
    words_ = text::Words(line.text);
  }
  return Ok{};
}

Result<> PlyBody::ReadRow(const PlyElement& element, uint64_t row) {
  numbers_.clear();
  begin_.assign(1, 0);
  for (const PlyProperty& property : element.properties) {
    uint64_t count = 1;
    if (property.list) {
      double length = 0;
      if (auto ok = Read(element, row, property.count, true, &length); !ok) return ok;
      count = static_cast<uint64_t>(ClampToInt64(length));
    }
    for (uint64_t k = 0; k < count; ++k) {
      double value = 0;
      if (auto ok = Read(element, row, property.type, false, &value); !ok) return ok;
      numbers_.push_back(value);
    }
    begin_.push_back(numbers_.size());
  }
  return Ok{};
}

Result<> PlyBody::ExpectEnd() {
  if (encoding_ != PlyEncoding::kAscii) {
    if (rest_.empty()) return Ok{};
    return Invalid(std::to_string(rest_.size()) +
                       " bytes follow the last element; the header counts "
                       "too little",
                   {name_, 0, 0});
  }
  text::Word extra;
  if (words_.Next(&extra)) {
    return Invalid("more numbers than the header counts", {name_, line_, extra.column});
  }
  text::Line line;
  while (lines_.Next(&line)) {
    words_ = text::Words(line.text);
    if (!words_.Next(&extra)) continue;
    return Invalid("more numbers than the header counts",
                   {name_, header_lines_ + line.number, extra.column});
  }
  return Ok{};
}

}  // namespace fjord::formats
