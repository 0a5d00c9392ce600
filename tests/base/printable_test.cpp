#include "engine/base/printable.h"

#include <gtest/gtest.h>

namespace fjord {
namespace {

TEST(PrintableTest, LettersOfEveryScriptStay) {
  for (const char* text :
       {"", "fly-in_2", "\u5c71", "\u00e9t\u00e9", "\u0441\u043d\u0435\u0433",
        "\u0645\u06cc\u200c\u0634\u0648\u062f", "\U0001f3d4", "a b", "\u0915\u094d\u200d\u0937"}) {
    EXPECT_EQ(Printable(text), text);
    EXPECT_TRUE(IsPrintable(text)) << text;
  }
}

TEST(PrintableTest, WhatMovesATerminalIsWrittenOut) {
  const std::pair<std::string, std::string> cases[] = {
      {"\033[31mred", "\\u001b[31mred"},
      {"\033]0;title\a", "\\u001b]0;title\\u0007"},
      {"a\rb\nc\td", "a\\u000db\\u000ac\\u0009d"},
      {"\u009b2J", "\\u009b2J"},  // CSI in one character
      {"\x7f", "\\u007f"},
      {std::string("a\0b", 3), "a\\u0000b"},
      {"\u202egnp.exe", "\\u202egnp.exe"},
      {"\u2066\u200f\u2028\ufeff", "\\u2066\\u200f\\u2028\\ufeff"},
      {"\U000e0001", "\\udb40\\udc01"},
      {"\x9b"
       "2J",
       "\\x9b2J"},  // a byte of an older code
      {"\xc3", "\\xc3"},
      {"\xed\xa0\x80", "\\xed\\xa0\\x80"},  // half a surrogate pair
      {"\xc0\xaf", "\\xc0\\xaf"},           // too long a form of /
      {"\xf8\x88\x80\x80\x80", "\\xf8\\x88\\x80\\x80\\x80"},
  };
  for (const auto& [text, clean] : cases) {
    EXPECT_EQ(Printable(text), clean);
    EXPECT_FALSE(IsPrintable(text)) << clean;
    EXPECT_TRUE(IsPrintable(clean)) << clean;
  }
}

TEST(PrintableTest, LinesStayLines) {
  EXPECT_EQ(PrintableLines("a\n\tb\033[2J\n"), "a\n\tb\\u001b[2J\n");
}

TEST(PrintableTest, CutsBetweenCharacters) {
  EXPECT_EQ(CharactersIn("\u5c71\u6d77!"), 3u);
  EXPECT_EQ(FirstCharacters("\u5c71\u6d77!", 2), "\u5c71\u6d77");
  EXPECT_EQ(FirstCharacters("ab", 7), "ab");
}

}  // namespace
}  // namespace fjord
