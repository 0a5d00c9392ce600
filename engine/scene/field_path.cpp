#include "engine/scene/field_path.h"

#include "engine/base/printable.h"
#include "engine/scene/limits.h"

namespace fjord {
namespace {

bool IsNameLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-';
}

}  // namespace

bool IsSceneName(std::string_view name) {
  if (name.empty() || name.size() > limits::kNameBytes) return false;
  for (const char c : name) {
    if (!IsNameLetter(c)) return false;
  }
  return true;
}

bool IsPictureStem(std::string_view name) {
  return !name.empty() && name.size() <= limits::kNameBytes && name.front() != '.' &&
         name.find('/') == std::string_view::npos && IsPrintable(name);
}

Result<FieldPath> ParseFieldPath(std::string_view text) {
  const auto wrong = [&](size_t at, const std::string& what) {
    return Invalid("\"" + std::string(text) + "\" is not a path: " + what + " at character " +
                   std::to_string(at + 1) + " (a path is like objects[coast].fractal.H)");
  };
  if (text.size() > 10u * limits::kNameBytes) return Invalid("a path is too long");
  FieldPath path;
  size_t at = 0;
  const auto word = [&] {
    const size_t start = at;
    while (at < text.size() && IsNameLetter(text[at])) ++at;
    return std::string(text.substr(start, at - start));
  };
  while (true) {
    PathPiece piece{word(), ""};
    if (piece.field.empty()) return wrong(at, "a field name is missing");
    if (at < text.size() && text[at] == '[') {
      ++at;
      piece.selector = word();
      if (piece.selector.empty()) return wrong(at, "a name or number is missing");
      if (at >= text.size() || text[at] != ']') return wrong(at, "] is missing");
      ++at;
    }
    path.pieces.push_back(std::move(piece));
    if (at == text.size()) return path;
    if (text[at] != '.') return wrong(at, "a . is missing");
    ++at;
  }
}

std::string PrintFieldPath(const FieldPath& path) {
  std::string text;
  for (const PathPiece& piece : path.pieces) {
    if (!text.empty()) text += '.';
    text += piece.field;
    if (!piece.selector.empty()) text += '[' + piece.selector + ']';
  }
  return text;
}

}  // namespace fjord
