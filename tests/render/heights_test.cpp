// Height fields in pictures: any size, the same samples for every way of drawing them, and those of
// the mesh that they stand for.
#include "engine/geometry/heights.h"

#include <sys/resource.h>

#include "engine/animation/frame_geometry.h"
#include "engine/base/simd.h"
#include "engine/render/build.h"
#include "tests/render/scenes.h"

namespace fjord {
namespace {

std::shared_ptr<const HeightSource> Hills(uint32_t columns, uint32_t rows) {
  std::vector<float> samples;
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < columns; ++i) {
      const double x = 12. * i / columns, y = 9. * j / rows;
      samples.push_back(
          static_cast<float>(.5 * exact::Sin(x) * exact::Cos(y) + .1 * exact::Sin(7 * x + 3 * y)));
    }
  }
  return SampledHeights(columns, rows, std::move(samples));
}

v1::FrameScene Landscape(uint32_t width, uint32_t height) {
  v1::FrameScene scene = PerspectiveScene(width, height, {.3, -2.2, .9}, {0, 0, 0}, 45);
  scene.mutable_output()->set_samples(4);
  Put(scene.mutable_background(), {.1, .2, .5, .7, .7, .6});
  Put(scene.mutable_ambient(), {.1, .1, .15});
  AddSun(&scene, {1, -.5, .6}, {1, .9f, .8f});
  v1::FrameSea* sea = scene.mutable_sea();
  sea->set_level(-.05);
  Put(sea->mutable_color(), {.02, .06, .1});
  return scene;
}

v1::FrameObject* AddHeights(v1::FrameScene* scene, const HeightField& field, bool flat,
                            AssetSet* assets) {
  v1::FrameObject* object = scene->add_object();
  Plain(object, {.5f, .45f, .4f})->set_diffuse(.9);
  HeightsPose pose{field, field.size, flat, flat ? nullptr : AssetOf(field.source)};
  AssembleHeights(pose, object->mutable_heights(), assets);
  return object;
}

void SeeBy(double pixels, v1::FrameScene* scene) {
  v1::FrameFineness* fineness = scene->mutable_object(0)->mutable_heights()->mutable_fineness();
  fineness->set_pixels(pixels);
  fineness->set_focal(1.2 * scene->output().height());
  fineness->set_near(.01);
  for (const double x : scene->camera().eye()) fineness->add_eye(x);
}

TEST(HeightsRenderTest, D4_OnePictureForEveryTileThreadAndLevel) {
  v1::FrameScene scene = Landscape(320, 180);
  AssetSet assets;
  AddHeights(&scene, {Hills(705, 513), Vec3(3, 2.2, .5)}, false, &assets);
  SeeBy(1.5, &scene);
  const std::string wanted = DigestOf(scene, {.threads = 1, .assets = &assets});
  for (const int tile : {16, 48, 512}) {
    EXPECT_EQ(DigestOf(scene, {.threads = 1, .tile_size = tile, .assets = &assets}), wanted)
        << tile;
  }
  for (const int threads : {2, 3, 7}) {
    EXPECT_EQ(DigestOf(scene, {.threads = threads, .assets = &assets}), wanted) << threads;
  }
  for (const std::string& level : SimdLevels()) {
    ASSERT_TRUE(SetSimdLevel(level));
    EXPECT_EQ(DigestOf(scene, {.threads = 1, .assets = &assets}), wanted) << level;
  }
  ASSERT_TRUE(SetSimdLevel("best"));
}

TEST(HeightsRenderTest, LittleIsMadeOfWhatIsNotSeen) {
  v1::FrameScene scene = Landscape(480, 270);
  Put(scene.mutable_camera()->mutable_look_at(), {-1.2, -1, 0});
  scene.mutable_camera()->set_fov(10);
  AssetSet assets;
  AddHeights(&scene, {Hills(1025, 1025), Vec3(3, 3, .5)}, false, &assets);
  const Result<RenderedFrame> part = RenderFrame(scene, {.threads = 1, .assets = &assets});
  ASSERT_TRUE(part.ok());
  EXPECT_GT(part->stats.triangles, 1000u);
  EXPECT_LT(part->stats.triangles, 2u * 1024 * 1024 / 4);
}

// Written heights, drawn as they are, show what a mesh of the same points shows.
TEST(HeightsRenderTest, AFieldLooksLikeItsMesh) {
  const HeightField field{Hills(60, 60), Vec3(3, 3, .5)};
  v1::FrameScene heights = Landscape(480, 270), mesh = heights;
  AddHeights(&heights, field, false, nullptr);
  ASSERT_GT(heights.object(0).heights().sample_size(), 0) << "written out";
  AddMesh(&mesh, MeshOf(field), {.5f, .45f, .4f})->mutable_material()->set_diffuse(.9);
  const Picture a = Draw(heights), b = Draw(mesh);
  double difference = 0;
  for (uint32_t y = 0; y < 270; ++y) {
    for (uint32_t x = 0; x < 480; ++x) {
      const Rgb d = At(a, x, y) - At(b, x, y);
      difference += std::max({std::abs(d.r), std::abs(d.g), std::abs(d.b)});
    }
  }
  EXPECT_LT(difference / (480 * 270), .01);  // diagonals differ
  EXPECT_NE(PixelDigest(a), PixelDigest(Draw(Landscape(480, 270))));
}

TEST(HeightsRenderTest, AGridOf4096SquaredIsDrawnFromNothing) {
  v1::FrameScene scene = Landscape(1920, 1080);
  AddHeights(&scene, {FlatHeights(4097, 4097), Vec3(3, 3, 1)}, true, nullptr);
  EXPECT_LT(scene.ByteSizeLong(), 1000u);
  SeeBy(1, &scene);
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  const Result<RenderedFrame> drawn = RenderFrame(scene, {.threads = 2});
  getrusage(RUSAGE_SELF, &after);
  ASSERT_TRUE(drawn.ok()) << drawn.error().message;
  EXPECT_GT(drawn->stats.triangles, 100'000u);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 200'000) << "kilobytes";
  // all of it is there: no ray through the ground sees the sea below
  const Rgb middle = At(drawn->picture, 960, 540);
  EXPECT_GT(middle.r, .2f);
}

TEST(HeightsRenderTest, ImpossibleHeightsAreRefused) {
  v1::FrameScene scene = Landscape(64, 36);
  v1::FrameObject* object = AddHeights(&scene, {Hills(20, 20), Vec3(3, 3, .5)}, false, nullptr);
  ASSERT_TRUE(BuildFrame(scene).ok());
  object->mutable_heights()->set_rows(21);
  EXPECT_FALSE(BuildFrame(scene).ok());
  object->mutable_heights()->set_rows(20);
  object->mutable_heights()->set_size(0, 0);
  EXPECT_FALSE(BuildFrame(scene).ok());
  object->mutable_heights()->set_size(0, 3);
  object->mutable_heights()->set_sample(7, 1e300);
  EXPECT_FALSE(BuildFrame(scene).ok());
}

}  // namespace
}  // namespace fjord
