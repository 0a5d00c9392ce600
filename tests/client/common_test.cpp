#include "client/commands/common.h"

#include <gtest/gtest.h>

#include "client/contact_sheet.h"
#include "client/files.h"

namespace fjord {
namespace {

TEST(FrameRangeTest, TakesOneFrameARangeOrNothing) {
  EXPECT_EQ(ParseFrameRange("")->first, 0u);
  EXPECT_EQ(ParseFrameRange("7")->first, 7u);
  EXPECT_EQ(ParseFrameRange("7")->last, 7u);
  EXPECT_EQ(ParseFrameRange("3-48")->last, 48u);
  for (const char* bad : {"0", "-3", "3-", "a", "5-3", "1-2-3", "1 - 2", "99999999999", "1.5"})
    EXPECT_EQ(ParseFrameRange(bad).ok(), false) << bad;
}

TEST(SizeTest, TakesWidthTimesHeight) {
  EXPECT_EQ(ParseSize("960x540")->width, 960u);
  EXPECT_EQ(ParseSize("960x540")->height, 540u);
  for (const char* bad : {"", "960", "x", "0x5", "5x0", "960x540x2", "-1x5"})
    EXPECT_FALSE(ParseSize(bad).ok()) << bad;
}

TEST(SettingsTest, SplitAtTheFirstEquals) {
  const auto settings = ParseSettings({"objects[a].name=b=c"});
  ASSERT_TRUE(settings.ok());
  EXPECT_EQ((*settings)[0].path, "objects[a].name");
  EXPECT_EQ((*settings)[0].value, "b=c");
  EXPECT_FALSE(ParseSettings({"novalue"}).ok());
  EXPECT_FALSE(ParseSettings({"=3"}).ok());
}

TEST(FileNameTest, FourDigitsOrMore) {
  EXPECT_EQ(FrameFileName("hill", 7, "png"), "hill.0007.png");
  EXPECT_EQ(FrameFileName("hill", 123456, "exr"), "hill.123456.exr");
}

TEST(BoxFilterTest, KeepsTheMeanAndAConstant) {
  std::vector<float> picture(7 * 5 * 3);
  double mean = 0;
  for (size_t i = 0; i < picture.size(); ++i)
    mean += picture[i] = static_cast<float>((i * 37) % 11);
  mean /= static_cast<double>(picture.size());
  for (const auto& [width, height] : {std::pair{7, 5}, {3, 2}, {1, 1}, {7, 1}}) {
    const std::vector<float> small = BoxFilter(picture, 7, 5, width, height);
    double sum = 0;
    for (const float sample : small) sum += sample;
    EXPECT_NEAR(sum / static_cast<double>(small.size()), mean, 1e-4);
  }
}

}  // namespace
}  // namespace fjord
