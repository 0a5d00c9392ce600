// Text that came from elsewhere, made fit for a terminal: what would move the cursor, change
// colours or turn the direction of reading is written out as \u001b. Letters of every script stay.
#pragma once

#include <string>
#include <string_view>

namespace fjord {

// In one line: tabs and line ends are written out, too.
std::string Printable(std::string_view text);
// Tabs and line ends stay. Inside a JSON string the result means the same as before.
std::string PrintableLines(std::string_view text);
// Printable(text) == text.
bool IsPrintable(std::string_view text);

// Columns of a terminal that a printable text takes, near enough: its characters.
size_t CharactersIn(std::string_view text);
// The first characters of it, whole.
std::string FirstCharacters(std::string_view text, size_t most);

}  // namespace fjord
