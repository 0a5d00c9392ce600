// One picture for the tilings and threads that users get, at the sizes they render, against the
// plain way (D3, D4).
#include <gtest/gtest.h>
// after gtest.h
#include <rapidcheck/gtest.h>

#include <optional>

#include "engine/animation/inbetween.h"
#include "engine/scene/load.h"
#include "tests/render/plain_oracle.h"
#include "tests/render/random_scenes.h"
#include "tests/render/scenes.h"

namespace fjord {
namespace {

struct Size {
  uint32_t width, height;
};

// The gate's scene of all kinds of elements, 1920 pixels wide, or of another size.
Result<BuiltFrame> Wide(std::optional<Size> size = std::nullopt) {
  LoadResult loaded = LoadSceneFile(FJORD_SOURCE_DIR "/tests/gate/wide.scene");
  if (!loaded.ok()) return loaded.errors.front();
  if (size) loaded.loaded.scene.mutable_output()->set_width(size->width);
  if (size) loaded.loaded.scene.mutable_output()->set_height(size->height);
  const auto animation = Animation::Make(std::move(loaded.loaded));
  if (!animation.ok()) return animation.error();
  AssetSet assets;
  const Result<v1::FrameScene> frame = (*animation)->Inbetween(1, &assets);
  if (!frame.ok()) return frame.error();
  return BuildFrame(*frame, &assets);
}

TEST(TilingsTest, D4_OnePictureForTheTilesAndThreadsThatUsersGet) {
  const Result<BuiltFrame> built = Wide();
  ASSERT_TRUE(built.ok()) << built.error().ToString();
  ASSERT_EQ(built->width, 1920u);
  const Digest wanted = PixelDigest(DrawPlain(*built).picture);
  for (const int threads : {1, 2, 3, 8}) {
    const RenderedFrame drawn = DrawBuilt(*built, {.threads = threads});
    EXPECT_EQ(PixelDigest(drawn.picture), wanted) << threads << " threads";
    EXPECT_GT(drawn.stats.culled, 1000u) << "nothing was left out";
  }
}

// A second row of tiles, and several columns.
TEST(TilingsTest, D4_OnePictureForHighPicturesToo) {
  const Result<BuiltFrame> built = Wide(Size{640, 1200});
  ASSERT_TRUE(built.ok()) << built.error().ToString();
  const Digest wanted = PixelDigest(DrawPlain(*built).picture);
  for (const int threads : {1, 3}) {
    EXPECT_EQ(PixelDigest(DrawBuilt(*built, {.threads = threads}).picture), wanted) << threads;
  }
}

RC_GTEST_PROP(TilingsProperty, D4_TilesThreadsAndCullingChangeNoPixel, ()) {
  v1::FrameScene scene = RandomScene();
  scene.mutable_output()->set_alpha(*rc::gen::arbitrary<bool>());
  if (*rc::gen::arbitrary<bool>()) scene.mutable_output()->add_layer(1);  // depth
  const Result<BuiltFrame> built = BuildFrame(scene);
  RC_ASSERT(built.ok());
  const Digest wanted = PixelDigest(DrawPlain(*built).picture);
  for (int way = 0; way < 3; ++way) {
    RenderOptions options;
    options.threads = *rc::gen::inRange(1, 9);
    options.tile_size = 16 * *rc::gen::inRange(0, 8);
    options.patch_size = OneOf({size_t{0}, size_t{64}, size_t{300}});
    RC_LOG() << options.threads << " threads, tile " << options.tile_size << ", patch "
             << options.patch_size << '\n';
    const Digest drawn = PixelDigest(DrawBuilt(*built, options).picture);
    if (drawn != wanted) RC_FAIL("another picture:\n" + scene.DebugString().substr(0, 6000));
  }
}

}  // namespace
}  // namespace fjord
