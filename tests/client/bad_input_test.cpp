// Bad input: one clear message that names place and remedy, the documented exit code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/client/run_program.h"

namespace fjord::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

class BadInputTest : public ::testing::Test {
 protected:
  // The scene must be refused by `check` and `render` alike, with exit code 1 and a message on
  // `place`.
  void ExpectRefused(const std::string& text, const std::string& place, const std::string& says) {
    const std::string file = folder_.Write("bad.scene", text);
    const ProgramRun check = RunFjord({"check", file});
    const ProgramRun render = RunFjord({"render", file, "-o", folder_ / "out"});
    EXPECT_EQ(check.code, 1) << text;
    EXPECT_EQ(render.code, 1) << text;
    // Defects are what `check` is asked for.
    EXPECT_EQ(check.err, "") << text;
    EXPECT_EQ(render.out, "") << text;
    for (const std::string& said : {check.out, render.err}) {
      EXPECT_THAT(said, HasSubstr("bad.scene" + place)) << text;
      EXPECT_THAT(said, HasSubstr("error: ")) << text;
      EXPECT_THAT(said, HasSubstr(says)) << text;
    }
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  }

  static std::string WithFractal(const std::string& knobs) {
    return "name: \"x\"\nobjects {\n  name: \"a\"\n  shape { primitive { kind: SPHERE } }\n"
           "  fractal { method: \"surface\" " +
           knobs + " }\n}\n";
  }
  static std::string WithFace(const std::string& face) {
    return "name: \"x\"\nobjects {\n  name: \"a\"\n  shape { mesh {\n"
           "    point { x: 0 } point { x: 1 } point { y: 1 }\n    face { " +
           face + " }\n  } }\n}\n";
  }
  static std::string WithKeys(const std::string& first, const std::string& second) {
    const std::string shape = "shape { primitive { kind: SPHERE } }";
    return "name: \"x\"\noutput { frames: 10 }\nobjects {\n  name: \"a\"\n  key { " + first + " " +
           shape + " }\n  key { " + second + " " + shape + " }\n}\n";
  }

  const ScratchFolder folder_;
};

TEST_F(BadInputTest, FilesThatAreNone) {
  const ProgramRun missing = RunFjord({"render", folder_ / "no.scene", "-o", folder_ / "out"});
  EXPECT_EQ(missing.code, 1);
  EXPECT_THAT(missing.err, HasSubstr("no.scene: error: there is no such file; check the name"));
  ExpectRefused("objects { name: \"a\"\n shape { file { path: \"no.std\" } } }\n", ":2:17",
                "no.std: there is no such file; check the name");
  ExpectRefused("", "", "");
  ExpectRefused("name: \"x\"\nobjects {\n  name: \"a\"\n", ":", "");
  ExpectRefused(std::string("\x7f"
                            "ELF\0\1\2\xff",
                            8),
                ": ", "not a scene");
  EXPECT_EQ(RunFjord({"check", folder_.path()}).code, 1);
}

TEST_F(BadInputTest, FilesOfTwoGigabytes) {
  for (const char* name : {"big.scene", "big.std", "big.obj", "big.ply", "big.png"}) {
    const std::string file = folder_.Write(name, "");
    std::filesystem::resize_file(file, uint64_t{2} << 30);  // sparse
    const ProgramRun run = RunFjord({std::string(name) == "big.png" ? "digest" : "check", file});
    EXPECT_EQ(run.code, 1) << name;
    const std::string said = run.out + run.err;
    EXPECT_THAT(said, HasSubstr(name));
    EXPECT_THAT(said, HasSubstr("2147483648 bytes; at most")) << said;
  }
}

TEST_F(BadInputTest, NumbersThatAreNone) {
  ExpectRefused(WithFractal("sigma: nan"), ":5:", "sigma");
  ExpectRefused(WithFractal("amplitude: inf"), ":5:", "amplitude");
  ExpectRefused(
      "name: \"x\"\ncamera { eye { x: 1e308 } }\nobjects { name: \"a\" shape { primitive { kind: "
      "SPHERE } } }\n",
      ":2:", "");
}

TEST_F(BadInputTest, KnobsOutOfRange) {
  ExpectRefused(WithFractal("H: 1.5"), ":5:", "H");
  ExpectRefused(WithFractal("H: -0.1"), ":5:", "H");
  ExpectRefused(WithFractal("epsilon: 0"), ":5:", "epsilon");
  ExpectRefused(WithFractal("epsilon: -1"), ":5:", "epsilon");
  ExpectRefused(WithFractal("max_level: 1000"), ":5:", "max_level");
  ExpectRefused(WithFractal("nonsense: 1"), ":5:", "nonsense");
}

TEST_F(BadInputTest, IndicesThatLeadNowhere) {
  ExpectRefused(WithFace("v: 0 v: 1 v: 2"), ":6:", "there is no vertex 0");
  ExpectRefused(WithFace("v: 1 v: 2 v: 4"), ":6:", "there is no vertex 4");
  ExpectRefused(WithFace("v: 1 v: 2 v: -3"), ":6:", "");
}

