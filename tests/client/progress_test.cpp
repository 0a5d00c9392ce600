#include "client/progress.h"

#include <gtest/gtest.h>

#include <vector>

namespace fjord {
namespace {

using Clock = std::chrono::steady_clock;

class ProgressTest : public ::testing::Test {
 protected:
  FrameProgress::Outlet Outlet(bool terminal) {
    return {terminal, 80, [this](const std::string& line) { live_.push_back(line); },
            [this](const std::string& line) { plain_.push_back(line); }};
  }
  MonotonicNow Now() {
    return [this] { return now_; };
  }
  void Pass(double seconds) { now_ += std::chrono::milliseconds(static_cast<int>(seconds * 1000)); }

  Clock::time_point now_{};
  std::vector<std::string> live_, plain_;
};

TEST_F(ProgressTest, APipeGetsPlainLinesAtIntervalsAndTheLastOne) {
  FrameProgress progress("hill", 100, Outlet(false), Now());
  for (int i = 0; i < 100; ++i) {
    Pass(.25);
    progress.FrameDone();
  }
  ASSERT_EQ(plain_.size(), 5u);  // 5, 10, 15, 20 s, and the end
  EXPECT_EQ(plain_[0], "hill: 20 of 100 frames, 4.0 frames/s, 20 s left");
  EXPECT_EQ(plain_.back(), "hill: 100 of 100 frames, 4.0 frames/s, 25 s");
  EXPECT_TRUE(live_.empty());
}

TEST_F(ProgressTest, ATerminalGetsABarThatFits) {
  {
    FrameProgress progress("hill", 4, Outlet(true), Now());
    Pass(2);
    progress.FrameDone();
    Pass(2);
    progress.Share(.5);
  }
  ASSERT_EQ(live_.size(), 3u);
  EXPECT_NE(live_[0].find("1 of 4 frames, 2.0 s a frame, 6 s left"), std::string::npos) << live_[0];
  EXPECT_NE(live_[0].find("[####"), std::string::npos) << live_[0];
  for (const std::string& line : live_) EXPECT_LT(line.size(), 80u);
  EXPECT_EQ(live_.back(), "");  // taken away
  EXPECT_TRUE(plain_.empty());
}

TEST_F(ProgressTest, FramesThatWereThereDoNotCountForTheRate) {
  FrameProgress progress("hill", 12, Outlet(false), Now());
  for (int i = 0; i < 10; ++i) progress.FrameKept();
  Pass(5);
  progress.FrameDone();
  ASSERT_EQ(plain_.size(), 1u);
  EXPECT_EQ(plain_[0], "hill: 11 of 12 frames (10 were there), 5.0 s a frame, 5 s left");
}

TEST(FormatDurationTest, RoundsToWhatPeopleRead) {
  EXPECT_EQ(FormatDuration(0), "0 s");
  EXPECT_EQ(FormatDuration(59.4), "59 s");
  EXPECT_EQ(FormatDuration(250), "4 min 10 s");
  EXPECT_EQ(FormatDuration(7500), "2 h 5 min");
  EXPECT_EQ(FormatDuration(-1), "0 s");
}

}  // namespace
}  // namespace fjord
