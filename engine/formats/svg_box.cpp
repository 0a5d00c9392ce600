#include "engine/formats/svg_box.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "engine/formats/text.h"

namespace fjord::formats {
namespace {

struct Word {
  std::string text;  // in small letters
  size_t offset = 0;
};

std::vector<Word> WordsOf(std::string_view text) {
  std::vector<Word> words;
  bool inside = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool blank = c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == ',';
    if (!blank && !inside) words.push_back({"", i});
    if (!blank) words.back().text += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    inside = !blank;
  }
  return words;
}

// A word that names a side, of x (0), y (1) or either (2).
struct Side {
  std::string_view name;
  int axis;
  std::string_view length;
};

const Side* SideOf(std::string_view word) {
  static constexpr std::array<Side, 5> kSides = {{{"left", 0, "0"},
                                                  {"right", 0, "100%"},
                                                  {"top", 1, "0"},
                                                  {"bottom", 1, "100%"},
                                                  {"center", 2, "50%"}}};
  const auto* const found = std::find_if(kSides.begin(), kSides.end(),
                                         [&](const Side& side) { return side.name == word; });
  return found == kSides.end() ? nullptr : found;
}

// The share of what is left over that lies before the box: min, mid or max.
bool Share(std::string_view word, double* share) {
  constexpr std::array<std::pair<std::string_view, double>, 3> kShares = {
      {{"min", 0}, {"mid", .5}, {"max", 1}}};
  for (const auto& [name, value] : kShares) {
    if (name == word) *share = value;
    if (name == word) return true;
  }
  return false;
}

}  // namespace

SvgFault ParseViewBox(std::string_view text, SvgViewBox* box) {
  SvgScan scan(text);
  for (double* value : {&box->low.x, &box->low.y, &box->size.x, &box->size.y}) {
    if (!scan.ReadNumber(value)) return scan.fault();
  }
  scan.SkipSpace();
  if (!scan.AtEnd()) return scan.Fault("a viewBox has four numbers");
  return box->size.x >= 0 && box->size.y >= 0 ? SvgFault()
                                              : scan.Fault("a viewBox of a negative size");
}

SvgFault FitViewBox(const SvgViewBox& box, const Vec2& size, std::string_view aspect,
                    SvgMatrix* matrix) {
  std::vector<Word> words = WordsOf(aspect);
  if (!words.empty() && words[0].text == "defer") words.erase(words.begin());
  Vec2 scale(size.x / box.size.x, size.y / box.size.y), share(.5);
  if (words.empty() || words[0].text != "none") {
    const std::string align = words.empty() ? "xmidymid" : words[0].text;
    const bool slice = words.size() > 1 && words[1].text == "slice";
    const bool good = align.size() == 8 && align[0] == 'x' && align[4] == 'y' &&
                      Share(std::string_view(align).substr(1, 3), &share.x) &&
                      Share(std::string_view(align).substr(5, 3), &share.y);
    if (!good || words.size() > 2 || (words.size() == 2 && !slice && words[1].text != "meet")) {
      return {words[0].offset,
              "preserveAspectRatio is none, or xMidYMid and the like, then meet or slice"};
    }
    scale = Vec2(slice ? std::max(scale.x, scale.y) : std::min(scale.x, scale.y));
  }
  const Vec2 left = size - box.size * scale;
  *matrix = {scale.x,
             0,
             0,
             scale.y,
             left.x * share.x - box.low.x * scale.x,
             left.y * share.y - box.low.y * scale.y};
  return {};
}

SvgFault ParseOrigin(std::string_view text, const SvgViewport& view, Vec2* origin) {
  std::vector<Word> words = WordsOf(text);
  const SvgFault wrong = {
      0, "an origin is two lengths, or words of left, right, top, bottom and center"};
  if (words.empty() || words.size() > 3) return wrong;
  if (words.size() == 1) words.push_back({"center", words[0].offset});
  const Side* first = SideOf(words[0].text);
  const Side* second = SideOf(words[1].text);
  const bool one = first != nullptr && first->axis == 1;
  if (one && second == nullptr) return wrong;
  if (one || (first != nullptr && second != nullptr && second->axis == 0)) {
    std::swap(words[0], words[1]);
    std::swap(first, second);
  }
  if ((first != nullptr && first->axis == 1) || (second != nullptr && second->axis == 0)) {
    return wrong;
  }
  for (int k = 0; k < 2; ++k) {
    const Side* side = k == 0 ? first : second;
    const Word& word = words[static_cast<size_t>(k)];
    double value = 0;
    if (side == nullptr && word.text.find_first_of("0123456789") == std::string::npos) {
      return {word.offset, wrong.message};
    }
    const SvgFault fault = ParseLength(side == nullptr ? word.text : side->length, view,
                                       k == 0 ? SvgAxis::kX : SvgAxis::kY, &value);
    if (!fault.ok()) return {word.offset + (side == nullptr ? fault.offset : 0), fault.message};
    (*origin)[k] = value;
  }
  return {};
}

}  // namespace fjord::formats
