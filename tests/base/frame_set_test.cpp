#include "engine/base/frame_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fjord {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<uint32_t> Numbers(const FrameSet& set) {
  std::vector<uint32_t> numbers;
  for (uint32_t i = 0; i < set.size(); ++i) numbers.push_back(set[i]);
  return numbers;
}

std::vector<uint32_t> Numbers(const std::string& text) {
  const Result<FrameSet> set = FrameSet::Parse(text);
  EXPECT_TRUE(set.ok()) << set.error().message;
  return Numbers(*set);
}

TEST(FrameSetTest, TakesListsRangesAndSteps) {
  EXPECT_THAT(Numbers("7"), ElementsAre(7));
  EXPECT_THAT(Numbers("1-10,12"), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12));
  EXPECT_THAT(Numbers("1-11x2"), ElementsAre(1, 3, 5, 7, 9, 11));
  EXPECT_THAT(Numbers("1-10x4"), ElementsAre(1, 5, 9));
  EXPECT_THAT(Numbers("1-3, 5, 8-10"), ElementsAre(1, 2, 3, 5, 8, 9, 10));
  EXPECT_THAT(Numbers("8-8x3,1-2x9"), ElementsAre(1, 8));
}

TEST(FrameSetTest, WhatIsNamedTwiceIsThereOnceInRisingOrder) {
  EXPECT_THAT(Numbers("5,3-6,4,1"), ElementsAre(1, 3, 4, 5, 6));
  EXPECT_THAT(Numbers("1-9x2,1-9x3"), ElementsAre(1, 3, 4, 5, 7, 9));
  EXPECT_EQ(FrameSet::Parse("1-10x2,2-10x2")->ToString(), "1-10");
  EXPECT_EQ(*FrameSet::Parse("3,1,2"), FrameSet(1, 3));
}

TEST(FrameSetTest, AMistakeIsNamedWithItsPlace) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"", "character 1: a frame is missing"},
      {"1-10,", "character 6: a frame is missing"},
      {"1,,3", "character 3: a frame is missing"},
      {"1-10,12-", "character 9: the last frame is missing in \"12-\""},
      {"-3", "character 1: a frame is missing in \"-3\""},
      {"1-5,9-7", "character 5: \"9-7\" runs backwards"},
      {"1-9x", "character 5: the step is missing"},
      {"1-9x0", "character 5: the step is outside"},
      {"1-9y2", "character 4: \"1-9y2\" is no range"},
      {"1-9x2x2", "character 6: \"1-9x2x2\" is no range"},
      {"1:9", "character 2: \"1:9\" is no frame"},
      {"1 - 2", "character 2: \"1 - 2\" is no frame"},
      {"1.5", "character 2"},
      {"0", "character 1: a frame is outside 1-1000000"},
      {"1-1000001", "character 3: the last frame is outside"},
      {"99999999999", "outside"},
      {"a", "a frame is missing in \"a\""},
      {"1 2", "character 2"},
  };
  for (const auto& [text, said] : mistakes) {
    const Result<FrameSet> set = FrameSet::Parse(text);
    ASSERT_FALSE(set.ok()) << text;
    EXPECT_EQ(set.error().code, ErrorCode::kUsage) << text;
    EXPECT_THAT(set.error().message, HasSubstr(said)) << text;
    EXPECT_THAT(set.error().message, HasSubstr("20-40x2")) << text;
  }
}

TEST(FrameSetTest, PlacesAndNumbersBelongTogether) {
  for (const char* text : {"1-10,12,20-40x2", "3", "1-1000000", "2-999994x7", "1,5-8"}) {
    const FrameSet set = *FrameSet::Parse(text);
    EXPECT_EQ(set.ToString(), text);
    uint32_t index = 0;
    for (uint32_t number = 1; number <= 60; ++number) {
      EXPECT_EQ(set.IndexFrom(number), index) << text << " " << number;
      if (index < set.size() && set[index] == number) {
        EXPECT_EQ(set.IndexOf(number), index);
        ++index;
      } else {
        EXPECT_FALSE(set.Contains(number)) << text << " " << number;
      }
    }
    EXPECT_EQ(set[set.size() - 1], set.last());
    EXPECT_EQ(set.IndexOf(set.last()), set.size() - 1);
    EXPECT_EQ(set.IndexFrom(set.last() + 1), set.size());
  }
}

TEST(FrameSetTest, AMillionFramesInStepsAreOneSpan) {
  EXPECT_EQ(FrameSet::Parse("1-1000000")->spans().size(), 1u);
  EXPECT_EQ(FrameSet::Parse("1-1000000x2")->spans().size(), 1u);
  EXPECT_EQ(FrameSet::Parse("1-1000000x2")->size(), 500'000u);
}

TEST(FrameSetTest, SpansThatAreNoSetAreRefused) {
  const auto good = [](std::vector<FrameSpan> spans) {
    return FrameSet::FromSpans(spans).has_value();
  };
  EXPECT_TRUE(good({}));
  EXPECT_TRUE(good({{1, 10, 1}, {12, 12, 1}, {20, 40, 2}}));
  EXPECT_FALSE(good({{0, 10, 1}}));
  EXPECT_FALSE(good({{1, 1'000'001, 1}}));
  EXPECT_FALSE(good({{1, 10, 0}}));
  EXPECT_FALSE(good({{1, 10, 2}}));  // 10 is no frame of it
  EXPECT_FALSE(good({{5, 4, 1}}));
  EXPECT_FALSE(good({{1, 10, 1}, {10, 12, 1}}));
  EXPECT_FALSE(good({{5, 6, 1}, {1, 2, 1}}));
}

TEST(FrameSetTest, LongSetsAreCutWhenPrinted) {
  EXPECT_EQ(FrameSet::Parse("1,3,7,12,20")->ToString(2), "1,3 ...");
  EXPECT_EQ(FrameSet().ToString(), "");
}

}  // namespace
}  // namespace fjord
