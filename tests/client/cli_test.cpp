// The program as a user meets it: usage, help, exit codes, JSON.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/client/run_program.h"

namespace fjord::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

nlohmann::json JsonOf(const ProgramRun& run) {
  nlohmann::json json = nlohmann::json::parse(run.out, nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << run.out << run.err;
  return json;
}

const char* const kCommands[] = {"render", "preview",  "fractalize", "check",  "measure", "import",
                                 "digest", "presets",  "sheet",      "movie",  "submit",  "status",
                                 "watch",  "fetch",    "jobs",       "cancel", "pause",   "resume",
                                 "retry",  "priority", "workers",    "farm"};

TEST(CliTest, EveryCommandHasHelpWithExamples) {
  const ProgramRun all = RunFjord({"--help"});
  EXPECT_EQ(all.code, 0);
  for (const char* command : kCommands) {
    EXPECT_THAT(all.out, HasSubstr(command));
    const ProgramRun help = RunFjord({command, "--help"});
    EXPECT_EQ(help.code, 0) << command;
    EXPECT_THAT(help.out, HasSubstr(std::string("  fjord ") + command)) << command;
    EXPECT_EQ(help.err, "") << command;
  }
}

TEST(CliTest, WrongUsageIsCode2AndOneLine) {
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"paint"},
      {"render"},
      {"render", "a.scene"},
      {"render", "a.scene", "-o", "x", "--threads", "-1"},
      {"render", "a.scene", "-o", "x", "--frames", "9-3"},
      {"render", "a.scene", "-o", "x", "--size", "big"},
      {"render", "a.scene", "-o", "x", "--set", "nothing"},
      {"submit", "a.scene", "--priority", "2000"},
      {"submit", "a.scene", "--verify", "2"},
      {"preview", "a.scene", "--frame", "1", "-o", "a.gif"},
      {"fractalize", "a.scene", "--frame", "1", "-o", "a.gif"},
      {"movie", "out", "-o", "a.gif"},
      {"sheet", "out", "-o", "a.jpg"},
      {"fractalize", "a.scene", "--frame", "0", "-o", "a.obj"},
      {"presets", "nothing"},
      {"digest"},
      {"status"},
      {"status", "1", "--unknown"},
  };
  for (const auto& arguments : wrong) {
    const ProgramRun run = RunFjord(arguments);
    std::string line;
    for (const std::string& argument : arguments) line += " " + argument;
    EXPECT_EQ(run.code, 2) << line << "\n" << run.err;
    EXPECT_EQ(run.out, "") << line;
    EXPECT_THAT(run.err, HasSubstr("error: ")) << line;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << line << "\n" << run.err;
  }
}

TEST(CliTest, CheckAnimationTellsWhetherAnythingPops) {
  const ScratchFolder folder;
  const std::string good = folder.Write("good.scene", TinyScene(5));
  const ProgramRun calm = RunFjord({"check", "--animation", good});
  EXPECT_EQ(calm.code, 0) << calm.err;
  EXPECT_THAT(calm.err, HasSubstr("good.scene: object hill: the same vertices in every frame"));
  EXPECT_EQ(JsonOf(RunFjord({"check", "--animation", "--json", good}))[0]["animation"][0]["good"],
            true);
  // a line whose plane tumbles over
  const std::string text =
      "output { width: 64 height: 48 frames: 20 }\nobjects { name: \"bolt\"\n"
      "key { frame: 1 shape { polyline { point {} point { x: 1 y: 1 } point { x: 2 } } } }\n"
      "key { frame: 10 shape { polyline { point {} point { x: 1 y: .1 z: 1 } point { x: 2 } } } }\n"
      "key { frame: 20 shape { polyline { point {} point { x: 1 y: -1 } point { x: 2 } } } }\n"
      "fractal { epsilon: .1 } }\n";
  const std::string pops = folder.Write("pops.scene", text);
  const ProgramRun wild = RunFjord({"check", "--animation", pops});
  EXPECT_EQ(wild.code, 1);
  EXPECT_THAT(wild.out, HasSubstr("pops.scene: error: object bolt: a vertex pops between frames 10 "
                                  "and 11"));
  EXPECT_THAT(wild.out, HasSubstr("use direction: UP"));
  const ProgramRun json = RunFjord({"check", "--animation", "--json", pops});
  EXPECT_EQ(json.code, 1);
  EXPECT_EQ(JsonOf(json)[0]["animation"][0]["good"], false);
  // as the message advises
  std::string calmed = text;
  calmed.replace(calmed.find("epsilon"), 0, "direction: UP ");
  EXPECT_EQ(RunFjord({"check", "--animation", folder.Write("up.scene", calmed)}).code, 0);
  EXPECT_EQ(RunFjord({"check", pops}).code, 0) << "a scene without defects otherwise";
}

