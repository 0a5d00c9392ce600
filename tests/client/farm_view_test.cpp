#include "client/farm_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fjord {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

v1::WatchResponse Message(uint32_t first, uint32_t last, uint32_t done) {
  v1::WatchResponse message;
  message.set_workers(2);
  v1::Job* job = message.mutable_job();
  job->set_id("7");
  job->set_name("hill");
  job->set_state(v1::RUNNING);
  job->set_first_frame(first);
  job->set_last_frame(last);
  job->mutable_frames()->set_total(last - first + 1);
  job->mutable_frames()->set_done(done);
  job->mutable_frames()->set_waiting(last - first + 1 - done);
  return message;
}

void AddFrame(v1::WatchResponse* message, uint32_t number, v1::FrameState state,
              bool cached = false) {
  v1::Frame* frame = message->add_changed();
  frame->set_number(number);
  frame->set_state(state);
  frame->set_cached(cached);
}

TEST(FarmViewTest, TheMapHasACellAFrame) {
  FarmView view;
  v1::WatchResponse message = Message(5, 10, 2);
  AddFrame(&message, 5, v1::FRAME_DONE);
  AddFrame(&message, 6, v1::FRAME_DONE, true);
  AddFrame(&message, 7, v1::FRAME_RUNNING);
  AddFrame(&message, 9, v1::FRAME_FAILED);
  view.Apply(message, 0);
  EXPECT_THAT(view.FrameMap({80, false, false}, 4), ElementsAre("#=>.x."));
}

TEST(FarmViewTest, ManyFramesShareCellsAndAFailureIsNeverHidden) {
  FarmView view;
  v1::WatchResponse message = Message(1, 1000, 999);
  for (uint32_t i = 1; i <= 1000; ++i)
    AddFrame(&message, i, i == 500 ? v1::FRAME_FAILED : v1::FRAME_DONE);
  view.Apply(message, 0);
  const std::vector<std::string> map = view.FrameMap({41, false, false}, 2);
  ASSERT_LE(map.size(), 2u);
  std::string all;
  for (const std::string& row : map) {
    EXPECT_LE(row.size(), 40u);
    all += row;
  }
  EXPECT_EQ(std::count(all.begin(), all.end(), 'x'), 1);
}

TEST(FarmViewTest, RateAndTimeLeftComeFromWhatWasRenderedSinceTheStart) {
  FarmView view;
  view.Apply(Message(1, 100, 10), 100);
  view.Apply(Message(1, 100, 30), 105);
  EXPECT_EQ(view.PlainLine(105),
            "hill: running, 30 of 100 frames, 4.0 frames/s, 18 s left, 2 workers");
}

TEST(FarmViewTest, LinesNeverPassTheWidth) {
  FarmView view;
  v1::WatchResponse message = Message(1, 96, 3);
  AddFrame(&message, 1, v1::FRAME_DONE);
  view.Apply(message, 0);
  v1::WorkerInfo worker;
  worker.set_id(std::string(100, 'w'));
  worker.set_state(v1::WorkerInfo::ALIVE);
  view.SetWorkers({worker});
  for (const int width : {20, 40, 80, 200}) {
    for (const std::string& line : view.Lines({width, false, false}, 1))
      EXPECT_LT(line.size(), static_cast<size_t>(width)) << line;
  }
  EXPECT_THAT(view.Lines({80, false, false}, 1)[0], HasSubstr("hill"));
}

}  // namespace
}  // namespace fjord
