// A flight through the demo's island under split ADAPTIVE does not flicker: between two cameras
// that are next to one another no pixel changes but by a sample that lies on an edge.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>

#include "tests/animation/animate.h"
#include "tests/render/scenes.h"

namespace fjord {
namespace {

using testing::Animate;
using testing::FrameOf;

constexpr int kPlaces = 8;  // looked from
constexpr int kPieces = 4;  // searched for jumps
constexpr int kWidth = 128, kHeight = 72;

// Over the sea, past the shore, up a valley and over the ridge.
Vec3 EyeAt(double t) { return {-2.6 + 2.9 * t, -1.9 + 1.6 * t, .9 - .35 * t}; }

// The demo's island, grown, with its light, sea and shadow.
std::string IslandFrom(const Vec3& eye, const std::string& split, double pixels) {
  char camera[200];
  std::snprintf(camera, sizeof camera, "camera { eye { x: %.17g y: %.17g z: %.17g } ", eye.x, eye.y,
                eye.z);
  return "output { width: " + std::to_string(kWidth) + " height: " + std::to_string(kHeight) +
         " format: EXR_FLOAT }\n" + camera +
         "look_at { x: .7 y: .2 z: .1 } fov: 40 near: .005 }\n"
         "lights { direction { x: -.7 y: .8 z: .46 } shadow: true intensity: 1.6 }\nsea {}\n"
         "objects { name: \"island\" shape { file { path: \"island.std\" } }\n"
         "  transform { translate { z: -.024 } }\n"
         "  fractal { method: \"surface\" seed: 28 H: .85 amplitude: .19 coast: true coast_H: .8\n"
         "    pixels: " +
         std::to_string(pixels) + " split: " + split + " } }\n";
}

std::string Island() {
  std::ifstream file(std::string(FJORD_SOURCE_DIR) + "/examples/data/taiwan_relief.std");
  return {std::istreambuf_iterator<char>(file), {}};
}

RenderedFrame Seen(const Vec3& eye, const std::string& split, double pixels) {
  const auto animation = Animate(IslandFrom(eye, split, pixels), {}, {{"island.std", Island()}});
  AssetSet assets;
  const v1::FrameScene scene = FrameOf(*animation, 1, &assets);
  Result<RenderedFrame> rendered = RenderFrame(scene, {.threads = 1, .assets = &assets});
  FJORD_CHECK(rendered.ok(), rendered.error().message);
  return std::move(*rendered);
}

// Pixels that differ by more than a step of 8 bits, and the mean of all.
struct Change {
  size_t pixels = 0;
  double mean = 0;
};

Change ChangeOf(const Picture& a, const Picture& b) {
  Change change;
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      const Rgb by = At(a, x, y) - At(b, x, y);
      const float largest = std::max({std::abs(by.r), std::abs(by.g), std::abs(by.b)});
      change.pixels += largest > 1.f / 255 ? 1 : 0;
      change.mean += double{largest} / (kWidth * kHeight);
    }
  }
  return change;
}

// Halves a piece of the flight towards its larger change until the camera moves by 1e-11.
Change JumpBetween(double t0, double t1, const std::string& split, double pixels) {
  Picture p0 = Seen(EyeAt(t0), split, pixels).picture;
  Picture p1 = Seen(EyeAt(t1), split, pixels).picture;
  while (t1 - t0 > 3e-12) {
    const double t = (t0 + t1) * .5;
    Picture p = Seen(EyeAt(t), split, pixels).picture;
    const Change first = ChangeOf(p0, p), second = ChangeOf(p, p1);
    if (std::pair(first.pixels, first.mean) >= std::pair(second.pixels, second.mean)) {
      t1 = t;
      p1 = std::move(p);
    } else {
      t0 = t;
      p0 = std::move(p);
    }
  }
  return ChangeOf(p0, p1);
}

// A facet of some 16 pixels that jumped would change many of them at once; a sample that an edge
// has passed changes one.
TEST(FlightTest, S21_NoFacetOfTheDemosIslandJumps) {
  size_t most = 0;
  for (int piece = 0; piece < kPieces; ++piece) {
    const double t0 = piece / double{kPieces};
    most = std::max(most, JumpBetween(t0, t0 + 1. / kPieces, "ADAPTIVE", 16).pixels);
  }
  EXPECT_LE(most, 4u);
  EXPECT_GT(JumpBetween(.4, .6, "LENGTH", 16).pixels, 20u);
}

// What changes where the camera moves by a fraction of a pixel is what moves: less than where edges
// are halved at once.
TEST(FlightTest, S21_NothingFlickersThroughTheDemosIsland) {
  double faded = 0, popping = 0;
  uint64_t fewest = ~uint64_t{0}, most = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const Vec3 eye = EyeAt(i / (kPlaces - 1.)), aside = eye + Vec3(1e-4);
    const RenderedFrame here = Seen(eye, "ADAPTIVE", 2);
    EXPECT_LE(ChangeOf(here.picture, Seen(eye + Vec3(1e-9), "ADAPTIVE", 2).picture).pixels, 2u);
    faded += ChangeOf(here.picture, Seen(aside, "ADAPTIVE", 2).picture).mean;
    popping += ChangeOf(Seen(eye, "LENGTH", 2).picture, Seen(aside, "LENGTH", 2).picture).mean;
    fewest = std::min(fewest, here.stats.triangles);
    most = std::max(most, here.stats.triangles);
  }
  EXPECT_GT(most, fewest + fewest / 5) << "the flight changes nothing";
  EXPECT_LT(faded, .75 * popping);
}

}  // namespace
}  // namespace fjord
