#include "engine/formats/xml_scan.h"

namespace fjord::formats {
namespace {

constexpr size_t kMostAttributes = 1000;

bool IsSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool EndsName(char c) {
  return IsSpace(c) || c == '=' || c == '>' || c == '/' || c == '<' || c == '"' || c == '\'';
}

}  // namespace

std::string_view XmlTag::Find(std::string_view attribute) const {
  for (const XmlAttribute& a : attributes) {
    if (a.name == attribute) return a.value;
  }
  return {};
}

bool XmlScan::Fail(size_t offset, const char* message) {
  fault_ = message;
  fault_offset_ = offset;
  at_ = bytes_.size();
  return false;
}

bool XmlScan::SkipPast(std::string_view end, const char* what) {
  const size_t found = bytes_.find(end, at_);
  if (found == bytes_.npos) return Fail(at_, what);
  at_ = found + end.size();
  return true;
}

// <!DOCTYPE ... [ ... ]>: brackets may hold further declarations.
bool XmlScan::SkipDeclaration() {
  const size_t begin = at_;
  int depth = 0;
  for (; at_ < bytes_.size(); ++at_) {
    if (bytes_[at_] == '[') ++depth;
    if (bytes_[at_] == ']') --depth;
    if (bytes_[at_] == '>' && depth <= 0) {
      ++at_;
      return true;
    }
  }
  return Fail(begin, "a declaration <! without its end; the file is cut short");
}

bool XmlScan::Next(XmlTag* tag) {
  while (fault_.empty()) {
    const size_t open = bytes_.find('<', at_);
    if (open == bytes_.npos) return false;
    at_ = open;
    const std::string_view rest = bytes_.substr(open, 9);
    bool ok = true;
    if (rest.substr(0, 4) == "<!--") {
      at_ += 4;
      ok = SkipPast("-->", "a comment <!-- without its end; the file is cut short");
    } else if (rest == "<![CDATA[") {
      ok = SkipPast("]]>", "a <![CDATA[ without its end; the file is cut short");
    } else if (rest.substr(0, 2) == "<?") {
      ok = SkipPast("?>", "a <? without its end; the file is cut short");
    } else if (rest.substr(0, 2) == "<!") {
      ok = SkipDeclaration();
    } else {
      return ReadTag(tag);
    }
    if (!ok) return false;
  }
  return false;
}

void XmlScan::SkipSpace() {
  while (at_ < bytes_.size() && IsSpace(bytes_[at_])) ++at_;
}

std::string_view XmlScan::ReadName() {
  const size_t begin = at_;
  while (at_ < bytes_.size() && !EndsName(bytes_[at_])) ++at_;
  return bytes_.substr(begin, at_ - begin);
}

bool XmlScan::ReadTag(XmlTag* tag) {
  const size_t begin = at_++;
  *tag = {};
  tag->offset = begin;
  tag->opens = true;
  if (at_ < bytes_.size() && bytes_[at_] == '/') {
    ++at_;
    tag->opens = false;
    tag->closes = true;
  }
  tag->name = ReadName();
  if (tag->name.empty()) return Fail(begin, "'<' without the name of an element");
  if (const size_t colon = tag->name.rfind(':'); colon != tag->name.npos) {
    tag->name.remove_prefix(colon + 1);
  }
  while (true) {
    SkipSpace();
    if (at_ >= bytes_.size())
      return Fail(begin, "an element without its '>'; the file is cut short");
    if (bytes_[at_] == '>') {
      ++at_;
      return true;
    }
    if (bytes_[at_] == '/') {
      ++at_;
      tag->closes = true;
      continue;
    }
    const size_t start = at_;
    const std::string_view name = ReadName();
    SkipSpace();
    if (name.empty() || at_ >= bytes_.size() || bytes_[at_] != '=') {
      return Fail(start, "an attribute is written as name=\"value\"");
    }
    ++at_;
    SkipSpace();
    const char quote = at_ < bytes_.size() ? bytes_[at_] : '\0';
    if (quote != '"' && quote != '\'') return Fail(start, "the value of an attribute needs quotes");
    const size_t end = bytes_.find(quote, at_ + 1);
    if (end == bytes_.npos) return Fail(start, "an attribute without its closing quote");
    if (tag->attributes.size() >= kMostAttributes) return Fail(start, "more than 1000 attributes");
    tag->attributes.push_back({name, bytes_.substr(at_ + 1, end - at_ - 1)});
    at_ = end + 1;
  }
}

}  // namespace fjord::formats
