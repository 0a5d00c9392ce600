#include "engine/scene/track.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace fjord {
namespace {

v1::Track Track(const std::vector<std::pair<double, double>>& keys, v1::Key::Ease ease) {
  v1::Track track;
  track.set_path("camera.fov");
  for (const auto& [frame, value] : keys) {
    v1::TrackKey* key = track.add_key();
    key->set_frame(frame);
    key->add_value(value);
    key->set_ease(ease);
  }
  return track;
}

double At(const v1::Track& track, double frame) { return TrackValues(track, frame)[0]; }

TEST(TrackTest, W2_StaysBeforeAndAfterTheKeys) {
  const v1::Track track = Track({{5, .1}, {9, .7}}, v1::Key::LINEAR);
  EXPECT_EQ(At(track, 1), .1);
  EXPECT_EQ(At(track, 100), .7);
  EXPECT_DOUBLE_EQ(At(track, 7), .4);
}

TEST(TrackTest, W2_EasingsStartAndEndAsTheySay) {
  const auto slope = [](v1::Key::Ease ease, double t) {
    return (Eased(ease, t + 1e-6) - Eased(ease, t - 1e-6)) / 2e-6;
  };
  for (const auto ease : {v1::Key::LINEAR, v1::Key::SMOOTH, v1::Key::IN, v1::Key::OUT}) {
    EXPECT_EQ(Eased(ease, 0), 0);
    EXPECT_EQ(Eased(ease, 1), 1);
  }
  EXPECT_NEAR(slope(v1::Key::SMOOTH, 0), 0, 1e-5);
  EXPECT_NEAR(slope(v1::Key::SMOOTH, 1), 0, 1e-5);
  EXPECT_NEAR(slope(v1::Key::IN, 0), 0, 1e-5);
  EXPECT_NEAR(slope(v1::Key::IN, 1), 2, 1e-5);
  EXPECT_NEAR(slope(v1::Key::OUT, 0), 2, 1e-5);
  EXPECT_NEAR(slope(v1::Key::OUT, 1), 0, 1e-5);
  EXPECT_EQ(At(Track({{1, 3}, {5, 8}}, v1::Key::HOLD), 4.999), 3);
  EXPECT_EQ(At(Track({{1, 3}, {5, 8}}, v1::Key::HOLD), 5), 8);
}

RC_GTEST_PROP(TrackProperty, W2_KeysAreMetBitForBitAndNeverPassed, ()) {
  std::vector<std::pair<double, double>> keys;
  double frame = *rc::gen::inRange(-50, 50) * .25;
  const int count = *rc::gen::inRange(1, 8);
  for (int i = 0; i < count; ++i) {
    keys.emplace_back(frame, *rc::gen::inRange(-1000000, 1000000) / 7.0);
    frame += *rc::gen::inRange(1, 400) / 8.0;
  }
  const auto ease = static_cast<v1::Key::Ease>(*rc::gen::inRange(0, 5));
  const v1::Track track = Track(keys, ease);
  for (const auto& [at, value] : keys) RC_ASSERT(At(track, at) == value);
  for (size_t i = 1; i < keys.size(); ++i) {
    const double mid = keys[i - 1].first + (keys[i].first - keys[i - 1].first) * .3125;
    const double low = std::min(keys[i - 1].second, keys[i].second);
    const double high = std::max(keys[i - 1].second, keys[i].second);
    RC_ASSERT(At(track, mid) >= low && At(track, mid) <= high);
  }
}

TEST(TrackTest, W2_WritesVectorsAndNumbersIntoAScene) {
  v1::Scene scene;
  scene.add_objects()->set_name("a");
  scene.mutable_objects(0)->mutable_transform()->mutable_translate()->set_x(1);
  *scene.add_track() = Track({{1, 30}, {3, 50}}, v1::Key::LINEAR);
  v1::Track* move = scene.add_track();
  move->set_path("objects[a].transform.translate");
  v1::TrackKey* key = move->add_key();
  key->set_frame(2);
  for (const double value : {4., 5., 6.}) key->add_value(value);
  const TrackSet tracks(scene);
  v1::Scene now = scene;
  tracks.Apply(2, &now);
  EXPECT_EQ(now.camera().fov(), 40);
  EXPECT_EQ(now.objects(0).transform().translate().y(), 5);
  EXPECT_EQ(tracks.first_frame(), 1);
  EXPECT_EQ(tracks.last_frame(), 3);
  EXPECT_TRUE(tracks.Touches(Route().Then("camera")));
  EXPECT_FALSE(tracks.Touches(Route().Then("sea")));
  EXPECT_FALSE(tracks.Inside({Route().Then("objects", 0)}).Touches(Route().Then("camera")));
}

}  // namespace
}  // namespace fjord
