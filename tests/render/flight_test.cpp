// A flight through the demo's island under split ADAPTIVE does not flicker: between two cameras
// that are next to one another no pixel changes but by a sample that lies on an edge.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "tests/animation/animate.h"
#include "tests/render/scenes.h"

namespace fjord {
namespace {

using testing::Animate;
using testing::FrameOf;

constexpr int kPlaces = 12;
constexpr int kWidth = 128, kHeight = 72;

// The demo's island, grown, with its light, sea and shadow. Each two frames are a place of the
// flight: over the sea, past the shore, up a valley and over the ridge.
std::string Flight(const std::string& split, double step) {
  std::string text =
      "output { width: " + std::to_string(kWidth) + " height: " + std::to_string(kHeight) +
      " frames: " + std::to_string(2 * kPlaces) +
      " format: EXR_FLOAT }\n"
      "camera { eye {} look_at { x: .7 y: .2 z: .1 } fov: 40 near: .005 }\n"
      "lights { direction { x: -.7 y: .8 z: .46 } shadow: true intensity: 1.6 }\nsea {}\n"
      "objects { name: \"island\" shape { file { path: \"island.std\" } }\n"
      "  transform { translate { z: -.024 } }\n"
      "  fractal { method: \"surface\" seed: 28 H: .85 amplitude: .19 coast: true coast_H: .8\n"
      "    pixels: 2 split: " +
      split +
      " } }\n"
      "track { path: \"camera.eye\"\n";
  for (int i = 0; i < kPlaces; ++i) {
    const double t = i / (kPlaces - 1.);
    const double x = -2.6 + 2.9 * t, y = -1.9 + 1.6 * t, z = .9 - .35 * t;
    for (const double aside : {0., step}) {
      char key[160];
      std::snprintf(key, sizeof key, "  key { frame: %d value: [%.17g, %.17g, %.17g] }\n",
                    2 * i + (aside > 0 ? 2 : 1), x + aside, y + aside, z + aside);
      text += key;
    }
  }
  return text + "}\n";
}

std::string Island() {
  std::ifstream file(std::string(FJORD_SOURCE_DIR) + "/examples/data/taiwan_relief.std");
  return {std::istreambuf_iterator<char>(file), {}};
}

// What changes between the two cameras of each place.
struct Change {
  size_t pixels = 0;
  size_t changed = 0;                        // by more than a step of 8 bits
  double mean = 0;                           // of a pixel's largest channel
  uint64_t fewest = ~uint64_t{0}, most = 0;  // triangles of a frame
};

Change ChangeOf(const std::string& split, double step) {
  const auto animation = Animate(Flight(split, step), {}, {{"island.std", Island()}});
  Change change;
  if (animation == nullptr) return change;
  Picture before;
  for (uint32_t frame = 1; frame <= 2 * kPlaces; ++frame) {
    AssetSet assets;
    const v1::FrameScene scene = FrameOf(*animation, frame, &assets);
    Result<RenderedFrame> rendered = RenderFrame(scene, {.threads = 1, .assets = &assets});
    EXPECT_TRUE(rendered.ok()) << (rendered.ok() ? "" : rendered.error().message);
    if (!rendered.ok()) return change;
    for (uint32_t y = 0; frame % 2 == 0 && y < kHeight; ++y) {
      for (uint32_t x = 0; x < kWidth; ++x) {
        const Rgb by = At(rendered->picture, x, y) - At(before, x, y);
        const float largest = std::max({std::abs(by.r), std::abs(by.g), std::abs(by.b)});
        ++change.pixels;
        change.changed += largest > 1.f / 255 ? 1 : 0;
        change.mean += double{largest};
      }
    }
    change.fewest = std::min(change.fewest, rendered->stats.triangles);
    change.most = std::max(change.most, rendered->stats.triangles);
    before = std::move(rendered->picture);
  }
  change.mean /= static_cast<double>(change.pixels);
  return change;
}

TEST(FlightTest, S21_NothingFlickersThroughTheDemosIsland) {
  const Change still = ChangeOf("ADAPTIVE", 1e-9);
  ASSERT_EQ(still.pixels, size_t{kPlaces} * kWidth * kHeight);
  EXPECT_GT(still.most, still.fewest + still.fewest / 5) << "the flight changes nothing";
  EXPECT_LE(still.changed, 2u);
  EXPECT_LT(still.mean, 1e-7);
  // A tenth of a pixel at the shore, less further out: what changes is what has moved. Where edges
  // are halved at once by their length in the picture, more does.
  const Change moved = ChangeOf("ADAPTIVE", 1e-4), popping = ChangeOf("LENGTH", 1e-4);
  EXPECT_LT(moved.mean, .75 * popping.mean);
  RecordProperty("moved", std::to_string(moved.mean));
  RecordProperty("popping", std::to_string(popping.mean));
}

}  // namespace
}  // namespace fjord