TEST_F(BadInputTest, KeysOutOfOrder) {
  ExpectRefused(WithKeys("frame: 8", "frame: 3"), ":6:", "frame");
  ExpectRefused(WithKeys("frame: 8", "frame: 8"), ":6:", "frame");
}

TEST_F(BadInputTest, CorrespondenceToMissingPoints) {
  ExpectRefused(
      "name: \"x\"\noutput { frames: 5 }\nobjects {\n  name: \"a\"\n  correspondence: BY_PAIRS\n"
      "  key { frame: 1 shape { polyline { point { x: 0 } point { x: 1 } point { y: 1 } closed: "
      "true } } }\n"
      "  key { frame: 5 pair { from: 9 to: 1 }\n"
      "    shape { polyline { point { x: 0 } point { x: 1 } point { y: 1 } closed: true } } }\n}\n",
      ":7:", "9");
}

// More than any machine ever makes: told at once, at the knob, with what would fit.
TEST_F(BadInputTest, ScenesThatNeverEnd) {
  const std::string scene =
      "output { frames: 1 width: 64 height: 64 }\nobjects { name: \"c\"\n  shape { primitive { "
      "kind: GRID } }\n  fractal { epsilon: 1e-9 max_level: 40 } }\n";
  ExpectRefused(scene, ":4:13", "epsilon 1e-09 would make about ");
  ExpectRefused(scene, ":4:13", "the budget is 2e09; 8.7e-05 would fit");
  ExpectRefused(WithFractal("epsilon: 1e-320"), ":5:31", "would make about ");
  const std::string file = folder_.Write("endless.scene", scene);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"fractalize", file, "--frame", "1", "-o", folder_ / "a.ply"},
        {"submit", file, "--server", "127.0.0.1:1"},
        {"render", file, "-o", folder_ / "out", "--set", "objects[c].fractal.epsilon=1e-7"}}) {
    const ProgramRun run = RunFjord(command);
    EXPECT_EQ(run.code, 1) << run.err;
    EXPECT_THAT(run.out + run.err, HasSubstr(" would fit; --budget lifts it")) << command[0];
  }
  const ProgramRun set =
      RunFjord({"render", file, "-o", folder_ / "out", "--set", "objects[c].fractal.epsilon=1e-7"});
  EXPECT_THAT(set.err, HasSubstr("--set objects[c].fractal.epsilon=1e-7: error: "));
  const ProgramRun lifted = RunFjord({"check", file, "--budget", "unlimited"});
  EXPECT_EQ(lifted.code, 0) << lifted.err;
  EXPECT_THAT(lifted.err, HasSubstr("triangles and segments in a frame's picture"));
  EXPECT_EQ(RunFjord({"check", file, "--budget", "-3"}).code, 2);
  EXPECT_EQ(RunFjord({"check", file, "--budget", "many"}).code, 2);
}

// A curve whose every segment is one of 2^40: it ended in std::bad_alloc.
TEST_F(BadInputTest, CurvesThatNeverEnd) {
  const std::string file = folder_.Write(
      "explode.scene",
      "output { frames: 1 }\nobjects { name: \"c\" shape { polyline { point {} point { x: 1 } } } "
      "fractal { epsilon: 1e-9 max_level: 40 } }\n");
  const ProgramRun run = RunFjord({"fractalize", file, "--frame", "1", "-o", folder_ / "a.obj"});
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.err, HasSubstr(" segments in a frame; the budget is 1e08; "));
}

TEST_F(BadInputTest, DevicesThatNeverEnd) {
  std::filesystem::create_symlink("/dev/zero", folder_ / "zero.std");
  const std::string scene = folder_.Write(
      "zero.scene", "objects { name: \"a\" shape { file { path: \"zero.std\" } } }\n");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"check", folder_ / "zero.std"},
        {"check", scene},
        {"measure", folder_ / "zero.std"},
        {"import", folder_ / "zero.std", "-o", folder_ / "made.scene"}}) {
    const ProgramRun run = RunFjord(command);
    EXPECT_EQ(run.code, 1) << command[0] << run.err;
    EXPECT_THAT(run.out + run.err, HasSubstr("this is a device, which may never end"))
        << command[0];
  }
}

TEST_F(BadInputTest, SeveralDefectsAtOnce) {
  const std::string file = folder_.Write("bad.scene", WithFractal("epsilon: -1 pixels: -2"));
  const ProgramRun run = RunFjord({"check", file});
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 3) << run.out;
  EXPECT_THAT(run.out, HasSubstr("give one of epsilon, pixels and viewing"));
}

