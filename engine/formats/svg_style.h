// What an element of an .svg file is said to be: by its attributes, by style sheets of the file,
// and by its `style` attribute, of which the later ones win. Of the properties only those are kept
// that hide, move or paint something.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/xml_document.h"

namespace fjord::formats {

struct SvgProperty {
  std::string value;       // trimmed, without `!important`, in small letters; empty: not given
  bool attribute = false;  // of the attribute of the property's name, from its `offset` on
  size_t offset = 0;

  bool given() const { return !value.empty(); }
};

// Refers to the document.
class SvgStyle {
 public:
  explicit SvgStyle(const XmlDocument& document) : document_(document) {}
  const XmlDocument& document() const { return document_; }

  // Takes in the sheet of a <style> element. Selectors of a name, classes and an id, as
  // `path.thin`, and lists of these are known; where others hide or move something the sheet is
  // refused, where they paint they are passed over.
  Result<> AddSheet(const XmlElement& style);

  // Something beside attributes may say what the element is.
  bool IsStyled(const XmlElement& element) const {
    return count_ > 0 || !document_.Attribute(element, "style").empty();
  }
  // Attributes count for properties that have one of their name.
  SvgProperty Find(const XmlElement& element, std::string_view property) const;

  // How often a rule has been held against an element: the work done.
  size_t looks() const { return looks_; }

 private:
  struct Selector {
    std::string name, id;
    std::vector<std::string> classes;
    size_t weight = 0;
  };
  struct Rule {
    Selector selector;
    std::string property, value;
    bool important = false;
  };

  Result<> AddRule(std::string_view selectors, std::string_view block, const XmlElement& style);
  static bool ParseSelector(std::string_view text, Selector* selector);
  bool Matches(const Selector& selector, const XmlElement& element) const;
  void Collect(const XmlElement& element) const;  // into said_

  const XmlDocument& document_;
  // By what is most particular in their selectors: "#id", ".class", a name or "*".
  std::map<std::string, std::vector<Rule>, std::less<>> rules_;
  size_t count_ = 0;

  // What sheets and the style attribute say of the element that was asked about last, in the order
  // in which the later one wins.
  struct Said {
    std::string property, value;
    bool important = false;
  };
  mutable const XmlElement* last_ = nullptr;
  mutable std::vector<Said> said_;
  mutable size_t looks_ = 0;
};

// The property would hide or move something.
bool IsSvgGeometry(std::string_view property);

}  // namespace fjord::formats