TEST(CliTest, PictureLibrariesAreLoadedWhenAPictureIsReadOrWritten) {
  // the programs themselves are linked with none, so that farm commands start in no time
  for (const char* program : {FJORD_PROGRAM, FJORD_WORKER_PROGRAM, FJORD_SERVER_PROGRAM}) {
    const ProgramRun libraries = RunProgram({"ldd", program});
    EXPECT_EQ(libraries.code, 0) << libraries.err;
    EXPECT_THAT(libraries.out, Not(HasSubstr("OpenImageIO"))) << program;
  }
  // installed, they find their module; without it they say so
  const ScratchFolder folder;
  const std::string scene = folder.Write("tiny.scene", TinyScene(1));
  folder.Write("bin/keep", "");
  const std::string program = folder / "bin/fjord", module = "lib/fjord/fjord_picture_files.so";
  std::filesystem::copy_file(FJORD_PROGRAM, program);
  const ProgramRun missing = RunProgram({program, "render", scene, "-o", folder / "out"});
  EXPECT_EQ(missing.code, 1);
  EXPECT_THAT(missing.err, AllOf(HasSubstr(folder / module), HasSubstr("install Fjord anew")));
  folder.Write(module, "no module");
  const ProgramRun broken = RunProgram({program, "render", scene, "-o", folder / "out"});
  EXPECT_EQ(broken.code, 1);
  EXPECT_THAT(broken.err, HasSubstr(folder / module + ": error: cannot be used"));
  std::filesystem::copy_file(FJORD_PICTURE_FILES, folder / module,
                             std::filesystem::copy_options::overwrite_existing);
  const ProgramRun whole = RunProgram({program, "render", scene, "-o", folder / "out"});
  EXPECT_EQ(whole.code, 0) << whole.err;
}

TEST(CliTest, TheProgramItselfRuns) {
  const ProgramRun run = RunProgram({FJORD_PROGRAM, "--version"});
  EXPECT_EQ(run.code, 0);
  EXPECT_THAT(run.out, StartsWith("fjord "));
}

TEST(CliTest, JsonIsOneDocumentAloneOnStdout) {
  const ScratchFolder folder;
  const std::string scene = folder.Write("tiny.scene", TinyScene(2));
  const auto rendered = JsonOf(RunFjord({"render", scene, "-o", folder / "out", "--json"}));
  EXPECT_EQ(rendered["rendered"], 2);
  EXPECT_EQ(JsonOf(RunFjord({"digest", folder / "out", "--json"})).size(), 2u);
  EXPECT_EQ(JsonOf(RunFjord({"check", scene, "--json"}))[0]["good"], true);
  EXPECT_GE(JsonOf(RunFjord({"presets", "--json"}))["fractal"].size(), 3u);
  EXPECT_EQ(JsonOf(RunFjord({"presets", "surface", "--json"}))["name"], "surface");
  const auto measured = JsonOf(RunFjord({"measure", Example("data/taiwan.std"), "--json"}));
  EXPECT_EQ(measured["mesh.vertices"], 101);
  folder.Write("bad.scene", "name: \"x\"\nnonsense: 3\n");
  const ProgramRun bad = RunFjord({"check", folder / "bad.scene", "--json"});
  EXPECT_EQ(bad.code, 1);
  EXPECT_EQ(JsonOf(bad)[0]["defects"][0]["line"], 2);
  const auto manifest = nlohmann::json::parse(ReadAll(folder / "out/manifest.json"));
  EXPECT_EQ(manifest["frames"].size(), 2u);
}

TEST(CliTest, PresetsShowRangeDefaultAndEffectOfEveryKnob) {
  const ProgramRun run = RunFjord({"presets"});
  EXPECT_EQ(run.code, 0);
  for (const char* word : {"surface", "coast", "curve", "H ", "0 .. 1", "smoother", "PNG16",
                           "SMOOTH", "DIRECTIONAL", "TORUS"})
    EXPECT_THAT(run.out, HasSubstr(word));
}

TEST(CliTest, ImportWritesASceneThatRenders) {
  const ScratchFolder folder;
  folder.Write("shape.std", ReadAll(Example("data/taiwan.std")));
  const std::string scene = folder / "sub folder/taiwan.scene";
  folder.Write("sub folder/keep", "");
  EXPECT_EQ(RunFjord({"import", folder / "shape.std", "-o", scene}).code, 0);
  EXPECT_THAT(ReadAll(scene), HasSubstr("../shape.std"));
  const ProgramRun run = RunFjord({"render", scene, "-o", folder / "out", "--size", "64x64"});
  EXPECT_EQ(run.code, 0) << run.err;
}

