// What is kept of prepared objects, and who makes them.
#include "engine/render/prepared_cache.h"

#include <atomic>
#include <thread>

#include "engine/geometry/primitives.h"
#include "engine/render/build.h"
#include "engine/render/wireframe.h"
#include "tests/render/scenes.h"

namespace fjord {
namespace {

// An object of a given size that is of no other use.
class Weight final : public PreparedFractal {
 public:
  explicit Weight(size_t bytes) : bytes_(bytes) {}
  size_t RootCount() const override { return 0; }
  Triangle Corners(uint32_t) const override { return {}; }
  Ball Bound(size_t) const override { return {}; }
  StreamStats Stream(size_t, StreamSink&, size_t) const override { return {}; }
  Result<WeldedShape> Weld(const WeldLimits&) const override { return WeldedShape{}; }
  size_t Bytes() const override { return bytes_; }

 private:
  size_t bytes_;
};

Result<PreparedObject> Weighing(size_t bytes) {
  PreparedObject object;
  object.prepared = std::make_shared<Weight>(bytes);
  return object;
}

Digest Key(const std::string& name) { return Sha256Of(name); }

TEST(PreparedCacheTest, TheLeastRecentlyUsedGoesFirst) {
  PreparedCache cache(10'000);
  int made = 0;
  const auto get = [&](const std::string& name) {
    const auto object = cache.Get(Key(name), [&] {
      ++made;
      return Weighing(3'000);
    });
    ASSERT_TRUE(object.ok());
  };
  for (const char* name : {"a", "b", "c", "a"}) get(name);
  EXPECT_EQ(made, 3);
  get("d");  // b goes: a was used since
  EXPECT_EQ(made, 4);
  EXPECT_EQ(cache.stats().objects, 3u);
  EXPECT_LE(cache.stats().bytes, 10'000u);
  for (const char* name : {"a", "c", "d"}) get(name);
  EXPECT_EQ(made, 4);
  get("b");
  EXPECT_EQ(made, 5);
}

TEST(PreparedCacheTest, WhatIsTooLargeIsMadeButNotKept) {
  PreparedCache cache(10'000);
  ASSERT_TRUE(cache.Get(Key("small"), [] { return Weighing(1'000); }).ok());
  const auto large = cache.Get(Key("large"), [] { return Weighing(20'000); });
  ASSERT_TRUE(large.ok());
  EXPECT_EQ((*large)->prepared->Bytes(), 20'000u);
  EXPECT_EQ(cache.stats().objects, 1u);
  EXPECT_LE(cache.stats().bytes, 10'000u);
}

TEST(PreparedCacheTest, OneMakesAndTheOthersWait) {
  constexpr size_t kThreads = 8;
  PreparedCache cache(10'000);
  std::atomic<int> made = 0;
  std::vector<std::shared_ptr<const PreparedObject>> got(kThreads);
  std::vector<std::thread> threads;
  for (size_t i = 0; i < kThreads; ++i) {
    threads.emplace_back([&, i] {
      auto object = cache.Get(Key("one"), [&] {
        // until all others wait, or one of them makes the object too
        for (++made; made == 1 && cache.stats().waiting + 1 < kThreads;) std::this_thread::yield();
        return Weighing(1'000);
      });
      if (object.ok()) got[i] = *object;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(made, 1);
  ASSERT_NE(got[0], nullptr);
  for (const auto& object : got) EXPECT_EQ(object, got[0]);
  EXPECT_EQ(cache.stats().found, kThreads - 1);
}

TEST(PreparedCacheTest, AFailureIsNotKept) {
  PreparedCache cache(10'000);
  const auto failed =
      cache.Get(Key("x"), []() -> Result<PreparedObject> { return Invalid("not today"); });
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().message, "not today");
  EXPECT_TRUE(cache.Get(Key("x"), [] { return Weighing(1); }).ok());
}

v1::FrameScene Island() {
  v1::FrameScene scene = PerspectiveScene(96, 64, {.3, -2.2, 1.3}, {0, 0, 0}, 40);
  const Result<Mesh> grid = MakeGrid(Vec3(3, 3, 0), 4, 4);
  MakeRough(AddMesh(&scene, *grid, {.5f, .45f, .4f}), .05, .3);
  return scene;
}

TEST(PreparedCacheTest, AStillIslandUnderAMovingCameraIsPreparedOnce) {
  PreparedCache cache(1 << 24);
  v1::FrameScene scene = Island();
  for (int frame = 0; frame < 5; ++frame) {
    Put(scene.mutable_camera()->mutable_eye(), {.3, -2.2 + .1 * frame, 1.3});
    scene.mutable_object(0)->mutable_material()->set_diffuse(.1 * frame);
    scene.mutable_object(0)->clear_transform();
    for (const double x : {1., 0., 0., .1 * frame, 0., 1., 0., 0., 0., 0., 1., 0.}) {
      scene.mutable_object(0)->add_transform(x);
    }
    ASSERT_TRUE(BuildFrame(scene, nullptr, cache).ok());
  }
  EXPECT_EQ(cache.stats().made, 1u);
  EXPECT_EQ(cache.stats().found, 4u);
}

TEST(PreparedCacheTest, WhatChangesTheShapeMakesAnother) {
  PreparedCache cache(1 << 24);
  const v1::FrameScene first = Island();
  uint64_t made = 0;
  const auto expect_new = [&](const v1::FrameScene& scene, const char* what) {
    ASSERT_TRUE(BuildFrame(scene, nullptr, cache).ok()) << what;
    EXPECT_EQ(cache.stats().made, ++made) << what;
  };
  expect_new(first, "the first");
  v1::FrameScene other = first;
  other.mutable_object(0)->mutable_fractal()->set_seed(8);
  expect_new(other, "another seed");
  other = first;
  other.mutable_object(0)->set_point(0, -1.25);
  expect_new(other, "another place of a point");
  other = first;
  other.mutable_object(0)->mutable_fractal()->mutable_fineness()->set_epsilon(.07);
  expect_new(other, "another fineness");
  other = first;
  other.mutable_object(0)->clear_fractal();
  expect_new(other, "no fractal");
  other = first;
  v1::FrameFractal* fractal = other.mutable_object(0)->mutable_fractal();
  fractal->set_split(static_cast<uint32_t>(Split::kAdaptive));
  fractal->mutable_fineness()->set_pixels(2);
  fractal->mutable_fineness()->set_focal(100);
  fractal->mutable_fineness()->set_near(.01);
  Put(fractal->mutable_fineness()->mutable_eye(), {.3, -2.2, 1.3});
  expect_new(other, "by this view");
  fractal->mutable_fineness()->set_eye(0, .4);
  expect_new(other, "by another view");
}

TEST(PreparedCacheTest, D4_AKeptObjectDrawsWhatANewOneDraws) {
  PreparedCache kept(1 << 24), none(0);
  const v1::FrameScene scene = Island();
  ASSERT_TRUE(BuildFrame(scene, nullptr, kept).ok());
  const Result<BuiltFrame> again = BuildFrame(scene, nullptr, kept),
                           anew = BuildFrame(scene, nullptr, none);
  ASSERT_TRUE(again.ok() && anew.ok());
  EXPECT_EQ(kept.stats().found, 1u);
  EXPECT_EQ(none.stats().objects, 0u);
  EXPECT_NE(again->objects[0].prepared, anew->objects[0].prepared);
  EXPECT_EQ(GeometryDigest(*again), GeometryDigest(*anew));
}

}  // namespace
}  // namespace fjord
