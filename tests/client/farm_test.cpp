// The whole way on real programs: farm, submit, watch, fetch, movie; the same pictures as `render`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/client/run_program.h"

namespace fjord::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class FarmTest : public ::testing::Test {
 protected:
  void StartFarm(int workers, const std::vector<std::string>& more = {}) {
    std::vector<std::string> command = {
        FJORD_PROGRAM,    "farm",     "--workers",   std::to_string(workers), "--data",
        folder_ / "data", "--listen", "127.0.0.1:0", "--with-parent"};
    command.insert(command.end(), more.begin(), more.end());
    farm_ = std::make_unique<RunningProgram>(command);
    ASSERT_TRUE(WaitUntil([&] { return farm_->OutSoFar().find('\n') != std::string::npos; }));
    const std::string out = farm_->OutSoFar();
    ASSERT_EQ(out.rfind("listening on ", 0), 0u) << out;
    options_.environment = {"FJORD_SERVER=" + out.substr(13, out.find('\n') - 13)};
  }

  ProgramRun Fjord(std::vector<std::string> arguments) {
    return RunFjord(std::move(arguments), options_);
  }

  std::string Digests(const std::string& folder) { return RunFjord({"digest", "."}, {folder}).out; }

  const ScratchFolder folder_;
  const std::string scene_ = folder_.Write("tiny.scene", TinyScene(12));
  ProgramOptions options_;
  std::unique_ptr<RunningProgram> farm_;
};

TEST_F(FarmTest, TheFarmMakesThePicturesThatRenderMakes) {
  ASSERT_NO_FATAL_FAILURE(StartFarm(2));
  const ProgramRun submitted = Fjord({"submit", scene_, "--wait", "--json"});
  ASSERT_EQ(submitted.code, 0) << submitted.err;
  const auto json = nlohmann::json::parse(submitted.out);
  const std::string job = json["id"];
  EXPECT_EQ(json["job"]["frames"]["done"], 12);
  EXPECT_EQ(json["job"]["state"], "done");

  ASSERT_EQ(RunFjord({"render", scene_, "-o", folder_ / "here"}).code, 0);
  const std::string out = folder_ / "fetched";
  const ProgramRun fetched = Fjord({"fetch", job, "-o", out});
  ASSERT_EQ(fetched.code, 0) << fetched.err;
  EXPECT_EQ(Digests(out), Digests(folder_ / "here"));
  fs::remove(out + "/tiny.0005.png");
  fs::resize_file(out + "/tiny.0006.png", 50);
  const ProgramRun again = Fjord({"fetch", job, "-o", out, "--json"});
  EXPECT_EQ(nlohmann::json::parse(again.out)["fetched"], 2);
  EXPECT_EQ(nlohmann::json::parse(again.out)["kept"], 10);
  EXPECT_EQ(Digests(out), Digests(folder_ / "here"));
  // `render` goes on in a folder that `fetch` began, and the other way round.
  EXPECT_THAT(RunFjord({"render", scene_, "-o", out}).err, HasSubstr("12 were there already"));

  EXPECT_EQ(Fjord({"movie", job, "-o", folder_ / "m.mp4"}).code, 0);
  EXPECT_THAT(Fjord({"jobs"}).out, HasSubstr(job));
  EXPECT_EQ(nlohmann::json::parse(Fjord({"workers", "--json"}).out).size(), 2u);
  EXPECT_EQ(Fjord({"watch", job}).code, 0);

  const auto second = nlohmann::json::parse(Fjord({"submit", scene_, "--wait", "--json"}).out);
  EXPECT_EQ(second["job"]["frames"]["cached"], 12);
  farm_->Signal(SIGTERM);
  EXPECT_EQ(farm_->Wait().code, 0);
}

// Work is shared, and what each worker did is recorded, so that a speed-up can be read off.
TEST_F(FarmTest, G56_WorkersShareTheFramesAndTheirTimesAreRecorded) {
  ASSERT_NO_FATAL_FAILURE(StartFarm(2));
  ASSERT_TRUE(WaitUntil([&] {
    return nlohmann::json::parse(Fjord({"workers", "--json"}).out).size() == 2;
  }));
  const std::string scene = folder_.Write("shared.scene", TinyScene(60));
  ASSERT_EQ(Fjord({"submit", scene, "--wait"}).code, 0);
  uint64_t frames = 0;
  for (const auto& worker : nlohmann::json::parse(Fjord({"workers", "--json"}).out)) {
    EXPECT_GT(worker["frames_done"].get<uint64_t>(), 0u) << worker;
    EXPECT_TRUE(worker.contains("render_ms")) << worker;
    frames += worker["frames_done"].get<uint64_t>();
  }
  EXPECT_EQ(frames, 60u);
}

