// Suggestions for misspelt names.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace fjord {

// "; did you mean a or b?": the names within a few letters of `word`, nearest first. Where none is
// near: "; there are a, b, c" (at most `most`), or nothing for an empty list.
std::string SuggestNames(std::string_view word, std::span<const std::string> names,
                         size_t most = 8);

}  // namespace fjord
