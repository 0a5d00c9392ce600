// Libraries that leave the floating-point environment spoiled change no key and no pixel (D1).
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/client/run_program.h"

namespace fjord::testing {
namespace {

// Roundings of every kind that a frame goes through: decimal numbers that are no binary ones,
// tracks, fractals, light, a sea, a filled curve.
constexpr char kScene[] = R"(
name: "rounded"
output { width: 192 height: 108 frames: 2 samples: 4 format: EXR_FLOAT }
camera { eye { x: 0.3 y: -2.2 z: 1.3 } look_at { x: 0.1 y: 0.1 } fov: 43.7 }
sea { level: -0.03 color { r: 0.02 g: 0.07 b: 0.13 } specular: 0.3 shininess: 37.3 }
lights { name: "sun" direction { x: 0.7 y: -0.5 z: 0.9 } color { r: 0.9 g: 0.8 b: 0.7 } }
objects {
  name: "hill"
  shape { primitive { kind: GRID size { x: 2.3 y: 2.1 } segments: 2 rings: 2 } }
  fractal { method: "surface" seed: 5 H: 0.7 amplitude: 0.3 pixels: 3 }
  transform { rotate { x: 1 y: 2 z: 3 } }
  material { specular: 0.1 shininess: 11.1 color { r: 0.4 g: 0.5 b: 0.3 } }
}
objects {
  name: "lake"
  shape { polyline { closed: true point { x: -0.7 y: -0.9 z: 0.3 } point { x: 0.3 y: -0.7 z: 0.3 } point { x: 0.1 y: 0.1 z: 0.3 } } }
  fractal { method: "curve" seed: 6 H: 0.8 pixels: 3 }
  material { fill: true color { r: 0.1 g: 0.2 b: 0.9 } }
}
track { path: "objects[hill].fractal.H" key { frame: 1 value: 0.37 } key { frame: 2 value: 0.81 } }
)";

TEST(FloatEnvironmentTest, D1_SpoiledByLibrariesChangesNothing) {
  const ScratchFolder folder;
  const std::string scene = folder.Write("rounded.scene", kScene);
  // Keys and digests of all frames.
  const auto render = [&](const std::string& how, const std::string& threads) {
    const std::string out = folder / (how + threads);
    ProgramOptions options;
    options.environment = {"LD_PRELOAD=" FJORD_SPOIL_FLOATS, "FJORD_SPOIL=" + how};
    const ProgramRun run =
        RunFjordAnew({"render", scene, "-o", out, "--threads", threads}, options);
    EXPECT_EQ(run.code, 0) << run.err;
    std::string made;
    const auto manifest = nlohmann::json::parse(ReadAll(out + "/manifest.json"), nullptr, false);
    if (manifest.is_discarded()) return made;
    for (const auto& frame : manifest["frames"]) {
      made += frame["frame_key"].get<std::string>() + ' ' +
              frame["pixel_digest"].get<std::string>() + '\n';
    }
    return made;
  };
  const std::string wanted = render("not", "1");
  ASSERT_EQ(wanted.size(), 2 * 130u) << wanted;
  for (const char* how : {"up", "down", "zero", "flush", "x87"}) {
    EXPECT_EQ(render(how, "1"), wanted) << how;
    EXPECT_EQ(render(how, "3"), wanted) << how << ", 3 threads";
  }
}

}  // namespace
}  // namespace fjord::testing