// Case: a stored picture was empty, or gone, and its job as dead as every later one.
TEST_F(FarmTest, F2_DamagedPicturesAreMadeAgain) {
  ASSERT_NO_FATAL_FAILURE(StartFarm(1));
  const std::string job = nlohmann::json::parse(Fjord({"submit", scene_, "--json"}).out)["id"];
  const auto pictures = [&] {
    std::vector<std::string> found;
    for (const auto& file : fs::recursive_directory_iterator(folder_ / "data/blobs")) {
      if (!file.is_regular_file()) continue;
      if (ReadAll(file.path()).starts_with("\x89PNG")) found.push_back(file.path());
    }
    std::sort(found.begin(), found.end());
    return found;
  };
  const auto done = [&](const std::string& which) {
    return WaitUntil([&] {
      const auto json = nlohmann::json::parse(Fjord({"status", which, "--json"}).out);
      return json["state"] == "done" && json["frames"]["done"] == 12;
    });
  };
  ASSERT_EQ(RunFjord({"render", scene_, "-o", folder_ / "here"}).code, 0);
  ASSERT_TRUE(done(job));
  std::vector<std::string> stored = pictures();
  ASSERT_EQ(stored.size(), 12u);
  fs::resize_file(stored[0], 0);
  fs::resize_file(stored[1], 40);
  std::string bytes = ReadAll(stored[2]);
  bytes[bytes.size() / 2] ^= 1;
  std::ofstream(stored[2], std::ios::binary) << bytes;
  fs::remove(stored[3]);
  const ProgramRun fetched = Fjord({"fetch", job, "-o", folder_ / "out", "--json"});
  EXPECT_EQ(fetched.code, 1);
  EXPECT_EQ(nlohmann::json::parse(fetched.out)["fetched"], 8) << "the others come";
  EXPECT_EQ(nlohmann::json::parse(fetched.out)["lost"], 4);
  EXPECT_THAT(fetched.err, HasSubstr("gone or damaged"));
  ASSERT_TRUE(done(job));
  EXPECT_EQ(Fjord({"fetch", job, "-o", folder_ / "out"}).code, 0);
  EXPECT_EQ(Digests(folder_ / "out"), Digests(folder_ / "here"));

  // A new job does not count on what is dead.
  fs::resize_file(stored[4], 0);
  fs::remove(stored[5]);
  const auto second = nlohmann::json::parse(Fjord({"submit", scene_, "--json"}).out);
  ASSERT_TRUE(done(second["id"]));
  EXPECT_EQ(
      nlohmann::json::parse(Fjord({"status", second["id"], "--json"}).out)["frames"]["cached"], 10);
  EXPECT_EQ(Fjord({"fetch", second["id"], "-o", folder_ / "second"}).code, 0);

  // Nor does a coordinator that starts.
  farm_->Signal(SIGTERM);
  EXPECT_EQ(farm_->Wait().code, 0);
  fs::resize_file(stored[6], 30);
  fs::remove(stored[7]);
  ASSERT_NO_FATAL_FAILURE(StartFarm(1));
  ASSERT_TRUE(WaitUntil([&] { return pictures().size() == 12; }));
  ASSERT_TRUE(done(job));
  EXPECT_EQ(Fjord({"fetch", job, "-o", folder_ / "third"}).code, 0);
  EXPECT_EQ(Digests(folder_ / "third"), Digests(folder_ / "here"));
}

TEST_F(FarmTest, JobsCanBePausedResumedAndCancelled) {
  ASSERT_NO_FATAL_FAILURE(StartFarm(1));
  const std::string scene = folder_.Write("long.scene", TinyScene(3000));
  std::string job = Fjord({"submit", scene, "--request-id", "one"}).out;
  ASSERT_FALSE(job.empty());
  job.pop_back();
  EXPECT_EQ(Fjord({"submit", scene, "--request-id", "one"}).out, job + "\n");
  EXPECT_EQ(Fjord({"submit", scene_, "--request-id", "one"}).code, 1);
  const auto state = [&](const std::vector<std::string>& command) {
    return nlohmann::json::parse(Fjord(command).out)["state"].get<std::string>();
  };
  EXPECT_EQ(state({"pause", job, "--json"}), "paused");
  EXPECT_THAT(state({"resume", job, "--json"}), ::testing::AnyOf("running", "queued"));
  EXPECT_EQ(nlohmann::json::parse(Fjord({"priority", job, "7", "--json"}).out)["priority"], 7);
  EXPECT_EQ(state({"cancel", job, "--json"}), "cancelled");
  EXPECT_EQ(Fjord({"watch", job}).code, 1);
  EXPECT_EQ(Fjord({"fetch", job, "-o", folder_ / "part"}).code, 1);
}

