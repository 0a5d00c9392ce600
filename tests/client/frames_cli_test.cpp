// --frames in every command, and folders whose frames are not all there or not all of one scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/client/run_program.h"

namespace fjord::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class FramesCliTest : public ::testing::Test {
 protected:
  ProgramRun Render(const std::vector<std::string>& more) {
    std::vector<std::string> command = {"render", scene_, "-o", out_};
    command.insert(command.end(), more.begin(), more.end());
    return RunFjord(command);
  }
  ProgramRun Sheet(const std::vector<std::string>& more = {}) {
    std::vector<std::string> command = {"sheet", out_, "-o", folder_ / "sheet.png"};
    command.insert(command.end(), more.begin(), more.end());
    return RunFjord(command);
  }
  std::vector<std::string> Pictures() const {
    std::vector<std::string> names;
    for (const auto& file : fs::directory_iterator(out_)) {
      if (file.path().extension() == ".png") names.push_back(file.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  const ScratchFolder folder_;
  const std::string scene_ = std::string(FJORD_SOURCE_DIR) + "/tests/cases/20.scene";
  const std::string out_ = folder_ / "o";
};

TEST_F(FramesCliTest, C20_AMissingFrameIsNamedByMovieAndSheet) {
  ASSERT_EQ(Render({"--frames", "1-3"}).code, 0);
  ASSERT_EQ(Render({"--frames", "5-12"}).code, 0);
  for (const ProgramRun& run : {RunFjord({"movie", out_, "-o", folder_ / "m.mp4"}), Sheet()}) {
    EXPECT_EQ(run.code, 1);
    EXPECT_THAT(run.err, HasSubstr(out_ + ": error: frame 4 of 12 is missing; "));
  }
  EXPECT_FALSE(fs::exists(folder_ / "m.mp4"));
  const ProgramRun told = Sheet({"--allow-missing"});
  EXPECT_EQ(told.code, 0) << told.err;
  EXPECT_THAT(told.err, HasSubstr("note: frame 4 of 12 is missing"));
  EXPECT_THAT(told.err, HasSubstr("11 frames on"));
  EXPECT_THAT(Sheet({"--frames", "5-12x2"}).err, HasSubstr("4 frames on"));
  ASSERT_EQ(Render({"--frames", "4"}).code, 0);
  EXPECT_THAT(Sheet().err, HasSubstr("12 frames on"));
}

TEST_F(FramesCliTest, C23_RenderTakesListsAndSteps) {
  const ProgramRun run = Render({"--frames", "1-11x4,6,5-6", "--json"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["frames"], "1,5-6,9");
  EXPECT_EQ(Pictures(), (std::vector<std::string>{"tiny.0001.png", "tiny.0005.png", "tiny.0006.png",
                                                  "tiny.0009.png"}));
  for (std::vector<std::string> command :
       std::vector<std::vector<std::string>>{{"render", scene_, "-o", out_},
                                             {"submit", scene_},
                                             {"fetch", "7", "-o", out_},
                                             {"movie", out_, "-o", "m.mp4"},
                                             {"sheet", out_, "-o", "s.png"}}) {
    command.insert(command.end(), {"--frames", "1-10,12-"});
    const ProgramRun wrong = RunFjord(command);
    EXPECT_EQ(wrong.code, 2) << command[0];
    EXPECT_THAT(wrong.err, HasSubstr("--frames 1-10,12-: character 9: the last frame is missing"))
        << command[0];
  }
}

TEST_F(FramesCliTest, FramesOfAnOlderVersionOfTheSceneAreNotMixedWithNewOnes) {
  ASSERT_EQ(Render({}).code, 0);
  const std::string before = ReadAll(out_ + "/manifest.json");
  const std::vector<std::string> change = {"--frames", "1-6", "--set",
                                           "objects[b].shape.primitive.radius=2"};
  const ProgramRun refused = Render(change);
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err,
              HasSubstr(out_ + ": error: the folder holds frames 1-12 of an older version"));
  EXPECT_THAT(refused.err, HasSubstr("--replace"));
  EXPECT_EQ(ReadAll(out_ + "/manifest.json"), before);

  std::vector<std::string> replace = change;
  replace.push_back("--replace");
  const ProgramRun replaced = Render(replace);
  EXPECT_EQ(replaced.code, 0) << replaced.err;
  EXPECT_THAT(replaced.err, HasSubstr("6 frames rendered"));
  // The files of the older version are still there, and are no frames of this one.
  EXPECT_EQ(Pictures().size(), 12u);
  EXPECT_THAT(Sheet().err, HasSubstr("frames 7-12 of 12 are missing"));
}

TEST_F(FramesCliTest, AChangeThatLeavesThePicturesKeepsThem) {
  ASSERT_EQ(Render({}).code, 0);
  const ProgramRun longer = Render({"--set", "output.rate=30"});
  EXPECT_EQ(longer.code, 0) << longer.err;
  EXPECT_THAT(longer.err, HasSubstr("0 frames rendered, 12 were there already"));
}

TEST_F(FramesCliTest, PicturesThatNoManifestNamesAreNotWrittenOver) {
  ASSERT_EQ(Render({"--frames", "3"}).code, 0);
  fs::remove(out_ + "/manifest.json");
  const std::string picture = ReadAll(out_ + "/tiny.0003.png");
  const ProgramRun refused = Render({"--size", "33x17"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("the folder holds pictures of this name, 3, and no manifest"));
  EXPECT_EQ(ReadAll(out_ + "/tiny.0003.png"), picture);
  EXPECT_EQ(Render({"--size", "33x17", "--replace"}).code, 0);
}

TEST_F(FramesCliTest, AFrameOfAnotherProgramIsNotTakenForTheManifests) {
  ASSERT_EQ(Render({}).code, 0);
  fs::copy_file(out_ + "/tiny.0007.png", out_ + "/tiny.0008.png",
                fs::copy_options::overwrite_existing);
  const ProgramRun run = Sheet();
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.err,
              HasSubstr("tiny.0008.png: error: this is not the picture that manifest.json"));
  EXPECT_EQ(Sheet({"--allow-mixed"}).code, 0);
}

TEST_F(FramesCliTest, PicturesOfTwoSizesAreNoSheetUnlessTold) {
  ASSERT_EQ(Render({"--frames", "1"}).code, 0);
  const std::string large = folder_ / "large";
  ASSERT_EQ(RunFjord({"render", scene_, "-o", large, "--frames", "2", "--size", "200%"}).code, 0);
  fs::copy_file(large + "/tiny.0002.png", out_ + "/tiny.0002.png");
  fs::remove(out_ + "/manifest.json");
  EXPECT_THAT(Sheet().err, HasSubstr("the picture is 130x66, the first one 65x33"));
  EXPECT_EQ(Sheet({"--allow-mixed"}).code, 0);
}

TEST_F(FramesCliTest, SizesAndSamplesAreWordsOfTheCommandLine) {
  ASSERT_EQ(Render({"--frames", "1", "--size", "50%", "--samples", "1"}).code, 0);
  const auto manifest = nlohmann::json::parse(ReadAll(out_ + "/manifest.json"));
  const auto& output = manifest["scene"]["parameters"]["output"];
  EXPECT_EQ(output["width"], 33);
  EXPECT_EQ(output["height"], 17);
  EXPECT_EQ(output["samples"], 1);
  EXPECT_EQ(RunFjord({"render", scene_, "-o", out_, "--samples", "3"}).code, 2);
  EXPECT_EQ(RunFjord({"render", scene_, "-o", out_, "--size", "0%"}).code, 2);
}

TEST_F(FramesCliTest, CheckTakesTheChangesThatRenderTakes) {
  EXPECT_EQ(RunFjord({"check", scene_}).out, scene_ + ": good\n");
  const ProgramRun run = RunFjord({"check", scene_, "--set", "output.width=99999"});
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.out, HasSubstr("--set output.width=99999: error: "));
}

TEST_F(FramesCliTest, C36_AFrameThatNeverEndsMeetsItsLimit) {
  const std::string endless = std::string(FJORD_SOURCE_DIR) + "/tests/cases/36.scene";
  const ProgramRun run =
      RunFjord({"render", endless, "-o", out_, "--frame-limit", "0.5", "--budget", "unlimited"});
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.err, HasSubstr("frame 1 took longer than its 0.5 s (--frame-limit)"));
}

// Their pictures have their own names, so that neither is taken for the other's.
TEST_F(FramesCliTest, ScenesNamedInAnyScriptKeepTheirNames) {
  for (const char* name : {"\u5c71", "\u6d77", "my shot", "my_shot", "caf\u00e9"}) {
    const std::string file = folder_.Write(std::string(name) + ".scene",
                                           "output { width: 8 height: 8 frames: 1 }\n"
                                           "objects { shape { primitive { kind: BOX } } }\n");
    const std::string out = folder_ / (std::string("out ") + name);
    const ProgramRun run = RunFjord({"render", file, "-o", out});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_TRUE(fs::exists(out + "/" + name + ".0001.png")) << name;
    const ProgramRun other = RunFjord({"render", file, "-o", folder_ / "shared"});
    EXPECT_EQ(other.code, name == std::string("\u5c71") ? 0 : 1) << name;
  }
  const std::string long_name(210, 'x');
  const std::string file = folder_.Write(long_name + ".scene", "objects { }");
  EXPECT_THAT(RunFjord({"check", file}).out, HasSubstr("cannot be a scene's name"));
  const ProgramRun named = RunFjord({"check", scene_, "--set", "name=a/b"});
  EXPECT_THAT(named.out, HasSubstr("\"a/b\" cannot be a scene's name"));
}

// Names that could be commands to a terminal, in every place where they are shown.
TEST_F(FramesCliTest, NothingThatIsPrintedCommandsATerminal) {
  const std::string evil = "a\033[2J\u009b2J\u202eb";
  const std::string file = folder_.Write(evil + ".scene", "objects {");
  for (const auto& command :
       std::vector<std::vector<std::string>>{{"check", file},
                                             {"check", file, "--json"},
                                             {"render", file, "-o", out_},
                                             {"render", scene_, "-o", out_, "--set", evil + "=1"},
                                             {"sheet", folder_ / evil, "-o", folder_ / "s.png"},
                                             {"digest", folder_ / evil},
                                             {"status", evil, "--server", "127.0.0.1:1"}}) {
    const ProgramRun run = RunFjord(command);
    EXPECT_NE(run.code, 0) << command[0];
    for (const char* control : {"\033", "\u009b", "\u202e"})
      EXPECT_THAT(run.out + run.err, Not(HasSubstr(control))) << command[0];
  }
  EXPECT_THAT(RunFjord({"check", file}).out, HasSubstr("a\\u001b[2J\\u009b2J\\u202eb.scene"));
}

}  // namespace
}  // namespace fjord::testing
