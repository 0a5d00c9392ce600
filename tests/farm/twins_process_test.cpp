// Workers of one name, as programs: machines that were made from one image.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <thread>

#include "engine/scene/load.h"
#include "programs.h"
#include "talk.h"
#include "temp_dir.h"

namespace fjord::farm_test {
namespace {

class TwinsProcessTest : public testing::Test {
 protected:
  // A machine knows of its own workers only.
  Environment Machine(const std::string& name) {
    const std::string folder = data_.path() + "/" + name;
    mkdir(folder.c_str(), 0700);
    return {{"XDG_RUNTIME_DIR", folder}};
  }
  std::string Log(const std::string& name) { return data_.path() + "/" + name + ".log"; }
  std::unique_ptr<Process> StartTwin(const std::string& machine) {
    return StartWorker(coordinator_.address(), "twin", Machine(machine), Log(machine));
  }
  bool Joined(const std::string& machine) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < end) {
      if (FileText(Log(machine)).find("joined") != std::string::npos) return true;
      std::this_thread::yield();
    }
    return false;
  }
  std::string Submit(Talk& talk, int frames) {
    const LoadResult loaded =
        LoadSceneText(SceneText(frames, 64, 36, 1), "test", [](const v1::File& file) {
          return Result<std::string>(MakeError(ErrorCode::kNotFound, file.path()));
        });
    EXPECT_TRUE(loaded.ok());
    v1::SubmitRequest request;
    request.set_protocol(kProtocol);
    request.set_request_id("one");
    request.set_scene_digest(talk.PutBytes(SerializeScene(loaded.loaded.scene)));
    return talk.Submit(request).value.job_id();
  }

  TempDir data_;
  Coordinator coordinator_{data_.path() + "/data"};
};

TEST_F(TwinsProcessTest, F5_TheSecondOfThreeTwinsIsRefusedWhileTheFirstIsAlive) {
  coordinator_.Term(60'000);
  coordinator_.LogTo(Log("coordinator"));
  ASSERT_TRUE(coordinator_.Start());
  const auto first = StartTwin("a");
  ASSERT_TRUE(Joined("a"));
  const auto second = StartTwin("b"), third = StartTwin("c");
  Talk talk(coordinator_.address());
  const std::string job = Submit(talk, 12);
  for (const auto* twin : {&second, &third}) EXPECT_EQ(WEXITSTATUS((*twin)->Wait()), 1);
  ASSERT_TRUE(talk.WatchToTheEnd(job).ok());
  const auto frames = talk.Frames(job);
  ASSERT_EQ(frames.value.frame_size(), 12);
  for (const v1::Frame& frame : frames.value.frame()) {
    EXPECT_EQ(frame.state(), v1::FRAME_DONE);
    EXPECT_EQ(frame.lost_workers(), 0u) << "a healthy frame is no suspect";
  }
  for (const char* machine : {"b", "c"}) {
    const std::string said = FileText(Log(machine));
    EXPECT_NE(said.find("a worker \"twin\" on "), std::string::npos) << said;
    EXPECT_NE(said.find("is alive, joined "), std::string::npos) << said;
    EXPECT_NE(said.find("with --id\n"), std::string::npos) << said;
    EXPECT_LE(std::count(said.begin(), said.end(), '\n'), 2) << said;
  }
  const std::string log = FileText(Log("coordinator"));
  const size_t line = log.find("a second worker \"twin\"");
  EXPECT_NE(line, std::string::npos) << log;
  EXPECT_EQ(log.find("a second worker", line + 1), std::string::npos) << "once a minute\n" << log;
}

TEST_F(TwinsProcessTest, F5_AWorkerThatIsStartedAgainAfterKillNineGoesOnAtOnce) {
  coordinator_.Term(600'000);
  ASSERT_TRUE(coordinator_.Start());
  for (int run = 0; run < 3; ++run) {
    auto worker = StartTwin("a");
    ASSERT_TRUE(Joined("a")) << "not after its lease term";
    worker->Kill(SIGKILL);
    worker->Wait();
    unlink(Log("a").c_str());
  }
}

TEST_F(TwinsProcessTest, F5_ATwinTakesTheNameOfOneThatDiedOnAnotherMachine) {
  coordinator_.Term(500);
  ASSERT_TRUE(coordinator_.Start());
  auto first = StartTwin("a");
  ASSERT_TRUE(Joined("a"));
  first->Kill(SIGKILL);
  first->Wait();
  const auto second = StartTwin("b");
  EXPECT_TRUE(Joined("b"));
  // The first comes back: now it is the second who is refused.
  first = StartTwin("a");
  EXPECT_EQ(WEXITSTATUS(first->Wait()), 1);
}

}  // namespace
}  // namespace fjord::farm_test
