// One prepared object drawn at many places: the picture of as many objects, for the memory of one.
#include <sys/resource.h>

#include "engine/animation/frame_geometry.h"
#include "engine/geometry/primitives.h"
#include "engine/render/build.h"
#include "engine/render/frame_setup.h"
#include "engine/render/places.h"
#include "engine/scene/transform.h"
#include "tests/render/scenes.h"

namespace fjord {
namespace {

Rows At(double x, double y, double z, double scale) {
  return {scale, 0, 0, x, 0, scale, 0, y, 0, 0, scale, z};
}

v1::FrameScene Ground(uint32_t width, uint32_t height) {
  v1::FrameScene scene = PerspectiveScene(width, height, {0, -9, 4}, {0, 0, 0}, 40);
  scene.mutable_output()->set_samples(4);
  Put(scene.mutable_ambient(), {.2, .2, .25});
  AddSun(&scene, {1, -.5, 1}, {1, .9f, .8f});
  return scene;
}

v1::FrameObject* AddRock(v1::FrameScene* scene, double epsilon = .2) {
  const Result<Mesh> ball = MakeEllipsoid(Vec3(1, .9, 1.1), 8, 5);
  v1::FrameObject* rock = AddMesh(scene, *ball, {.6f, .5f, .4f});
  rock->mutable_material()->set_diffuse(.8);
  for (const double v : {-.5, .2, .3, .1, .9, .9, .9, 1.}) rock->mutable_material()->add_ramp(v);
  MakeRough(rock, epsilon, .2);
  return rock;
}

// Overlapping each other, partly outside the picture and behind the eye.
PlacementList Scattered(size_t count) {
  PlacementList places;
  for (size_t i = 0; i < count; ++i) {
    const auto unit = [&](uint64_t salt) {
      return static_cast<double>(Mix64(4 * i + salt) >> 40) / (1 << 24);
    };
    places.push_back(At(14 * unit(0) - 7, 24 * unit(1) - 12, unit(2), .05 + .6 * unit(3)));
  }
  return places;
}

TEST(PlacementsTest, D4_TheSamePictureAsThatManyObjects) {
  const PlacementList places = Scattered(60);
  v1::FrameScene placed = Ground(480, 270), apart = placed;
  v1::FrameObject* rock = AddRock(&placed);
  const Rows moved{0, -1, 0, .3, 1, 0, 0, .1, 0, 0, 1, -.2};  // a quarter turn, then a step
  rock->mutable_transform()->Add(moved.begin(), moved.end());
  AssemblePlacements(places, nullptr, rock, nullptr);
  for (const Rows& place : places) {
    const Rows whole = Composed(place, moved);
    AddRock(&apart)->mutable_transform()->Add(whole.begin(), whole.end());
  }
  const std::string wanted = DigestOf(apart);
  EXPECT_EQ(DigestOf(placed), wanted);
  EXPECT_EQ(DigestOf(placed, {.threads = 3}), wanted);
  EXPECT_EQ(DigestOf(placed, {.threads = 2, .tile_size = 48}), wanted);
  // and by digest
  AssetSet assets;
  rock->clear_placement();
  AssemblePlacements(places, MakeAsset(places), rock, &assets);
  EXPECT_EQ(DigestOf(placed, {.threads = 1, .assets = &assets}), wanted);
}

TEST(PlacementsTest, WhatIsOutOfThePictureIsNotSetUp) {
  v1::FrameScene scene = Ground(480, 270);
  v1::FrameObject* rock = AddRock(&scene);
  PlacementList places = Scattered(500);
  AssemblePlacements(places, nullptr, rock, nullptr);
  const Result<BuiltFrame> built = BuildFrame(scene);
  ASSERT_TRUE(built.ok());
  const View view = MakeView(built->camera, built->width, built->height);
  const size_t seen = PlacesSeen(*built, view).size();
  EXPECT_GT(seen, 100u);
  EXPECT_LT(seen, 400u);
  const FrameSetup setup(*built);
  EXPECT_EQ(setup.objects.size(), seen);
}

TEST(PlacementsTest, AllShareOnePreparedObject) {
  PreparedCache cache(1 << 24);
  v1::FrameScene scene = Ground(64, 36);
  AssemblePlacements(Scattered(50), nullptr, AddRock(&scene), nullptr);
  ASSERT_TRUE(BuildFrame(scene, nullptr, cache).ok());
  scene.mutable_object(0)->set_placement(3, 5);
  ASSERT_TRUE(BuildFrame(scene, nullptr, cache).ok());
  EXPECT_EQ(cache.stats().made, 1u);
}

TEST(PlacementsTest, AHundredThousandAreDrawnInBoundedMemory) {
  v1::FrameScene scene = Ground(1920, 1080);
  const Result<Mesh> box = MakeBox(Vec3(.02), 1, 1);
  v1::FrameObject* object = AddMesh(&scene, *box, {.6f, .5f, .4f});
  object->mutable_material()->set_diffuse(.8);
  PlacementList places = Scattered(100'000);
  for (Rows& place : places) place[7] = place[7] / 3 + 2;  // all before the eye
  AssetSet assets;
  AssemblePlacements(places, AssetOf(places), object, &assets);
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  const Result<RenderedFrame> one = RenderFrame(scene, {.threads = 1, .assets = &assets});
  getrusage(RUSAGE_SELF, &after);
  ASSERT_TRUE(one.ok()) << one.error().message;
  const Result<RenderedFrame> two = RenderFrame(scene, {.threads = 2, .assets = &assets});
  ASSERT_TRUE(two.ok());
  EXPECT_EQ(PixelDigest(one->picture), PixelDigest(two->picture));
  EXPECT_GT(one->stats.triangles, 100'000u);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 300'000) << "kilobytes";
}

TEST(PlacementsTest, ImpossiblePlacementsAreRefused) {
  v1::FrameScene scene = Ground(64, 36);
  v1::FrameObject* rock = AddRock(&scene);
  for (int i = 0; i < 11; ++i) rock->add_placement(1);
  EXPECT_FALSE(BuildFrame(scene).ok());
  rock->add_placement(1e30);
  EXPECT_FALSE(BuildFrame(scene).ok());
}

}  // namespace
}  // namespace fjord
