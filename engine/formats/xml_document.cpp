#include "engine/formats/xml_document.h"

#include <algorithm>

#include "engine/formats/text.h"

namespace fjord::formats {
namespace {

bool IsSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// Where in a start tag the value of an attribute begins; npos where it is not found.
size_t FindValue(std::string_view tag, std::string_view attribute) {
  size_t at = std::min(tag.find_first_of(" \t\r\n"), tag.size());
  while (at < tag.size()) {
    while (at < tag.size() && IsSpace(tag[at])) ++at;
    const size_t equals = tag.find('=', at);
    if (equals == tag.npos) break;
    const size_t quote = tag.find_first_of("\"'", equals);
    if (quote == tag.npos) break;
    std::string_view name = tag.substr(at, equals - at);
    while (!name.empty() && IsSpace(name.back())) name.remove_suffix(1);
    if (name == attribute) return quote + 1;
    at = std::min(tag.find(tag[quote], quote + 1), tag.size() - 1) + 1;
  }
  return tag.npos;
}

}  // namespace

bool LooksLikeWideXml(std::string_view bytes) {
  using namespace std::string_view_literals;
  if (bytes.size() % 2 != 0) return false;
  const std::string_view mark = bytes.substr(0, 2);
  const bool high_first = mark == "\xFE\xFF"sv || mark.substr(0, 1) == "\0"sv;
  size_t at = mark == "\xFE\xFF"sv || mark == "\xFF\xFE"sv ? 2 : 0;
  for (; at + 1 < bytes.size(); at += 2) {
    const char high = bytes[high_first ? at : at + 1], low = bytes[high_first ? at + 1 : at];
    if (high != 0 || !IsSpace(low)) return high == 0 && low == '<';
  }
  return false;
}

XmlDocument::XmlDocument(std::string_view bytes, const std::string& name)
    : bytes_(bytes), name_(&name) {
  if (!LooksLikeWideXml(bytes)) return;
  unit_ = 2;
  high_first_ = bytes[0] == '\xFE' || bytes[0] == '\0';
}

std::string_view XmlDocument::Attribute(const XmlElement& element,
                                        std::string_view attribute) const {
  for (size_t i = element.attributes; i < element.attributes + element.attribute_count; ++i) {
    if (attributes_[i].name != attribute) continue;
    return std::string_view(text_).substr(attributes_[i].begin, attributes_[i].size);
  }
  return {};
}

std::string_view XmlDocument::Text(const XmlElement& element) const {
  const auto found = texts_.find(static_cast<size_t>(&element - elements_.data()));
  return found == texts_.end() ? std::string_view() : found->second;
}

std::string XmlDocument::Ascii(size_t begin, size_t bytes) const {
  begin = std::min(begin, bytes_.size());
  const std::string_view raw = bytes_.substr(begin, bytes);
  if (unit_ == 1) return std::string(raw);
  std::string units;
  for (size_t i = 0; i + 1 < raw.size(); i += 2) {
    const char high = raw[high_first_ ? i : i + 1], low = raw[high_first_ ? i + 1 : i];
    units += high == 0 && static_cast<unsigned char>(low) < 0x80 ? low : '?';
  }
  return units;
}

Place XmlDocument::At(size_t offset) const {
  const std::string before = Ascii(0, offset);
  int line = 1;
  size_t start = 0;
  for (size_t i = 0; i < before.size(); ++i) {
    const bool pair = before[i] == '\r' && i + 1 < before.size() && before[i + 1] == '\n';
    if (pair || (before[i] != '\n' && before[i] != '\r')) continue;
    ++line;
    start = i + 1;
  }
  return {*name_, line, static_cast<int>(before.size() - start) + 1};
}

Place XmlDocument::PlaceIn(const XmlElement& element, std::string_view attribute,
                           size_t offset) const {
  const std::string tag = Ascii(element.offset, element.bytes);
  size_t at = FindValue(tag, attribute);
  if (at == tag.npos) return PlaceOf(element);
  // A reference stands for a character at least; in a value with references the place of the last
  // one before is good enough.
  const size_t begin = at;
  size_t value = 0;
  while (value < offset && at < tag.size()) {
    if (tag[at] == '&') {
      const size_t end = tag.find(';', at);
      const bool character = tag.compare(at, 2, "&#") == 0;
      if (end == tag.npos || !character) return At(element.offset + at * unit_);
      at = end + 1;
    } else {
      at += tag.compare(at, 2, "\r\n") == 0 ? 2 : 1;
    }
    ++value;
  }
  return At(element.offset + std::max(at, begin) * unit_);
}

}  // namespace fjord::formats
