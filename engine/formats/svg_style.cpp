#include "engine/formats/svg_style.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "engine/formats/limits.h"
#include "engine/formats/text.h"

namespace fjord::formats {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\f";
constexpr std::array<std::string_view, 14> kOfBoth = {"display",
                                                      "visibility",
                                                      "transform",
                                                      "transform-origin",
                                                      "transform-box",
                                                      "x",
                                                      "y",
                                                      "width",
                                                      "height",
                                                      "cx",
                                                      "cy",
                                                      "r",
                                                      "rx",
                                                      "ry"};
// Attributes of these names are none, or mean something else.
constexpr std::array<std::string_view, 6> kOfStyleAlone = {"translate", "rotate",      "scale",
                                                           "offset",    "offset-path", "d"};

// What shows whether something is seen at all.
constexpr std::array<std::string_view, 3> kPaint = {"fill", "stroke", "opacity"};

template <size_t n>
bool IsOneOf(std::string_view word, const std::array<std::string_view, n>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string_view Trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

std::string Small(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return small;
}

// The first of `ends` from `at` on that stands outside quotes and brackets; the end without one.
size_t FindOutside(std::string_view css, std::string_view ends, size_t at) {
  size_t depth = 0;
  char quote = '\0';
  for (; at < css.size(); ++at) {
    const char c = css[at];
    if (c == '\\') {
      ++at;
    } else if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (depth == 0 && ends.find(c) != ends.npos) {
      return at;
    } else if (c == '(' || c == '{') {
      ++depth;
    } else if ((c == ')' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return css.size();
}

struct Declaration {
  std::string property, value;
  bool important = false;
};

// Of those that hide, move or paint something.
std::vector<Declaration> DeclarationsOf(std::string_view block) {
  std::vector<Declaration> declarations;
  for (size_t at = 0; at < block.size();) {
    const size_t end = FindOutside(block, ";", at);
    const std::string_view one = block.substr(at, end - at);
    at = end + 1;
    const size_t colon = one.find(':');
    if (colon == one.npos) continue;
    Declaration declaration;
    declaration.property = Small(Trimmed(one.substr(0, colon)));
    if (!IsSvgGeometry(declaration.property) && !IsOneOf(declaration.property, kPaint)) continue;
    const std::string value = Small(one.substr(colon + 1));
    const size_t mark = value.find('!');
    declaration.important = mark != value.npos;
    declaration.value = Trimmed(std::string_view(value).substr(0, mark));
    declarations.push_back(std::move(declaration));
  }
  return declarations;
}

bool HasGeometry(const std::vector<Declaration>& declarations) {
  return std::any_of(declarations.begin(), declarations.end(),
                     [](const Declaration& one) { return IsSvgGeometry(one.property); });
}

std::string WithoutComments(std::string_view css) {
  std::string text;
  for (size_t at = 0; at < css.size();) {
    const size_t begin = std::min(css.find("/*", at), css.size());
    text.append(css.substr(at, begin - at)).push_back(' ');
    const size_t end = css.find("*/", begin);
    at = end == css.npos ? css.size() : end + 2;
  }
  return text;
}

bool IsNameChar(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '_' || static_cast<unsigned char>(c) >= 0x80;
}

// Of what no drawing at rest is: the rule never holds.
bool IsOfMoment(std::string_view selector) {
  for (const std::string_view state : {":hover", ":active", ":focus", ":visited"}) {
    if (selector.ends_with(state)) return true;
  }
  return false;
}

bool HasWord(std::string_view words, std::string_view word) {
  for (size_t at = words.find_first_not_of(kBlanks); at < words.size();
       at = words.find_first_not_of(kBlanks, at)) {
    const size_t end = std::min(words.find_first_of(kBlanks, at), words.size());
    if (words.substr(at, end - at) == word) return true;
    at = end;
  }
  return false;
}

}  // namespace

bool IsSvgGeometry(std::string_view property) {
  return IsOneOf(property, kOfBoth) || IsOneOf(property, kOfStyleAlone);
}

Result<> SvgStyle::AddSheet(const XmlElement& style) {
  const auto refuse = [&](const std::string& what) {
    return Invalid("a style sheet with " + what +
                       " that may hide or move something is not read; use style attributes instead",
                   document_.PlaceOf(style));
  };
  const std::string sheet = WithoutComments(document_.Text(style));
  const std::string_view css = sheet;
  for (size_t at = css.find_first_not_of(kBlanks); at < css.size();
       at = css.find_first_not_of(kBlanks, at)) {
    const size_t open = FindOutside(css, "{;", at);
    const std::string_view head = Trimmed(css.substr(at, open - at));
    if (open < css.size() && css[open] == ';') {
      if (head.rfind("@import", 0) == 0) return refuse("@import");
      at = open + 1;
      continue;
    }
    const size_t begin = std::min(open + 1, css.size());
    const size_t end = FindOutside(css, "}", begin);
    const std::string_view block = css.substr(begin, end - begin);
    at = std::min(end + 1, css.size());
    if (head.rfind('@', 0) != 0) {
      if (auto ok = AddRule(head, block, style); !ok) return ok;
      continue;
    }
    // Movements and fonts change nothing of a drawing at rest.
    const bool still = head.find("keyframes") != head.npos || head.rfind("@font-face", 0) == 0 ||
                       head.rfind("@page", 0) == 0;
    for (size_t inner = 0; !still && inner < block.size();) {
      const size_t from = FindOutside(block, "{", inner);
      const size_t to = FindOutside(block, "}", std::min(from + 1, block.size()));
      if (from < block.size() &&
          HasGeometry(DeclarationsOf(block.substr(from + 1, to - from - 1)))) {
        return refuse(std::string(head.substr(0, head.find_first_of(" ("))));
      }
      inner = to + 1;
    }
  }
  return Ok{};
}

Result<> SvgStyle::AddRule(std::string_view selectors, std::string_view block,
                           const XmlElement& style) {
  const std::vector<Declaration> declarations = DeclarationsOf(block);
  if (declarations.empty()) return Ok{};
  for (size_t at = 0; at < selectors.size();) {
    const size_t end = std::min(selectors.find(',', at), selectors.size());
    const std::string_view text = Trimmed(selectors.substr(at, end - at));
    at = end + 1;
    if (IsOfMoment(text)) continue;
    Selector selector;
    if (!ParseSelector(text, &selector)) {
      if (!HasGeometry(declarations)) continue;
      return Invalid("a style sheet that hides or moves what " + text::Quoted(text) +
                         " selects is not read; select by name, class or id, or use style "
                         "attributes",
                     document_.PlaceOf(style));
    }
    const std::string key = !selector.id.empty()        ? "#" + selector.id
                            : !selector.classes.empty() ? "." + selector.classes[0]
                            : !selector.name.empty()    ? selector.name
                                                        : "*";
    for (const Declaration& declaration : declarations) {
      if (++count_ > limits::kStyleRules) {
        return MakeError(ErrorCode::kLimit,
                         "style sheets with more than 10,000 rules that hide, move or paint",
                         document_.PlaceOf(style));
      }
      Selector own = selector;
      own.weight += count_;  // of two of a weight the later one wins
      rules_[key].push_back(
          {std::move(own), declaration.property, declaration.value, declaration.important});
    }
  }
  return Ok{};
}

// `name.class.class#id` or parts of that; `*` is any name.
bool SvgStyle::ParseSelector(std::string_view text, Selector* selector) {
  constexpr size_t kName = size_t{1} << 20, kClass = size_t{1} << 30, kId = size_t{1} << 40;
  for (size_t at = 0; at < text.size();) {
    const bool first = at == 0;
    const char kind = text[at] == '.' || text[at] == '#' ? text[at] : '\0';
    if (kind == '\0' && !first) return false;
    if (first && text[at] == '*') {
      ++at;
      continue;
    }
    if (kind != '\0') ++at;
    const size_t begin = at;
    while (at < text.size() && IsNameChar(text[at])) ++at;
    if (at == begin) return false;
    std::string name(text.substr(begin, at - begin));
    if (kind == '#' && !selector->id.empty() && selector->id != name) return false;
    if (kind == '.') selector->classes.push_back(name);
    (kind == '#' ? selector->id : kind == '.' ? selector->classes.back() : selector->name) = name;
    selector->weight += kind == '#' ? kId : kind == '.' ? kClass : kName;
  }
  return !text.empty();
}

bool SvgStyle::Matches(const Selector& selector, const XmlElement& element) const {
  if (!selector.name.empty() && selector.name != element.name) return false;
  if (!selector.id.empty() && selector.id != document_.Attribute(element, "id")) return false;
  const std::string_view classes = document_.Attribute(element, "class");
  return std::all_of(selector.classes.begin(), selector.classes.end(),
                     [&](const std::string& one) { return HasWord(classes, one); });
}

void SvgStyle::Collect(const XmlElement& element) const {
  last_ = &element;
  said_.clear();
  std::vector<const Rule*> rules;
  const auto look = [&](const std::string& key) {
    const auto at = rules_.find(key);
    if (at == rules_.end()) return;
    looks_ += at->second.size();
    for (const Rule& rule : at->second) {
      if (Matches(rule.selector, element)) rules.push_back(&rule);
    }
  };
  if (count_ > 0) {
    look("*");
    look(std::string(element.name));
    look("#" + std::string(document_.Attribute(element, "id")));
    std::set<std::string, std::less<>> classes;
    const std::string_view words = document_.Attribute(element, "class");
    for (size_t at = words.find_first_not_of(kBlanks); at < words.size();
         at = words.find_first_not_of(kBlanks, at)) {
      const size_t end = std::min(words.find_first_of(kBlanks, at), words.size());
      classes.emplace(words.substr(at, end - at));
      at = end;
    }
    for (const std::string& name : classes) look("." + name);
  }
  std::sort(rules.begin(), rules.end(),
            [](const Rule* a, const Rule* b) { return a->selector.weight < b->selector.weight; });
  for (const Rule* rule : rules) said_.push_back({rule->property, rule->value, rule->important});
  const std::string_view style = document_.Attribute(element, "style");
  if (style.empty()) return;
  for (Declaration& one : DeclarationsOf(WithoutComments(style))) {
    said_.push_back({std::move(one.property), std::move(one.value), one.important});
  }
}

SvgProperty SvgStyle::Find(const XmlElement& element, std::string_view property) const {
  SvgProperty found;
  if (!IsOneOf(property, kOfStyleAlone)) {
    const std::string_view whole = document_.Attribute(element, property);
    const std::string_view value = Trimmed(whole);
    found.value = Small(value);
    found.attribute = found.given();
    if (found.attribute) found.offset = static_cast<size_t>(value.data() - whole.data());
  }
  if (!IsStyled(element)) return found;
  if (last_ != &element) Collect(element);
  bool important = false;
  for (const Said& said : said_) {
    if (said.property != property || (important && !said.important)) continue;
    found = {said.value, false, 0};
    important = said.important;
  }
  return found;
}

}  // namespace fjord::formats
