#include "engine/formats/ply_header.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "engine/formats/limits.h"
#include "engine/formats/text.h"

namespace fjord::formats {
namespace {

constexpr size_t kMostElements = 64;
constexpr size_t kMostProperties = 256;

std::optional<PlyType> TypeOf(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes = {
      {{"char", PlyType::kInt8},
       {"int8", PlyType::kInt8},
       {"uchar", PlyType::kUint8},
       {"uint8", PlyType::kUint8},
       {"short", PlyType::kInt16},
       {"int16", PlyType::kInt16},
       {"ushort", PlyType::kUint16},
       {"uint16", PlyType::kUint16},
       {"int", PlyType::kInt32},
       {"int32", PlyType::kInt32},
       {"uint", PlyType::kUint32},
       {"uint32", PlyType::kUint32},
       {"float", PlyType::kFloat},
       {"float32", PlyType::kFloat},
       {"double", PlyType::kDouble},
       {"float64", PlyType::kDouble}}};
  for (const auto& [name, type] : kTypes) {
    if (name == word) return type;
  }
  return std::nullopt;
}

bool IsInteger(PlyType type) { return type < PlyType::kFloat; }

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {
    if (bytes_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;
    // Lines end as the first one does: a body may begin with any byte, line ends too.
    const size_t end = bytes_.find_first_of("\r\n", at_);
    const std::string_view two = bytes_.substr(std::min(end, bytes_.size()), 2);
    line_end_ = two == "\r\n" || two.substr(0, 1) == "\n" ? '\n' : '\r';
    reversed_ = two == "\n\r";
  }

  Result<PlyHeader> Read() {
    Next();  // "ply"
    while (Next()) {
      if (line_.text.size() > limits::kHeaderLineBytes) {
        return MakeError(ErrorCode::kLimit, "a header line longer than 64 KiB", At(1));
      }
      word_.clear();
      text::Words words(line_.text);
      for (text::Word word; word_.size() < 8 && words.Next(&word);) word_.push_back(word);
      if (word_.empty() || word_[0].text == "comment" || word_[0].text == "obj_info") continue;
      if (word_[0].text == "end_header") return End();
      if (auto ok = ReadLine(); !ok) return ok.error();
    }
    return Invalid("the header has no end_header; the file is cut short", {name_, line_.number, 0});
  }

 private:
  bool Next() {
    if (at_ >= bytes_.size()) return false;
    const size_t end = std::min(bytes_.find(line_end_, at_), bytes_.size());
    line_ = {bytes_.substr(at_, end - at_), line_.number + 1};
    if (line_.text.ends_with('\r')) line_.text.remove_suffix(1);
    at_ = std::min(end + 1, bytes_.size());
    if (reversed_ && at_ < bytes_.size() && bytes_[at_] == '\r') ++at_;
    return true;
  }

  Place At(int column) const { return {name_, line_.number, column}; }
  Error Fail(size_t word, std::string message) const {
    return Invalid(std::move(message), At(word < word_.size() ? word_[word].column : 1));
  }

  Result<PlyHeader> End() {
    if (!encoding_) return Fail(0, "the header has no line `format ... 1.0`");
    header_.bytes = at_;
    header_.lines = line_.number;
    return std::move(header_);
  }

  Result<> ReadLine() {
    const std::string_view first = word_[0].text;
    if (first == "format") return ReadFormat();
    if (first == "element") return ReadElement();
    if (first == "property") return ReadProperty();
    return Fail(0, text::Quoted(first) + " is no line of a .ply header");
  }

  Result<> ReadFormat() {
    const std::string_view kind = word_.size() > 1 ? word_[1].text : "";
    if (kind == "ascii") {
      header_.encoding = PlyEncoding::kAscii;
    } else if (kind == "binary_little_endian") {
      header_.encoding = PlyEncoding::kLittle;
    } else if (kind == "binary_big_endian") {
      header_.encoding = PlyEncoding::kBig;
    } else {
      return Fail(1, "format is ascii, binary_little_endian or binary_big_endian, not " +
                         text::Quoted(kind));
    }
    if (word_.size() != 3 || word_[2].text != "1.0") {
      return Fail(2, "only version 1.0 of .ply is known");
    }
    encoding_ = true;
    return Ok{};
  }

  Result<> ReadElement() {
    int64_t count = -1;
    if (word_.size() != 3 ||
        text::ParseInteger(word_[2].text, &count) != text::NumberFault::kNone || count < 0) {
      return Fail(2, "write `element NAME COUNT` with a count of 0 or more");
    }
    if (header_.elements.size() >= kMostElements) {
      return MakeError(ErrorCode::kLimit, "more than 64 elements", At(1));
    }
    header_.elements.push_back(
        {std::string(word_[1].text.substr(0, 64)), static_cast<uint64_t>(count), {}, line_.number});
    return Ok{};
  }

  Result<> ReadProperty() {
    if (header_.elements.empty()) return Fail(0, "a property before any element");
    std::vector<PlyProperty>& properties = header_.elements.back().properties;
    if (properties.size() >= kMostProperties) {
      return MakeError(ErrorCode::kLimit, "more than 256 properties", At(1));
    }
    PlyProperty property;
    property.list = word_.size() > 1 && word_[1].text == "list";
    const size_t type_at = property.list ? 3 : 1;
    if (word_.size() != type_at + 2) {
      return Fail(0, "write `property TYPE NAME` or `property list COUNT_TYPE TYPE NAME`");
    }
    const auto type = TypeOf(word_[type_at].text);
    if (!type) return Fail(type_at, text::Quoted(word_[type_at].text) + " is no type of .ply");
    property.type = *type;
    if (property.list) {
      const auto count = TypeOf(word_[2].text);
      if (!count || !IsInteger(*count)) {
        return Fail(
            2, "the count of a list is of a whole-number type, not " + text::Quoted(word_[2].text));
      }
      property.count = *count;
    }
    property.name = std::string(word_[type_at + 1].text.substr(0, 64));
    properties.push_back(std::move(property));
    return Ok{};
  }

  std::string_view bytes_;
  char line_end_ = '\n';   // with a \r before it or not
  bool reversed_ = false;  // \n\r
  size_t at_ = 0;
  const std::string& name_;
  text::Line line_;
  std::vector<text::Word> word_;
  bool encoding_ = false;
  PlyHeader header_;
};

}  // namespace

size_t PlyTypeBytes(PlyType type) {
  constexpr std::array<size_t, 8> kBytes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<size_t>(type)];
}

Result<PlyHeader> ReadPlyHeader(std::string_view bytes, const std::string& name) {
  return HeaderReader(bytes, name).Read();
}

}  // namespace fjord::formats
