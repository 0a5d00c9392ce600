// `fjord render`: frames, manifest, going on after an end of any kind, two at once.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "tests/client/run_program.h"

namespace fjord::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string Digests(const std::string& folder) {
  const ProgramRun run = RunFjord({"digest", "."}, {folder});
  EXPECT_EQ(run.code, 0) << run.err;
  return run.out;
}

size_t FilesEndingIn(const std::string& folder, const std::string& ending) {
  size_t count = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    count += entry.path().string().ends_with(ending);
  return count;
}

class RenderTest : public ::testing::Test {
 protected:
  std::string Reference(int frames) {
    scene_ = folder_.Write("tiny.scene", TinyScene(frames));
    const ProgramRun run =
        RunFjord({"render", scene_, "-o", folder_ / "reference", "--threads", "1"});
    EXPECT_EQ(run.code, 0) << run.err;
    return Digests(folder_ / "reference");
  }

  const ScratchFolder folder_;
  std::string scene_;
};

TEST_F(RenderTest, WritesFramesAndAManifest) {
  const std::string digests = Reference(3);
  EXPECT_EQ(std::count(digests.begin(), digests.end(), '\n'), 3);
  EXPECT_THAT(digests, HasSubstr("  tiny.0003.png\n"));
  const auto manifest = nlohmann::json::parse(ReadAll(folder_ / "reference/manifest.json"));
  for (const auto& frame : manifest["frames"])
    EXPECT_THAT(digests, HasSubstr(frame["pixel_digest"].get<std::string>()));
  EXPECT_EQ(manifest["scene"]["parameters"]["objects"][0]["fractal"]["seed"], "5");
  EXPECT_GT(manifest["frames"][0]["triangles_made"], 0);
}

TEST_F(RenderTest, EveryThreadCountGivesTheSamePictures) {
  const std::string digests = Reference(3);
  for (const char* threads : {"2", "7"}) {
    const std::string out = folder_ / (std::string("threads") + threads);
    ASSERT_EQ(RunFjord({"render", scene_, "-o", out, "--threads", threads}).code, 0);
    EXPECT_EQ(Digests(out), digests);
  }
}

TEST_F(RenderTest, KeepsFramesThatAreThereAndMakesOthersAnew) {
  const std::string digests = Reference(4);
  const std::string out = folder_ / "out";
  ASSERT_EQ(RunFjord({"render", scene_, "-o", out, "--frames", "1-3"}).code, 0);
  fs::resize_file(out + "/tiny.0002.png", 100);  // damaged
  const ProgramRun run = RunFjord({"render", scene_, "-o", out});
  EXPECT_EQ(run.code, 0);
  EXPECT_THAT(run.err, HasSubstr("2 frames rendered, 2 were there already"));
  EXPECT_EQ(Digests(out), digests);
  const ProgramRun other =
      RunFjord({"render", scene_, "-o", out, "--replace", "--set", "objects[hill].fractal.seed=6"});
  EXPECT_THAT(other.err, HasSubstr("4 frames rendered"));
  EXPECT_NE(Digests(out), digests);
}

TEST_F(RenderTest, GoesOnAfterKillNine) {
  const std::string digests = Reference(40);
  const std::string out = folder_ / "out";
  RunningProgram program({FJORD_PROGRAM, "render", scene_, "-o", out, "--threads", "2"});
  EXPECT_TRUE(WaitUntil([&] { return FilesEndingIn(out, ".png") >= 3; }));
  program.Signal(SIGKILL);
  program.Wait();
  const ProgramRun run = RunFjord({"render", scene_, "-o", out});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(Digests(out), digests);
}

TEST_F(RenderTest, CtrlCLeavesFinishedFramesAndAManifestToGoOnFrom) {
  const std::string digests = Reference(200);
  const std::string out = folder_ / "out";
  RunningProgram program({FJORD_PROGRAM, "render", scene_, "-o", out});
  EXPECT_TRUE(WaitUntil([&] { return FilesEndingIn(out, ".png") >= 3; }));
  program.Signal(SIGINT);
  const ProgramRun ended = program.Wait();
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.err, HasSubstr("interrupted"));
  EXPECT_THAT(ended.err, HasSubstr("the same command continues"));
  const auto manifest = nlohmann::json::parse(ReadAll(out + "/manifest.json"));
  EXPECT_EQ(manifest["frames"].size(), FilesEndingIn(out, ".png"));
  EXPECT_EQ(FilesEndingIn(out, ".tmp"), 0u);
  const ProgramRun again = RunFjord({"render", scene_, "-o", out});
  EXPECT_THAT(again.err, HasSubstr("were there already"));
  EXPECT_EQ(Digests(out), digests);
}

TEST_F(RenderTest, ClosedStandardStreamsDoNotEndUpInPictures) {
  scene_ = folder_.Write("tiny.scene", TinyScene(1000));
  const std::string out = folder_ / "out";
  RunningProgram program(
      {"sh", "-c", R"(exec "$0" render "$1" -o "$2" <&- >&- 2>&-)", FJORD_PROGRAM, scene_, out});
  EXPECT_TRUE(WaitUntil([&] { return FilesEndingIn(out, ".png") >= 1; }));
  for (const char* stream : {"1", "2"}) {  // a library takes 0 before main()
    const std::string link = "/proc/" + std::to_string(program.pid()) + "/fd/" + stream;
    std::error_code error;
    EXPECT_EQ(fs::read_symlink(link, error), "/dev/null") << stream;
  }
}

TEST_F(RenderTest, TwoAtOnceInOneFolderAreRefusedInTwoFoldersEqual) {
  const std::string digests = Reference(6);
  const std::string locked = folder_ / "locked";
  fs::create_directory(locked);
  const int fd = open(locked.c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(flock(fd, LOCK_EX), 0);
  const ProgramRun refused = RunFjord({"render", scene_, "-o", locked});
  close(fd);
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("another fjord is writing into this folder"));
  RunningProgram one({FJORD_PROGRAM, "render", scene_, "-o", folder_ / "one"});
  RunningProgram two({FJORD_PROGRAM, "render", scene_, "-o", folder_ / "two"});
  EXPECT_EQ(one.Wait().code, 0);
  EXPECT_EQ(two.Wait().code, 0);
  EXPECT_EQ(Digests(folder_ / "one"), digests);
  EXPECT_EQ(Digests(folder_ / "two"), digests);
}

TEST_F(RenderTest, AFolderThatCannotBeWrittenIsNamed) {
  scene_ = folder_.Write("tiny.scene", TinyScene(1));
  const std::string file = folder_.Write("a file", "");
  for (const std::string& out : {file, file + "/below", std::string("/proc/fjord")}) {
    const ProgramRun run = RunFjord({"render", scene_, "-o", out});
    EXPECT_EQ(run.code, 1) << out;
    EXPECT_THAT(run.err, HasSubstr(out));
    EXPECT_THAT(run.err, HasSubstr("-o")) << run.err;
  }
}

TEST_F(RenderTest, AFullFolderLeavesNoHalfWrittenFile) {
  scene_ = folder_.Write("tiny.scene", TinyScene(2));
  const std::string out = folder_ / "out";
  ProgramOptions options;
  options.largest_file = 300;  // as a full disk: writing ends in the middle of a file
  const ProgramRun run = RunFjord({"render", scene_, "-o", out, "--size", "200x200"}, options);
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.err, HasSubstr("error: "));
  EXPECT_THAT(run.err, HasSubstr(out));
  EXPECT_TRUE(fs::is_empty(out)) << "something was left in " << out;
}

}  // namespace
}  // namespace fjord::testing