TEST_F(FarmTest, F2_AJobIsAListOfFrames) {
  ASSERT_NO_FATAL_FAILURE(StartFarm(1));
  const ProgramRun run = Fjord({"submit", scene_, "--frames", "9,1-5x2,3", "--wait", "--json"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto job = nlohmann::json::parse(run.out)["job"];
  EXPECT_EQ(job["frames"]["total"], 4);
  EXPECT_EQ(job["frame_list"], "1-5x2,9");
  ASSERT_EQ(Fjord({"fetch", job["id"], "-o", folder_ / "out"}).code, 0);
  std::set<std::string> files;
  for (const auto& file : fs::directory_iterator(folder_ / "out"))
    files.insert(file.path().filename());
  EXPECT_EQ(files, (std::set<std::string>{"manifest.json", "tiny.0001.png", "tiny.0003.png",
                                          "tiny.0005.png", "tiny.0009.png"}));
  EXPECT_EQ(Fjord({"submit", scene_, "--frames", "1-13x4,20"}).code, 1) << "12 frames there are";
}

// Case: a frame that never ends.
TEST_F(FarmTest, F5_AFrameOverItsTimeLimitHasFailedWithTheReason) {
  ASSERT_NO_FATAL_FAILURE(StartFarm(1, {"--budget", "unlimited"}));
  const std::string endless = std::string(FJORD_SOURCE_DIR) + "/tests/cases/36.scene";
  const ProgramRun run = Fjord(
      {"submit", endless, "--budget", "unlimited", "--frame-limit", "0.3", "--wait", "--json"});
  EXPECT_EQ(run.code, 1);
  const auto job = nlohmann::json::parse(run.out)["job"];
  EXPECT_EQ(job["state"], "failed");
  EXPECT_EQ(job["frame_limit"], .3);
  EXPECT_THAT(job["error"].get<std::string>(),
              HasSubstr("took longer than its 0.3 s (--frame-limit)"));
  EXPECT_EQ(Fjord({"submit", scene_, "--wait"}).code, 0) << "the worker lives";
}

// Case: draining a worker ended the whole farm.
TEST_F(FarmTest, F5_ADrainedWorkerStaysAwayUntilItIsReleased) {
  ASSERT_NO_FATAL_FAILURE(StartFarm(1));
  const auto worker = [&] { return nlohmann::json::parse(Fjord({"workers", "--json"}).out); };
  ASSERT_TRUE(WaitUntil([&] { return worker().size() == 1; }));
  const std::string id = worker()[0]["id"];
  ASSERT_EQ(Fjord({"workers", "drain", id}).code, 0);
  std::string job = Fjord({"submit", scene_}).out;
  job.pop_back();
  EXPECT_EQ(worker()[0]["state"], "draining");
  EXPECT_EQ(nlohmann::json::parse(Fjord({"status", job, "--json"}).out)["frames"]["waiting"], 12);
  ASSERT_EQ(Fjord({"workers", "release", id}).code, 0);
  EXPECT_EQ(Fjord({"watch", job}).code, 0);
  farm_->Signal(SIGTERM);
  const ProgramRun ended = farm_->Wait();
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.err.find("starting it again"), std::string::npos) << ended.err;
}

TEST_F(FarmTest, F7_WhatComesAfterACancelledJobEndsAndBothCanGoOn) {
  ASSERT_NO_FATAL_FAILURE(StartFarm(1));
  const std::string scene = folder_.Write("long.scene", TinyScene(3000));
  ASSERT_EQ(Fjord({"submit", scene, "--frames", "1-3000x2"}).out, "1\n");
  ASSERT_EQ(Fjord({"submit", scene_, "--after", "1"}).out, "2\n");
  EXPECT_THAT(Fjord({"jobs"}).out, HasSubstr(", after job 1"));
  EXPECT_THAT(Fjord({"status", "2"}).out, HasSubstr("after     job 1"));
  EXPECT_EQ(nlohmann::json::parse(Fjord({"status", "2", "--json"}).out)["after"], "1");
  EXPECT_EQ(Fjord({"delete", "1"}).code, 1) << "it has not ended";
  ASSERT_EQ(Fjord({"cancel", "1"}).code, 0);
  const ProgramRun watched = Fjord({"watch", "2"});
  EXPECT_EQ(watched.code, 1);
  EXPECT_THAT(watched.err, HasSubstr("job 1 was cancelled, and this one was to run after it"));
  EXPECT_THAT(Fjord({"retry", "2"}).err, HasSubstr("retry that one first"));
  EXPECT_EQ(Fjord({"retry", "1"}).code, 0);
  EXPECT_EQ(Fjord({"retry", "2"}).code, 0);
  ASSERT_EQ(Fjord({"cancel", "1"}).code, 0);
  EXPECT_EQ(Fjord({"delete", "1", "2"}).code, 0);
  EXPECT_EQ(nlohmann::json::parse(Fjord({"jobs", "--json"}).out).size(), 0u);
}

TEST_F(FarmTest, TheFarmDiesWithItsParent) {
  ASSERT_NO_FATAL_FAILURE(StartFarm(1));
  const auto children = [&] {
    return ReadAll("/proc/" + std::to_string(farm_->pid()) + "/task/" +
                   std::to_string(farm_->pid()) + "/children");
  };
  std::istringstream list(children());
  std::vector<std::string> pids{std::istream_iterator<std::string>(list), {}};
  ASSERT_EQ(pids.size(), 2u);
  farm_->Signal(SIGKILL);
  farm_->Wait();
  for (const std::string& pid : pids) {
    EXPECT_TRUE(WaitUntil([&] {
      const std::string status = ReadAll("/proc/" + pid + "/status");
      return status.empty() || status.find("State:\tZ") != std::string::npos;
    }));
  }
}

}  // namespace
}  // namespace fjord::testing
