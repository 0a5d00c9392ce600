// An XML file as plain values: its elements in document order with their attributes, read by Expat.
// Entities that the file declares are put in, within Expat's bounds of growth; nothing outside the
// file is ever fetched. UTF-8, UTF-16 and, by declaration, every encoding whose bytes below 128 are
// ASCII. Owns all its text but the caller's bytes and name, which must outlive it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace fjord::formats {

struct XmlElement {
  std::string_view name;   // without a prefix
  std::string_view space;  // the name of its namespace; empty where none is declared
  size_t end = 0;          // the element after the last one inside this one
  size_t attributes = 0, attribute_count = 0;
  size_t offset = 0, bytes = 0;  // of the start tag in the file
};

class XmlDocument {
 public:
  // kInvalid with its place for a file that is not well-formed, kLimit beyond the bounds of
  // limits.h. The text of elements named `text_of` is kept, all other text is passed over.
  static Result<XmlDocument> Read(std::string_view bytes, const std::string& name,
                                  std::string_view text_of);

  const std::vector<XmlElement>& elements() const { return elements_; }  // [0] is the outer one
  // Of attributes without a namespace, and "xlink:href"; empty where there is none.
  std::string_view Attribute(const XmlElement& element, std::string_view attribute) const;
  std::string_view Text(const XmlElement& element) const;

  Place PlaceOf(const XmlElement& element) const { return At(element.offset); }
  // Of the character at `offset` of an attribute's value; of the element where the value is not
  // written out in its tag.
  Place PlaceIn(const XmlElement& element, std::string_view attribute, size_t offset) const;

 private:
  friend class XmlLoader;
  struct Attributed {
    std::string_view name;
    size_t begin, size;  // in text_
  };

  XmlDocument(std::string_view bytes, const std::string& name);
  Place At(size_t offset) const;
  // Code units from `begin` on, those beyond ASCII as '?'.
  std::string Ascii(size_t begin, size_t bytes) const;

  std::string_view bytes_;
  const std::string* name_;
  size_t unit_ = 1;         // bytes
  bool high_first_ = true;  // of units of two bytes
  std::set<std::string, std::less<>> names_;
  std::vector<XmlElement> elements_;
  std::vector<Attributed> attributes_;
  std::string text_;
  std::map<size_t, std::string> texts_;  // by element
};

// The bytes start as XML in two-byte units does.
bool LooksLikeWideXml(std::string_view bytes);

}  // namespace fjord::formats