TEST(CliTest, ImportWritesOverNothingUnlessTold) {
  const ScratchFolder folder;
  const std::string shape = folder.Write("shape.std", ReadAll(Example("data/taiwan.std")));
  const std::string scene = folder.Write("mine.scene", "# my own work\n");
  const ProgramRun refused = RunFjord({"import", shape, "-o", scene});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("mine.scene"), HasSubstr("--force")));
  EXPECT_EQ(ReadAll(scene), "# my own work\n");
  EXPECT_EQ(RunFjord({"import", shape, "-o", scene, "--force"}).code, 0);
  EXPECT_THAT(ReadAll(scene), HasSubstr("method: \"coast\""));
  const ProgramRun itself = RunFjord({"import", shape, "-o", shape, "--force"});
  EXPECT_EQ(itself.code, 1);
  EXPECT_EQ(ReadAll(shape), ReadAll(Example("data/taiwan.std")));
}

TEST(CliTest, ImportTurnsTheAxisThatIsUp) {
  const ScratchFolder folder;
  const std::string shape = folder.Write(
      "hill.obj",
      "v 0 0 0\nv 0 0 4\nv 4 0 4\nv 4 0 0\nv 2 1 2\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
  const ProgramRun asked = RunFjord({"import", shape, "-o", folder / "z.scene"});
  EXPECT_EQ(asked.code, 0);
  EXPECT_THAT(asked.err, HasSubstr("--up y"));
  const ProgramRun turned = RunFjord({"import", shape, "--up", "Y", "-o", folder / "y.scene"});
  EXPECT_EQ(turned.code, 0) << turned.err;
  EXPECT_EQ(turned.err.find("--up"), std::string::npos);
  EXPECT_THAT(ReadAll(folder / "y.scene"), HasSubstr(" up: Y"));
  const std::string made = folder / "made.obj";
  EXPECT_EQ(RunFjord({"fractalize", folder / "y.scene", "--frame", "1", "-o", made}).code, 0);
  EXPECT_THAT(ReadAll(made), HasSubstr("\nv 2 -2 1\n"));
  EXPECT_EQ(RunFjord({"import", shape, "--up", "w", "-o", folder / "w.scene"}).code, 2);
}

TEST(CliTest, C47_FractalizeRecordsSeedAndParameters) {
  const ScratchFolder folder;
  const std::string scene = folder.Write("tiny.scene", TinyScene(2));
  for (const char* ending : {"obj", "ply", "std", "svg", "epf"}) {
    const std::string file = folder / (std::string("hill.") + ending);
    const ProgramRun run = RunFjord({"fractalize", scene, "--frame", "2", "-o", file});
    EXPECT_EQ(run.code, 0) << ending << run.err;
    EXPECT_THAT(ReadAll(file).substr(0, 4000), AllOf(HasSubstr("seed"), HasSubstr("frame")))
        << ending;
    if (std::string(ending) != "svg") {
      EXPECT_EQ(RunFjord({"check", file}).code, 0) << ending;
    }
  }
}

TEST(CliTest, S26_PreviewIsDrawnAndTheCapIsSaid) {
  const ScratchFolder folder;
  const std::string scene = folder.Write("tiny.scene", TinyScene(2));
  const ProgramRun whole = RunFjord({"preview", scene, "--frame", "1", "-o", folder / "a.svg"});
  EXPECT_EQ(whole.code, 0) << whole.err;
  EXPECT_THAT(whole.err, Not(HasSubstr("coarser")));
  EXPECT_THAT(ReadAll(folder / "a.svg"), HasSubstr("<svg"));
  const ProgramRun capped = RunFjord({"preview", scene, "--frame", "1", "-o", folder / "a.png",
                                      "--edges", "100", "--set", "objects[hill].fractal.pixels=1"});
  EXPECT_EQ(capped.code, 0) << capped.err;
  EXPECT_THAT(capped.err, HasSubstr("times coarser than the picture"));
  EXPECT_EQ(RunFjord({"digest", folder / "a.png"}).code, 0);
}

TEST(CliTest, SheetAndMovieOfAFolder) {
  const ScratchFolder folder;
  const std::string scene = folder.Write("tiny.scene", TinyScene(5));
  ASSERT_EQ(RunFjord({"render", scene, "-o", folder / "out"}).code, 0);
  const ProgramRun sheet =
      RunFjord({"sheet", folder / "out", "-o", folder / "sheet.png", "--columns", "3"});
  EXPECT_EQ(sheet.code, 0) << sheet.err;
  EXPECT_THAT(sheet.err, HasSubstr("5 frames"));
  const ProgramRun movie = RunFjord({"movie", folder / "out", "-o", folder / "a movie.mp4"});
  EXPECT_EQ(movie.code, 0) << movie.err;
  EXPECT_EQ(ReadAll(folder / "a movie.mp4").substr(4, 4), "ftyp");
  const ProgramRun probe = RunProgram({"ffprobe", "-v", "error", "-count_frames", "-show_entries",
                                       "stream=nb_read_frames,pix_fmt,codec_name", "-of", "csv=p=0",
                                       folder / "a movie.mp4"});
  EXPECT_EQ(probe.out, "h264,yuv420p,5\n") << probe.err;
}

}  // namespace
}  // namespace fjord::testing
