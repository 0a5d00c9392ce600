// Shadows: where they must fall, and where none may.
#include <algorithm>
#include <cmath>

#include "engine/geometry/primitives.h"
#include "engine/render/build.h"
#include "engine/render/tiles.h"
#include "tests/render/scenes.h"

namespace fjord {
namespace {

constexpr double kTexel = .05;

v1::FrameScene Lit(v1::FrameScene scene, const Vec3& towards) {
  Put(scene.mutable_ambient(), {0, 0, 0});
  AddSun(&scene, towards, Rgb(1));
  scene.mutable_light(0)->set_shadow(kTexel);
  return scene;
}

v1::FrameObject* AddMatt(v1::FrameScene* scene, const std::vector<Vec3>& points,
                         const std::vector<std::vector<uint32_t>>& faces) {
  v1::FrameObject* object = AddObject(scene, points, faces, Rgb(1));
  object->mutable_material()->set_diffuse(1);
  return object;
}

void AddFloor(v1::FrameScene* scene, double half, double z = 0) {
  AddMatt(scene, {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}},
          {{0, 1, 2, 3}});
}

Picture WithoutShadow(v1::FrameScene scene) {
  scene.mutable_light(0)->set_shadow(0);
  return Draw(scene);
}

TEST(ShadowTest, APlateThrowsItsOutline) {
  // 20 pixels a unit; the sun stands 45 degrees high in the west, so the shadow of what is 1 high
  // lies 1 to the east.
  v1::FrameScene scene = Lit(FlatScene(160, 160, 20), {-1, 0, 1});
  AddFloor(&scene, 10);
  AddMatt(&scene, {{-2, -1, 1}, {-1, -1, 1}, {-1, 1, 1}, {-2, 1, 1}}, {{0, 1, 2, 3}});
  const Picture picture = Draw(scene), without = WithoutShadow(scene);
  int dark = 0;
  for (uint32_t py = 0; py < 160; ++py) {
    for (uint32_t px = 0; px < 160; ++px) {
      const double x = (px + .5 - 80) / 20, y = (80 - (py + .5)) / 20;
      if (x > -2 && x < -1 && y > -1 && y < 1) continue;  // the plate itself
      const double inside = std::min(std::min(x + 1, 0 - x), std::min(y + 1, 1 - y));
      const float got = At(picture, px, py).r, full = At(without, px, py).r;
      if (inside > 3 * kTexel) {
        EXPECT_EQ(got, 0) << x << ' ' << y;
        ++dark;
      } else if (inside < -3 * kTexel) {
        EXPECT_EQ(got, full) << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(dark, 450);
}

// What is convex throws no shadow on itself, at every angle of the sun and every way that facets
// lie to texels; where the sun all but grazes it, less than 1/64 of the light may be lost.
TEST(ShadowTest, NoAcneOnWhatIsConvex) {
  const Result<Mesh> ball = MakeEllipsoid(Vec3(3), 48, 24);
  for (const double height : {.05, .2, .6, 1., 4.}) {
    v1::FrameScene floor =
        Lit(PerspectiveScene(96, 64, {1, -9, 5}, {0, 0, 0}, 50), {-.6, .35, height});
    v1::FrameScene round = floor;
    AddFloor(&floor, 6);
    AddMesh(&round, *ball, Rgb(1))->mutable_material()->set_diffuse(1);
    for (const v1::FrameScene& scene : {floor, round}) {
      const Picture with = Draw(scene), without = WithoutShadow(scene);
      int lit = 0;
      for (uint32_t i = 0; i < 96 * 64; ++i) {
        const float got = At(with, i % 96, i / 96).r, full = At(without, i % 96, i / 96).r;
        lit += full > .02f ? 1 : 0;
        if (full > 1 / 64.f) {
          ASSERT_EQ(got, full) << height << ", pixel " << i % 96 << ' ' << i / 96;
        }
      }
      EXPECT_GT(lit, 200) << height;
    }
  }
}

TEST(ShadowTest, AShadowBeginsAtTheFootOfWhatThrowsIt) {
  v1::FrameScene scene = Lit(FlatScene(160, 160, 20), {-1, 0, 1});
  AddFloor(&scene, 10);
  // A wall 1 high along y, seen from above; its foot is at x = 0.
  AddMatt(&scene, {{0, -3, 0}, {0, 3, 0}, {0, 3, 1}, {0, -3, 1}}, {{0, 1, 2, 3}});
  const Picture picture = Draw(scene);
  const float full = WithoutShadow(scene).bytes.empty() ? 0 : At(WithoutShadow(scene), 40, 80).r;
  ASSERT_GT(full, .5f);
  for (uint32_t px = 0; px < 160; ++px) {
    const double x = (px + .5 - 80) / 20;
    const float got = At(picture, px, 80).r;
    if (x > 4 * kTexel && x < 1 - 3 * kTexel) {
      EXPECT_EQ(got, 0) << x;
    } else if (x < -3 * kTexel || x > 1 + 3 * kTexel) {
      EXPECT_EQ(got, full) << x;
    }
  }
}

TEST(ShadowTest, EdgesAreSoftAndEven) {
  // A plate turned a little: its edge must cross the pixels like a ramp, not like stairs.
  v1::FrameScene scene = Lit(FlatScene(160, 160, 40), {0, 0, 1});
  AddFloor(&scene, 10);
  const double c = std::cos(.1), s = std::sin(.1);
  const auto turned = [&](double x, double y) { return Vec3(c * x - s * y, s * x + c * y, 2); };
  AddMatt(&scene, {turned(-9, -9), turned(0, -9), turned(0, 9), turned(-9, 9)}, {{0, 1, 2, 3}});
  // Seen from below, where the plate hides nothing.
  Put(scene.mutable_camera()->mutable_eye(), {0, 0, 1});
  scene.mutable_camera()->set_near(.1);
  const Picture picture = Draw(scene);
  double worst = 0;
  for (uint32_t py = 20; py < 140; ++py) {
    for (uint32_t px = 20; px < 140; ++px) {
      const double x = (px + .5 - 80) / 40, y = (80 - (py + .5)) / 40;
      const double across = (c * x + s * y) / kTexel;  // texels past the edge
      // The integral of a cubic B-spline, near enough.
      const double ramp = std::clamp(.5 + across / 2.6, 0., 1.);
      const double eased = ramp * ramp * (3 - 2 * ramp);
      worst = std::max(worst, std::fabs(At(picture, px, py).r - eased));
    }
  }
  // Half a texel of the map is a third of the ramp.
  EXPECT_LT(worst, .34);
}

// A rough hill, a ball over it, a curve, the sea.
v1::FrameScene Mixed() {
  v1::FrameScene scene = PerspectiveScene(150, 101, {.3, -2.2, 1.3}, {0, 0, 0}, 40);
  scene.mutable_output()->set_samples(4);
  Put(scene.mutable_ambient(), {.1, .1, .15});
  AddSun(&scene, {1, -.3, .6}, {1, .9f, .8f});
  scene.mutable_light(0)->set_shadow(.012);
  const Result<Mesh> grid = MakeGrid(Vec3(3, 3, 0), 2, 2);
  v1::FrameObject* hill = AddMesh(&scene, *grid, {.5f, .45f, .4f});
  hill->mutable_material()->set_diffuse(.9);
  MakeRough(hill, .03, .3);
  const Result<Mesh> ball = MakeEllipsoid(Vec3(.3), 24, 12);
  v1::FrameObject* shiny = AddMesh(&scene, *ball, {.7f, .1f, .1f});
  Put(shiny->mutable_transform(), {1, 0, 0, .2, 0, 1, 0, -.2, 0, 0, 1, .5});
  shiny->mutable_material()->set_diffuse(.7);
  shiny->mutable_material()->set_specular(.6);
  shiny->mutable_material()->set_shininess(30);
  v1::FrameObject* line = AddObject(&scene, {{-1, -1, .4}, {1.2, .5, .6}}, {}, {1, 1, 0});
  line->set_curve(true);
  scene.mutable_sea()->set_level(-.02);
  Put(scene.mutable_sea()->mutable_color(), {.02, .06, .1});
  return scene;
}

TEST(ShadowTest, D4_OnePictureForEveryTileThreadAndPatch) {
  const v1::FrameScene scene = Mixed();
  const std::string wanted = DigestOf(scene);
  v1::FrameScene bright = scene;
  bright.mutable_light(0)->set_shadow(0);
  EXPECT_NE(DigestOf(bright), wanted);
  EXPECT_EQ(DigestOf(scene, {.threads = 3, .tile_size = 32}), wanted);
  EXPECT_EQ(DigestOf(scene, {.threads = 1, .tile_size = 512, .patch_size = 64}), wanted);
  const Picture whole = Draw(scene);
  const Result<RenderedFrame> tile = RenderTile(scene, 40, 30, 60, 50, {.threads = 1});
  ASSERT_TRUE(tile.ok());
  for (uint32_t y = 0; y < 50; ++y) {
    for (uint32_t x = 0; x < 60; ++x) {
      ASSERT_EQ(At(tile->picture, x, y), At(whole, 40 + x, 30 + y)) << x << ' ' << y;
    }
  }
}

// Tiles of one renderer share the maps that were drawn when it was made: a tile's own time and
// triangles do not hold them, and its shadows are the picture's.
TEST(ShadowTest, TilesOfOneRendererShareTheMaps) {
  const v1::FrameScene scene = Mixed();
  const Result<BuiltFrame> built = BuildFrame(scene);
  ASSERT_TRUE(built.ok());
  const Result<RenderedFrame> drawn = RenderRegion(*built, {0, 0, 150, 101}, {.threads = 1});
  ASSERT_TRUE(drawn.ok());
  const Picture& whole = drawn->picture;  // with maps of its own
  const auto renderer = FrameRenderer::Make(scene, {.threads = 2});
  ASSERT_TRUE(renderer.ok());
  for (const uint32_t x : {0u, 50u, 100u}) {
    const Result<RenderedFrame> tile = (*renderer)->Tile(x, 0, 50, 101, {.threads = 1});
    ASSERT_TRUE(tile.ok());
    for (uint32_t y = 0; y < 101; ++y) {
      for (uint32_t i = 0; i < 50; ++i) {
        ASSERT_EQ(At(tile->picture, i, y), At(whole, x + i, y)) << x + i << ' ' << y;
      }
    }
  }
  EXPECT_FALSE((*renderer)->Tile(150, 0, 1, 1, {}).ok());
}

// What comes and goes elsewhere moves the map, not its grid.
TEST(ShadowTest, TexelsStayWhereTheyAreInTheWorld) {
  const v1::FrameScene scene = Mixed();
  v1::FrameScene more = scene;
  // On all sides, out of sight: every edge of the map moves by a part of a texel.
  AddMatt(&more, {{-5.123, 9, .3}, {-5.2, 9, .3}, {-5.2, 9.1, .3}}, {{0, 1, 2}});
  AddMatt(&more, {{3.3171, -7.77, .013}, {3.4, -7.7, .013}, {3.4, -7.7, -2}}, {{0, 1, 2}});
  const Picture a = Draw(scene), b = Draw(more);
  float most = 0;
  for (uint32_t i = 0; i < 150 * 101; ++i) {
    const Rgb change = At(a, i % 150, i / 150) - At(b, i % 150, i / 150);
    for (int k = 0; k < 3; ++k) most = std::max(most, std::fabs(change[k]));
  }
  EXPECT_LT(most, 1e-4f);
}

// Nothing jumps when the sun's map is looked at from a place a hundredth of a texel further.
TEST(ShadowTest, ShadowsMoveSmoothly) {
  v1::FrameScene scene = Mixed();
  const Picture before = Draw(scene);
  v1::FrameObject* ball = scene.mutable_object(1);
  ball->set_transform(3, ball->transform(3) + .00012);
  const Picture after = Draw(scene);
  int jumps = 0;
  for (uint32_t i = 0; i < 150 * 101; ++i) {
    jumps += std::fabs(At(before, i % 150, i / 150).r - At(after, i % 150, i / 150).r) > .06f;
  }
  EXPECT_LT(jumps, 15) << "pixels at the ball's own outline may change sides";
}

TEST(ShadowTest, AMapThatWouldBeTooLargeIsAnErrorThatNamesWhatWouldDo) {
  v1::FrameScene scene = Lit(FlatScene(16, 16), {0, 0, 1});
  AddFloor(&scene, 1000);
  const auto rendered = RenderFrame(scene, {.threads = 1});
  ASSERT_FALSE(rendered.ok());
  EXPECT_EQ(rendered.error().code, ErrorCode::kLimit);
  EXPECT_NE(rendered.error().message.find("shadow_detail of"), std::string::npos)
      << rendered.error().message;
  const size_t at = rendered.error().message.find("shadow_detail of") + 17;
  scene.mutable_light(0)->set_shadow(std::stod(rendered.error().message.substr(at)));
  EXPECT_TRUE(RenderFrame(scene, {.threads = 1}).ok());
}

}  // namespace
}  // namespace fjord
