// Just enough XML for .svg: tags and their attributes in order, as views into the caller's bytes.
// Comments, declarations, CDATA and text between tags are passed over; entities are left as they
// are.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace fjord::formats {

struct XmlAttribute {
  std::string_view name;
  std::string_view value;  // its first byte lies at value.data() in the caller's bytes
};

struct XmlTag {
  std::string_view name;  // without a namespace prefix
  bool opens = false;     // <g ...> and <g ... />
  bool closes = false;    // </g> and <g ... />
  size_t offset = 0;
  std::vector<XmlAttribute> attributes;

  // Empty where there is none.
  std::string_view Find(std::string_view attribute) const;
};

class XmlScan {
 public:
  explicit XmlScan(std::string_view bytes) : bytes_(bytes) {}

  // False at the end and at a fault.
  bool Next(XmlTag* tag);
  const std::string& fault() const { return fault_; }  // empty: none
  size_t fault_offset() const { return fault_offset_; }

 private:
  bool Fail(size_t offset, const char* message);
  bool SkipPast(std::string_view end, const char* what);
  bool SkipDeclaration();
  bool ReadTag(XmlTag* tag);
  void SkipSpace();
  std::string_view ReadName();

  std::string_view bytes_;
  size_t at_ = 0;
  std::string fault_;
  size_t fault_offset_ = 0;
};

}  // namespace fjord::formats
