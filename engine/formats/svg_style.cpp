#include "engine/formats/svg_style.h"

#include <algorithm>

namespace fjord::formats {
namespace {

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n\f";
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

std::string Small(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return small;
}

// True, and `value` set, where the declarations of `style`, in small letters, name the property.
bool FindDeclared(std::string_view style, std::string_view property, std::string_view* value) {
  bool found = false;
  for (size_t at = 0; at < style.size();) {
    const size_t end = std::min(style.find(';', at), style.size());
    const std::string_view declaration = style.substr(at, end - at);
    const size_t colon = declaration.find(':');
    if (colon != declaration.npos && Trimmed(declaration.substr(0, colon)) == property) {
      const std::string_view given = declaration.substr(colon + 1);
      *value = Trimmed(given.substr(0, given.find('!')));
      found = true;
    }
    at = end + 1;
  }
  return found;
}

}  // namespace

std::string StyleValue(const XmlTag& tag, std::string_view property) {
  const std::string style = Small(tag.Find("style"));
  std::string_view declared;
  if (FindDeclared(style, property, &declared)) return std::string(declared);
  return Small(Trimmed(tag.Find(property)));
}

bool StyleDeclares(const XmlTag& tag, std::string_view property) {
  std::string_view declared;
  const std::string style = Small(tag.Find("style"));
  return FindDeclared(style, property, &declared);
}

}  // namespace fjord::formats
