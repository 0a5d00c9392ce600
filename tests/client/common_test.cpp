#include "client/commands/common.h"

#include <gtest/gtest.h>

#include "client/contact_sheet.h"
#include "client/files.h"

namespace fjord {
namespace {

TEST(FramesTest, TakesFramesOrNothing) {
  EXPECT_TRUE(ParseFrames("")->empty());
  EXPECT_EQ(ParseFrames("1-10,12")->size(), 11u);
  const Result<FrameSet> bad = ParseFrames("1-10,12-");
  ASSERT_FALSE(bad.ok());
  EXPECT_EQ(bad.error().message.rfind("--frames 1-10,12-: character 9: ", 0), 0u)
      << bad.error().message;
}

TEST(FramesTest, FramesOutsideTheAnimationAreNamed) {
  EXPECT_EQ(WithinAnimation(FrameSet(), 1, 12, "s")->ToString(), "1-12");
  EXPECT_EQ(WithinAnimation(*ParseFrames("2,5-12x2"), 1, 12, "s")->ToString(), "2,5-11x2");
  const Result<FrameSet> outside = WithinAnimation(*ParseFrames("2,11-13"), 1, 12, "s");
  ASSERT_FALSE(outside.ok());
  EXPECT_EQ(
      outside.error().message.rfind("frames 2,11-13 are asked for, the animation has 1-12", 0), 0u)
      << outside.error().message;
}

TEST(SizeTest, TakesWidthTimesHeightOrAShare) {
  EXPECT_EQ(ParseSize("960x540")->width, 960u);
  EXPECT_EQ(ParseSize("960x540")->height, 540u);
  EXPECT_EQ(ParseSize("50%")->share, .5);
  EXPECT_EQ(ParseSize("12.5%")->share, .125);
  for (const char* bad : {"", "960", "x", "0x5", "5x0", "960x540x2", "-1x5", "%", "0%", "-5%",
                          "50%x2", "a%", "nan%", "50%%"})
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
