// What `render` refuses `check` finds, in the same words, and what `check` calls good is rendered.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/client/run_program.h"

namespace fjord {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::ProgramRun;
using testing::RunFjord;
using testing::ScratchFolder;

constexpr char kTetrahedron[] =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
constexpr char kGrid[] = "objects { name: \"g\" shape { primitive { kind: GRID } } fractal {} }";
constexpr char kSmall[] = "output { width: 48 height: 32 samples: 1 frames: 3 }\n";

struct Case {
  const char* what;
  std::string text;
  std::string says;  // part of the error; empty: a good scene
};

std::vector<Case> Cases() {
  const std::string small = kSmall, grid = kGrid;
  return {
      {"good", small + grid, ""},
      {"good shape file", small + "objects { shape { file { path: \"t.obj\" } } }", ""},
      {"good, moved",
       small + grid +
           " track { path: \"camera.fov\" key { frame: 1 value: 20 } "
           "key { frame: 3 value: 60 } }",
       ""},
      {"good, ADAPTIVE from far",
       small + "camera { projection: ORTHOGRAPHIC } objects { shape { "
               "primitive { kind: GRID } } fractal { split: ADAPTIVE } }",
       ""},
      {"syntax", small + "objects {", "has no }"},
      {"unknown field", small + "objects { shap {} }", "shap"},
      {"no objects", small, "no objects"},
      {"range", small + "objects { shape { primitive { kind: GRID } } fractal { H: 1.5 } }", "H"},
      {"missing file", small + "objects { shape { file { path: \"gone.obj\" } } }", "gone.obj"},
      {"broken file", small + "objects { shape { file { path: \"broken.obj\" } } }",
       "broken.obj:3"},
      {"layers of PNG", "output { layers: DEPTH }" + grid, "EXR"},
      {"camera without a view", small + "camera { eye {} look_at {} }" + grid, "one place"},
      {"camera that goes blind",
       small + "camera { eye { y: -3 z: 1 } look_at {} up { z: 1 } } " + grid +
           " track { path: \"camera.eye\" key { frame: 1 value: [0, -3, 1] } "
           "key { frame: 3 value: [0, 0, 4] } }",
       "frame 3"},
      {"method of another kind",
       small + "objects { shape { primitive { kind: GRID } } "
               "fractal { method: \"curve\" } }",
       "curves"},
      {"no colours",
       small + "objects { shape { primitive { kind: GRID } } material { "
               "vertex_color: true } }",
       "vertex_color"},
      {"keys that differ",
       small + "objects { key { frame: 1 shape { primitive { kind: GRID } } } "
               "key { frame: 3 shape { primitive { kind: GRID segments: 3 } } } }",
       "key[2]"},
      {"ramp out of order at a key, far from the frames of an even choice",
       "output { width: 48 height: 32 samples: 1 frames: 1000 } objects { name: \"g\" shape { "
       "primitive { kind: GRID } } material { ramp { height: 0 } ramp { height: 1 } } } "
       "track { path: \"objects[g].material.ramp[1].height\" key { frame: 499 value: 0 } "
       "key { frame: 500 value: 3 } key { frame: 501 value: 0 } }",
       "frame 500"},
      {"line too wide for the picture",
       "output { width: 64 height: 9000 samples: 1 } objects { shape { "
       "polyline { point {} point { x: 1 } } } material { line_width: 900 } }",
       "line_width"},
      {"shadow too fine",
       small + grid +
           " lights { direction { x: 1 z: 1 } shadow: true "
           "shadow_detail: 1e-7 }",
       "shadow_detail"},
      {"too much",
       small + "objects { shape { primitive { kind: GRID } } fractal { epsilon: 1e-9 "
               "max_level: 40 } }",
       "budget"},
      {"too much at a key",
       small + grid +
           " track { path: \"objects[g].fractal.pixels\" "
           "key { frame: 1 value: 1 } key { frame: 2 value: 1e-6 } "
           "key { frame: 3 value: 1 } }",
       "budget"},
  };
}

std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

TEST(CheckRenderTest, CheckAndRenderGiveTheSameVerdict) {
  const ScratchFolder folder;
  folder.Write("t.obj", kTetrahedron);
  folder.Write("broken.obj", "v 0 0 0\nv 1 0 0\nf 1 2 7\n");
  int number = 0;
  for (const Case& scene : Cases()) {
    const std::string path = folder.Write("s.scene", scene.text);
    const ProgramRun check = RunFjord({"check", path});
    const ProgramRun render =
        RunFjord({"render", path, "-o", folder / ("out" + std::to_string(++number))});
    EXPECT_EQ(render.code, scene.says.empty() ? 0 : 1) << scene.what << '\n' << render.err;
    EXPECT_EQ(check.code, render.code) << scene.what << '\n' << check.out << render.err;
    if (scene.says.empty()) continue;
    EXPECT_THAT(check.out, HasSubstr(scene.says)) << scene.what;
    EXPECT_THAT(check.out, HasSubstr(FirstLine(render.err))) << scene.what;
    EXPECT_THAT(FirstLine(check.out), HasSubstr("error: ")) << scene.what;
  }
}

// Defects that render can live with are found as for the file alone, each with its line.
TEST(CheckRenderTest, DefectsOfTheShapesThatASceneNamesAreFound) {
  const ScratchFolder folder;
  const std::string shape =
      folder.Write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nf 1 2 3\nf 1 4 2\n");
  const ProgramRun alone = RunFjord({"check", shape});
  EXPECT_EQ(alone.code, 1);
  const std::string scene =
      folder.Write("s.scene", std::string(kSmall) +
                                  "objects { name: \"a\" shape { file { path: \"bad.obj\" } } }\n"
                                  "objects { name: \"b\" shape { file { path: \"bad.obj\" } } }");
  const ProgramRun check = RunFjord({"check", scene});
  EXPECT_EQ(check.code, 1);
  EXPECT_EQ(check.out, alone.out) << "each once, in the same words";
  EXPECT_THAT(check.out, HasSubstr("bad.obj:4:1: error: "));
  const ProgramRun json = RunFjord({"check", "--json", scene});
  EXPECT_THAT(json.out, HasSubstr("bad.obj\""));
  EXPECT_THAT(json.out, HasSubstr("\"line\": 4"));
}

// That a file can not be read is said where defects are, and the others are still checked.
TEST(CheckRenderTest, FilesThatCanNotBeReadStopNoOther) {
  const ScratchFolder folder;
  const std::string good = folder.Write("s.scene", std::string(kSmall) + kGrid);
  const std::string gone = folder / "gone.scene";
  const ProgramRun run = RunFjord({"check", gone, folder.path(), good});
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.out, HasSubstr(gone + ": error: there is no such file"));
  EXPECT_THAT(run.out, HasSubstr("this is a folder"));
  EXPECT_THAT(run.out, HasSubstr(good + ": good\n"));
  const ProgramRun json = RunFjord({"check", "--json", gone, good});
  EXPECT_EQ(json.code, 1);
  EXPECT_THAT(json.out, HasSubstr("there is no such file"));
}

