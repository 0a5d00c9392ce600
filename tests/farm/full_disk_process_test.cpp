// A full disk under the coordinator: said, survived, and over when there is room.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "engine/scene/load.h"
#include "programs.h"
#include "talk.h"
#include "temp_dir.h"

namespace fjord::farm_test {
namespace {

size_t CountOf(const std::string& what, const std::string& text) {
  size_t count = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
}

class FullDiskProcessTest : public testing::Test {
 protected:
  void Start() {
    // By name: the list of LD_PRELOAD is split at spaces, which a path may hold.
    const std::string shim = FJORD_FULL_DISK_SHIM;
    const size_t slash = shim.rfind('/');
    coordinator_.LogTo(log_);
    ASSERT_TRUE(coordinator_.Start({{"LD_PRELOAD", shim.substr(slash + 1)},
                                    {"LD_LIBRARY_PATH", shim.substr(0, slash)},
                                    {"FJORD_FULL_DIR", data_.path() + "/data"},
                                    {"FJORD_FULL_FLAG", flag_}}));
    talk_ = std::make_unique<Talk>(coordinator_.address());
  }
  std::string Submit(int frames) {
    const LoadResult loaded =
        LoadSceneText(SceneText(frames, 64, 36, 1), "test", [](const v1::File& file) {
          return Result<std::string>(MakeError(ErrorCode::kNotFound, file.path()));
        });
    EXPECT_TRUE(loaded.ok());
    v1::SubmitRequest request;
    request.set_protocol(kProtocol);
    request.set_request_id("one");
    request.set_scene_digest(talk_->PutBytes(SerializeScene(loaded.loaded.scene)));
    return talk_->Submit(request).value.job_id();
  }
  void Fill(const std::string& what) { std::ofstream(flag_) << what; }
  void MakeRoom() { unlink(flag_.c_str()); }
  bool Until(const std::function<bool(const Said<v1::Job>&)>& holds, const std::string& job) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < end) {
      if (holds(talk_->GetJob(job))) return true;
      std::this_thread::yield();
    }
    return false;
  }

  TempDir data_;
  const std::string flag_ = data_.path() + "/full", log_ = data_.path() + "/log";
  Coordinator coordinator_{data_.path() + "/data"};
  std::unique_ptr<Talk> talk_;
};

TEST_F(FullDiskProcessTest, F8_AFullDiskIsSaidOnceAndOverWhenThereIsRoom) {
  ASSERT_NO_FATAL_FAILURE(Start());
  const std::string job = Submit(8);
  Fill("blobs");
  const auto worker = StartWorker(coordinator_.address(), "w", {}, data_.path() + "/worker");
  ASSERT_TRUE(Until([](const auto& said) { return !said.value.trouble().empty(); }, job));
  EXPECT_NE(talk_->GetJob(job).value.trouble().find("/data is full"), std::string::npos);
  EXPECT_EQ(talk_->GetJob(job).value.eta_ms(), 0u) << "nobody knows when";
  EXPECT_NE(talk_->Jobs().value.trouble(), "");
  EXPECT_NE(talk_->Workers().value.trouble(), "");
  MakeRoom();
  ASSERT_TRUE(Until([](const auto& said) { return said.value.state() == v1::DONE; }, job));
  EXPECT_EQ(talk_->GetJob(job).value.trouble(), "");
  ASSERT_TRUE(Until([&](const auto&) { return talk_->Jobs().value.trouble().empty(); }, job));
  const auto frames = talk_->Frames(job);
  for (const v1::Frame& frame : frames.value.frame()) {
    EXPECT_EQ(frame.attempts() + frame.lost_workers(), 0u) << frame.number();
  }
  const std::string log = FileText(log_);
  EXPECT_EQ(CountOf("[error]", log), 1u) << log;
  EXPECT_EQ(CountOf("over: the disk", log), 1u) << log;
  EXPECT_EQ(CountOf("can not take more now", FileText(data_.path() + "/worker")), 1u);
}

TEST_F(FullDiskProcessTest, F1_F8_AJournalWithoutRoomAnswersNothingAsDoneAndGoesOn) {
  ASSERT_NO_FATAL_FAILURE(Start());
  const std::string job = Submit(4);
  const auto worker = StartWorker(coordinator_.address(), "w", {}, data_.path() + "/worker");
  ASSERT_TRUE(Until([](const auto& said) { return said.value.state() == v1::DONE; }, job));
  Fill("all");
  // Its content is there already; the job is not on disk, so it is not taken.
  v1::SubmitRequest request;
  request.set_protocol(kProtocol);
  request.set_request_id("two");
  request.set_scene_digest(talk_->GetJob(job).value.scene_digest());
  const auto refused = talk_->Submit(request);
  EXPECT_EQ(refused.code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << refused.status.error_message();
  EXPECT_NE(refused.status.error_message().find("full"), std::string::npos);
  ASSERT_TRUE(Until([&](const auto&) { return CountOf("is full", FileText(log_)) == 1; }, job));
  MakeRoom();
  Said<v1::SubmitResponse> taken;
  ASSERT_TRUE(Until(
      [&](const auto&) {
        taken = talk_->Submit(request);
        return taken.ok();
      },
      job));
  EXPECT_TRUE(taken.value.existed()) << "it was written as soon as there was room";
  coordinator_.process().Kill(SIGKILL);
  coordinator_.process().Wait();
  ASSERT_NO_FATAL_FAILURE(Start());
  EXPECT_EQ(talk_->GetJob(taken.value.job_id()).value.state(), v1::DONE);
}

}  // namespace
}  // namespace fjord::farm_test
