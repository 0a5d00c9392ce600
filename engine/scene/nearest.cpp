#include "engine/scene/nearest.h"

#include <algorithm>
#include <vector>

namespace fjord {
namespace {

constexpr size_t kLongestWord = 64;

char Lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Letters to insert, drop, replace or swap with the next to make a of b, capitals aside.
size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    before.swap(last);
    last.swap(row);
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const char x = Lower(a[i - 1]), y = Lower(b[j - 1]);
      row[j] = std::min({last[j - 1] + (x == y ? 0 : 1), last[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && x == Lower(b[j - 2]) && y == Lower(a[i - 2]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::string SuggestNames(std::string_view word, std::span<const std::string> names, size_t most) {
  std::vector<std::pair<size_t, std::string>> near;
  for (const std::string& name : names) {
    const bool seen = std::any_of(near.begin(), near.end(),
                                  [&](const auto& entry) { return entry.second == name; });
    if (seen || name.size() > kLongestWord || word.size() > kLongestWord) continue;
    const size_t distance = EditDistance(word, name);
    if (distance <= std::max<size_t>(1, std::max(word.size(), name.size()) / 3)) {
      near.emplace_back(distance, name);
    }
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string text;
  if (!near.empty()) {
    for (size_t i = 0; i < std::min<size_t>(2, near.size()); ++i) {
      text += (i == 0 ? "; did you mean " : " or ") + near[i].second;
    }
    return text + "?";
  }
  for (size_t i = 0; i < names.size() && i < most; ++i) {
    text += (i == 0 ? "; there are " : ", ") + names[i];
  }
  return names.size() > most ? text + ", ..." : text;
}

}  // namespace fjord
