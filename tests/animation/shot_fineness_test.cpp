// The fineness of long shots: bounded stretch by stretch instead of frame by frame.
#include "engine/animation/shot_fineness.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <ctime>

#include "engine/animation/camera_check.h"
#include "engine/animation/stretch.h"
#include "tests/animation/animate.h"

namespace fjord {
namespace {

using testing::Animate;
using testing::FrameOf;

double EpsilonAt(const v1::FrameFineness& fineness, const Vec3& x) {
  if (fineness.focal() <= 0) return fineness.epsilon();
  const Vec3 eye(fineness.eye(0), fineness.eye(1), fineness.eye(2));
  return fineness.pixels() * std::max(fineness.near(), Length(x - eye) - fineness.eye_radius()) /
         fineness.focal();
}

std::string Number(double low, double high) {
  return std::to_string(low + (high - low) * *rc::gen::inRange(0, 10'001) * 1e-4);
}

std::string Numbers(double low, double high) {
  return "[" + Number(low, high) + "," + Number(low, high) + "," + Number(low, high) + "]";
}

// A track with some keys over `frames` frames, often all in a small part of them.
template <typename Value>
std::string RandomTrack(const std::string& path, int frames, const Value& value) {
  static const char* const kEases[] = {"LINEAR", "SMOOTH", "IN", "OUT", "HOLD"};
  const int span = *rc::gen::element(frames, frames / 40, frames / 3);
  const int from = *rc::gen::inRange(1, frames - span + 2);
  std::vector<int> at;
  for (int i = *rc::gen::inRange(1, 5); i >= 0; --i) at.push_back(*rc::gen::inRange(0, span));
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  std::string text = "track { path: \"" + path + "\"";
  for (const int frame : at) {
    text += " key { frame: " + std::to_string(from + frame) + ".25 value: " + value() +
            " ease: " + kEases[*rc::gen::inRange(0, 5)] + " }";
  }
  return text + " }\n";
}

RC_GTEST_PROP(ShotFinenessProperty, Z1_NoFrameOfALongShotIsCoarserThanItAsksForAlone, ()) {
  const int frames = *rc::gen::element(6'000, 100'000, 1'000'000);
  const std::string fineness =
      *rc::gen::element<std::string>("pixels: 2", "pixels: .5", "viewing: 3", "epsilon: .01", "");
  std::string text = "output { width: 192 height: 108 frames: " + std::to_string(frames) +
                     " }\ncamera { eye { x: 9 y: -9 z: 4 } look_at {} near: .01 " +
                     (*rc::gen::inRange(0, 4) == 0 ? "projection: ORTHOGRAPHIC " : "") +
                     "}\nobjects { name: \"a\" shape { primitive { kind: GRID } } fractal { " +
                     fineness + " } }\n";
  text += RandomTrack("camera.eye", frames, [] { return Numbers(2, 30); });
  const auto maybe = [](int of) { return *rc::gen::inRange(0, of) == 0; };
  if (maybe(3)) {
    text += RandomTrack("camera.look_at", frames, [] { return Numbers(-2, 1); });
  }
  if (maybe(3)) text += RandomTrack("camera.fov", frames, [] { return Number(20, 60); });
  const std::string place = "objects[a].transform.";
  if (maybe(2)) text += RandomTrack(place + "translate", frames, [] { return Numbers(-2, 1); });
  if (maybe(3)) text += RandomTrack(place + "rotate", frames, [] { return Numbers(-200, 200); });
  if (maybe(3)) {
    text += RandomTrack(place + "scale", frames, [] {
      const std::string s = Number(.05, 2);
      return "[" + s + "," + s + "," + s + "]";
    });
  } else if (maybe(3)) {
    text += RandomTrack(place + "scale.x", frames, [] { return Number(.5, 2); });
    text += RandomTrack(place + "scale.z", frames, [] { return Number(.5, 2); });
  }
  if (fineness.find("pixels") == 0 && maybe(3)) {
    text += RandomTrack("objects[a].fractal.pixels", frames, [] { return Number(.3, 4); });
  }
  const auto animation = Animate(text);
  RC_ASSERT(animation != nullptr);
  const v1::FrameScene first = FrameOf(*animation, 1);
  const v1::FrameFineness shot = first.object(0).fractal().fineness();
  v1::Scene now = animation->scene();
  const TrackSet tracks(now);
  Box rest;
  for (int n = 1; n <= first.object(0).point_size() / 3; ++n) {
    rest.Add(testing::PointOf(first, 1, n));
  }
  for (int i = 0; i < 60; ++i) {
    const int frame = *rc::gen::inRange(1, frames + 1);
    tracks.Apply(frame, &now);
    const v1::Fractal& fractal = now.objects(0).fractal();
    const CameraState camera(now.camera());
    const ObjectTransform transform(now.objects(0).transform());
    for (int j = 0; j < 9; ++j) {
      const auto share = [] { return *rc::gen::inRange(0, 101) * .01; };
      const Vec3 x = rest.low + Vec3(share(), share(), share()) * rest.Size();
      // what the frame itself sees: world lengths against world distance
      double wanted = fractal.epsilon();
      const double distance = Length(transform.ToWorld(x) - camera.eye);
      if (fractal.viewing() > 0) {
        wanted = .01 * Length(camera.eye - camera.look_at) / fractal.viewing();
      } else if (fractal.pixels() > 0) {
        wanted = fractal.pixels() * (camera.orthographic
                                         ? camera.view_height / 108
                                         : std::max(camera.near, distance) / camera.Focal(108));
      }
      RC_ASSERT(EpsilonAt(shot, x) <= wanted / transform.largest_scale() * (1 + 1e-9));
    }
  }
}

const std::string kFlight =
    "camera { eye { y: -40 z: 9 } look_at {} near: .1 }\nobjects { name: \"a\" shape { primitive { "
    "kind: GRID } } fractal { pixels: 1 } }\n";

std::string Frames(int frames) { return "output { frames: " + std::to_string(frames) + " }\n"; }

std::string FlightTracks(int frames) {
  return "track { path: \"camera.eye\" key { frame: 1 value: [0,-40,9] ease: SMOOTH } key { "
         "frame: " +
         std::to_string(frames / 2) + " value: [1,-4,2] } key { frame: " + std::to_string(frames) +
         " value: [30,20,5] } }\ntrack { path: \"objects[a].transform.rotate.z\" key { frame: 1 "
         "value: 0 } key { frame: " +
         std::to_string(frames) + " value: 720 } }\n";
}

// The same flight in 1,000 times as many frames asks for the same, up to how closely it is bounded.
TEST(ShotFinenessTest, AFlightIsAsFineInAMillionFramesAsInAThousand) {
  const auto at = [](int frames) {
    const auto animation = Animate(Frames(frames) + kFlight + FlightTracks(frames));
    return EpsilonAt(FrameOf(*animation, 1).object(0).fractal().fineness(), {0, 0, 0});
  };
  const double exact = at(1'000), bounded = at(1'000'000);
  EXPECT_LE(bounded, exact * 1.01);
  EXPECT_GE(bounded, exact * .9);
}

TEST(ShotFinenessTest, AnObjectThatGrowsFromNothingIsNotMadeInfinitelyFine) {
  const auto at = [](int frames) {
    const auto animation =
        Animate(Frames(frames) + kFlight +
                "track { path: \"objects[a].transform.scale\" key { frame: 1 value: [0,0,0] ease: "
                "SMOOTH } key { frame: " +
                std::to_string(frames) + " value: [1,1,1] } }\n");
    return EpsilonAt(FrameOf(*animation, 1).object(0).fractal().fineness(), {0, 0, 0});
  };
  EXPECT_GT(at(1'000'000), .9 * at(1'000));
}

TEST(ShotFinenessTest, ACutOfTheCameraCostsOnlyWhatBothSidesAsk) {
  const std::string cut =
      "track { path: \"camera.eye\" key { frame: 1 value: [0,-40,9] ease: HOLD } key { frame: "
      "500000 value: [0,40,9] } }\n";
  const auto animation = Animate(Frames(1'000'000) + kFlight + cut);
  const auto still = Animate(Frames(1) + kFlight);
  const double one = EpsilonAt(FrameOf(*still, 1).object(0).fractal().fineness(), {0, 0, 0});
  EXPECT_GT(EpsilonAt(FrameOf(*animation, 7).object(0).fractal().fineness(), {0, 0, 0}), .9 * one);
}

// A hundred moving objects over a million frames did not end in 55 s.
TEST(ShotFinenessTest, ALongShotOfManyObjectsIsReadySoon) {
  constexpr int kFrames = 1'000'000;
  std::string text = Frames(kFrames) + "camera { look_at {} near: .1 }\n";
  for (int i = 0; i < 100; ++i) {
    std::string name = "o";
    name += std::to_string(i);
    text += "objects { name: \"" + name +
            "\" shape { primitive { kind: GRID } } fractal { pixels: 1 } }\ntrack { path: "
            "\"objects[" +
            name + "].transform.rotate.z\" key { frame: 1 value: 0 } key { frame: " +
            std::to_string(kFrames) + " value: 3600 } }\n";
  }
  text +=
      "track { path: \"camera.eye\" key { frame: 1 value: [0,-40,9] } key { frame: 1000000 "
      "value: [0,-4,2] } }\n";
  const std::clock_t start = std::clock();
  const auto animation = Animate(text);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  ASSERT_NE(animation, nullptr);
  const auto fineness = FrameOf(*animation, 500'000).object(99).fractal().fineness();
  EXPECT_GT(EpsilonAt(fineness, {0, 0, 0}), .0005);
  EXPECT_LT(EpsilonAt(fineness, {0, 0, 0}), .01);
  EXPECT_LT(seconds, 15) << "of processor time";
  RecordProperty("seconds", std::to_string(seconds));
}

TEST(ShotFinenessTest, PreparingIsCancelled) {
  LoadResult loaded = testing::Load(Frames(1'000'000) + kFlight + FlightTracks(1'000'000));
  ASSERT_TRUE(loaded.ok());
  const std::atomic<bool> cancel{true};
  const auto animation = Animation::Make(std::move(loaded.loaded), &cancel);
  ASSERT_FALSE(animation.ok());
  EXPECT_EQ(animation.error().code, ErrorCode::kCancelled);
}

TEST(StretchTest, CutsStandAtKeysAndCoverEveryFrameOnce) {
  const std::vector<double> keys = {-3, 1, 4.5, 5, 9, 40};
  for (const size_t most : {1, 2, 3, 9}) {
    uint32_t next = 1;
    const std::vector<Stretch> stretches = CutAtKeys(keys, {1, 20}, most);
    EXPECT_LE(stretches.size(), most);
    for (const Stretch& stretch : stretches) {
      EXPECT_EQ(stretch.first, next);
      EXPECT_GE(stretch.last, stretch.first);
      EXPECT_TRUE(most < 9 || KeysInside(keys, stretch).empty());
      next = stretch.last + 1;
    }
    EXPECT_EQ(next, 21u);
  }
  EXPECT_EQ(KeysInside(keys, {1, 9}).size(), 2u) << "4.5 and 5: those at the ends are not inside";
}

TEST(CameraCheckTest, TheFirstBlindFrameIsFoundInALongShot) {
  // the eye passes through what it looks at in frame 750,001 and no other
  const std::string through =
      "track { path: \"camera.eye\" key { frame: 1 value: [-3,0,0] } key { frame: 1000001 value: "
      "[1,0,0] } }\n";
  LoadResult loaded = testing::Load(Frames(1'000'000) + kFlight + through);
  ASSERT_TRUE(loaded.ok()) << testing::ErrorsOf(loaded);
  const auto animation = Animation::Make(std::move(loaded.loaded));
  ASSERT_FALSE(animation.ok());
  EXPECT_EQ(animation.error().message,
            "frame 750001: the camera's eye and look_at are at one place");
}

// Almost blind everywhere: up turns with the view, a hundred-millionth beside it. Where the search
// gives up, the frame itself says what is wrong with it.
TEST(CameraCheckTest, ABlindFrameThatWasPassedOverIsRefusedWhenMade) {
  const std::string spin =
      "track { path: \"camera.eye\" key { frame: 1 value: [0,0,1] } key { frame: 1000000 value: "
      "[0,1,0] } }\ntrack { path: \"camera.up\" key { frame: 1 value: [4e-9,0,1] } key { frame: "
      "999999 value: [4e-9,1,1e-6] } key { frame: 1000000 value: [0,1,0] } }\n";
  LoadResult loaded = testing::Load(Frames(1'000'000) + kFlight + spin);
  ASSERT_TRUE(loaded.ok()) << testing::ErrorsOf(loaded);
  const auto animation = Animation::Make(std::move(loaded.loaded));
  ASSERT_TRUE(animation.ok()) << animation.error().message;
  AssetSet assets;
  const auto frame = (*animation)->Inbetween(1'000'000, &assets);
  ASSERT_FALSE(frame.ok());
  EXPECT_EQ(frame.error().message, "frame 1000000: the camera's up runs along the view");
}

}  // namespace
}  // namespace fjord