// A flight that ends just over the ground: fine all along under SHOT, by the frame under ADAPTIVE.
TEST(CheckRenderTest, AFlyInIsToldToSplitByTheFrame) {
  const ScratchFolder folder;
  const std::string scene =
      folder.Write("fly.scene",
                   "output { width: 480 height: 270 frames: 12 }\n"
                   "objects { name: \"r\" shape { primitive { kind: GRID size { x: 20 y: 20 } } }\n"
                   "  fractal { amplitude: 0.3 } }\n"
                   "camera { look_at { y: 6 z: 1.2 } }\n"
                   "track { path: \"camera.eye\" key { frame: 1 value: [0, -30, 14] } "
                   "key { frame: 12 value: [0, 0, 0.15] } }\n");
  const ProgramRun good = RunFjord({"check", scene, "--budget", "1e13"});
  EXPECT_EQ(good.code, 0);
  EXPECT_THAT(good.err, HasSubstr("fly.scene:3:3: note: frame "));
  EXPECT_THAT(good.err, HasSubstr("split: ADAPTIVE"));
  const ProgramRun json = RunFjord({"check", "--json", scene, "--budget", "1e13"});
  EXPECT_THAT(json.out, HasSubstr("\"advice\": "));
  const ProgramRun refused = RunFjord({"check", scene, "--budget", "1e8"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.out, HasSubstr("split: ADAPTIVE, by each frame's own camera, would make"));
  const ProgramRun adaptive =
      RunFjord({"check", scene, "--set", "objects[r].fractal.split=ADAPTIVE", "--budget", "1e8"});
  EXPECT_EQ(adaptive.code, 0) << adaptive.out;
  EXPECT_THAT(adaptive.err, Not(HasSubstr("split: ADAPTIVE")));
}

}  // namespace
}  // namespace fjord