TEST_F(BadInputTest, FramesOutsideTheAnimation) {
  const std::string file = folder_.Write("tiny.scene", TinyScene(5));
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"render", file, "-o", folder_ / "out", "--frames", "4-6"},
           {"submit", file, "--frames", "4-6", "--server", "127.0.0.1:1"},
           {"preview", file, "--frame", "6", "-o", folder_ / "a.png"},
           {"fractalize", file, "--frame", "6", "-o", folder_ / "a.obj"}}) {
    const ProgramRun run = RunFjord(arguments);
    EXPECT_EQ(run.code, 1) << arguments[0] << run.err;
    EXPECT_THAT(run.err, HasSubstr("1-5")) << arguments[0];
  }
}

TEST_F(BadInputTest, WhatIsNoFileIsNotReplaced) {
  const std::string scene = folder_.Write("tiny.scene", TinyScene(1));
  const std::string pipe = folder_ / "pipe.svg", circle = folder_ / "circle.svg";
  folder_.Write("folder.svg/keep", "");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::filesystem::create_symlink("circle.svg", circle);
  for (const std::string& name : {folder_ / "folder.svg", pipe, circle}) {
    const ProgramRun run = RunFjord({"preview", scene, "--frame", "1", "-o", name});
    EXPECT_EQ(run.code, 1) << name;
    EXPECT_THAT(run.err, HasSubstr(name + ": error: cannot be written: ")) << run.err;
  }
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST_F(BadInputTest, LinksThatGoRoundInCircles) {
  folder_.Write("pictures/a.png", "no picture");
  for (const char* name : {"up", "again"})
    std::filesystem::create_directory_symlink("..", folder_ / (std::string("pictures/") + name));
  const ProgramRun run = RunFjord({"digest", folder_ / "pictures"});
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err.substr(0, 1000);
  std::filesystem::create_symlink("circle.scene", folder_ / "circle.scene");
  EXPECT_THAT(
      RunFjord({"check", folder_ / "circle.scene"}).out,
      HasSubstr("circle.scene: error: cannot be opened: Too many levels of symbolic links"));
}

TEST_F(BadInputTest, ShapesBeyondAllMeasure) {
  folder_.Write("far.std", "far\ndata 3 1\n0 0 0\n1e13 0 0\n0 1 0\n3 1 2 3\n");
  ExpectRefused("objects { name: \"a\"\n shape { file { path: \"far.std\" } } }\n", ":2:2",
                "objects[a].shape: vertex 2 lies beyond 1e12");
  ExpectRefused(
      "objects { name: \"a\" shape { primitive { kind: SPHERE radius: 1e9 } }\n"
      "  transform { scale { x: 1e9 y: 1 z: 1 } } }\n",
      "", "camera.eye: to have everything in view the eye would stand beyond 1e15");
}

TEST_F(BadInputTest, AFolderWithFramesOfAnotherSceneIsLeftAlone) {
  const std::string scene = folder_.Write("tiny.scene", TinyScene(1));
  const std::string out = folder_ / "out";
  ASSERT_EQ(RunFjord({"render", scene, "-o", out}).code, 0);
  const std::string manifest = ReadAll(out + "/manifest.json");
  const ProgramRun other = RunFjord({"render", scene, "-o", out, "--set", "name=other"});
  EXPECT_EQ(other.code, 1);
  EXPECT_THAT(other.err,
              HasSubstr(out + ": error: the folder holds frames of another scene, tiny"));
  EXPECT_THAT(other.err, HasSubstr("name another folder with -o"));
  EXPECT_EQ(ReadAll(out + "/manifest.json"), manifest);
}

TEST_F(BadInputTest, ShapesWithDefectsAreNamedByLine) {
  const std::string file = folder_.Write(
      "bad.std",
      "a square, one face turned over\ndata 4 2\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 1 2 3\n3 1 4 3\n");
  const ProgramRun run = RunFjord({"check", file});
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.out, MatchesRegex("(.|\n)*bad.std:[78]:1: error: (.|\n)*"));
  const std::string past = folder_.Write("past.std", "data 3 1\n0 0 0\n1 0 0\n0 1 0\n3 1 2 9\n");
  EXPECT_THAT(RunFjord({"check", past}).out, HasSubstr("past.std:5:"));
  const std::string par = folder_.Write("bad.par", "parameters\nH-Fdim 1.5\n");
  EXPECT_EQ(RunFjord({"check", par}).code, 1);
}

TEST_F(BadInputTest, PicturesThatAreNone) {
  const std::string file = folder_.Write("bad.png", "no picture");
  const ProgramRun run = RunFjord({"digest", file});
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.err, HasSubstr("bad.png"));
  EXPECT_EQ(RunFjord({"digest", folder_ / "missing.png"}).code, 1);
  EXPECT_EQ(RunFjord({"sheet", folder_.path(), "-o", folder_ / "s.png"}).code, 1);
  EXPECT_EQ(RunFjord({"movie", folder_ / "none/such", "-o", folder_ / "m.mp4"}).code, 1);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "m.mp4"));
}

}  // namespace
}  // namespace fjord::testing
