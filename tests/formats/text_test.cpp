#include "engine/formats/text.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstring>

namespace fjord::text {
namespace {

TEST(TextTest, LinesOfEveryKind) {
  LineReader lines(
      "\xEF\xBB\xBF"
      "a\nb\r\nc\rd\n\ne");
  std::vector<std::string> read;
  Line line;
  while (lines.Next(&line)) {
    read.emplace_back(line.text);
    EXPECT_EQ(line.number, static_cast<int>(read.size()));
  }
  EXPECT_EQ(read, (std::vector<std::string>{"a", "b", "c", "d", "", "e"}));
}

TEST(TextTest, WordsKnowTheirColumn) {
  Words words("  one\ttwo ");
  Word word;
  ASSERT_TRUE(words.Next(&word));
  EXPECT_EQ(word.column, 3);
  ASSERT_TRUE(words.Next(&word));
  EXPECT_EQ(word.text, "two");
  EXPECT_EQ(word.column, 7);
  EXPECT_FALSE(words.Next(&word));
}

TEST(TextTest, NumbersAndWhatIsNone) {
  double value = 0;
  for (const char* good : {"1", "-1.5", "+2", ".5", "5.", "1e3", "-1E-3", "0", "-0", "1e-400"}) {
    EXPECT_EQ(ParseNumber(good, &value), NumberFault::kNone) << good;
  }
  EXPECT_EQ(value, 0);
  for (const char* bad : {"", "x", "1,5", "1.2.3", "0x10", "--1", "+-1", "1e", "1f", "-"}) {
    EXPECT_EQ(ParseNumber(bad, &value), NumberFault::kNotANumber) << bad;
  }
  for (const char* bad : {"nan", "NaN", "-nan", "inf", "-Infinity", "+inf", "nan(7)"}) {
    EXPECT_EQ(ParseNumber(bad, &value), NumberFault::kNotFinite) << bad;
  }
  for (const char* bad : {"1e308", "-1e16", "1e999"}) {
    EXPECT_EQ(ParseNumber(bad, &value), NumberFault::kTooLarge) << bad;
  }
  EXPECT_EQ(ParseNumber(std::string(400, '9'), &value), NumberFault::kTooLarge);
  int64_t whole = 0;
  EXPECT_EQ(ParseInteger("1.0", &whole), NumberFault::kNotANumber);
  EXPECT_EQ(ParseInteger("99999999999999999999", &whole), NumberFault::kTooLarge);
}

RC_GTEST_PROP(TextTest, PrintedNumbersReadBackExactly, (uint64_t bits)) {
  double value = 0;
  std::memcpy(&value, &bits, sizeof(value));
  RC_PRE(value >= -1e15 && value <= 1e15);
  std::string text;
  Append(value, &text);
  double back = 1;
  RC_ASSERT(ParseNumber(text, &back) == NumberFault::kNone);
  RC_ASSERT(std::memcmp(&back, &value, sizeof(value)) == 0);
}

TEST(TextTest, QuotedWordsAreShortAndPrintable) {
  EXPECT_EQ(Quoted("ab\x01"), "'ab?'");
  EXPECT_EQ(Quoted(std::string(100, 'x')).size(), 45u);
}

TEST(TextTest, CommentsStayOnOneLine) { EXPECT_EQ(OneLine("a\nb\tc\x02"), "a b c"); }

}  // namespace
}  // namespace fjord::text
