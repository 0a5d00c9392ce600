// What shading finds out about a sample from its place in its coarse element, and textures on it.
#include <cmath>

#include "engine/geometry/primitives.h"
#include "engine/render/build.h"
#include "engine/render/tiles.h"
#include "engine/texture/registry.h"
#include "engine/texture/value_noise.h"
#include "tests/render/scenes.h"

namespace fjord {
namespace {

std::shared_ptr<const TextureChain> Chain(std::string_view name,
                                          const std::vector<NamedValue>& values) {
  std::vector<KnobDefect> defects;
  const StageInfo* info = FindTextureStage(name);
  auto chain = std::make_shared<TextureChain>();
  AppendStage(*info, info->knobs.Read(values, name, &defects), chain.get());
  EXPECT_TRUE(defects.empty());
  return chain;
}

BuiltFrame Built(const v1::FrameScene& scene) {
  Result<BuiltFrame> built = BuildFrame(scene);
  EXPECT_TRUE(built.ok());
  return std::move(*built);
}

Picture DrawBuilt(const BuiltFrame& frame, const RenderOptions& options = {.threads = 1}) {
  const TileRect whole{0, 0, static_cast<int32_t>(frame.width), static_cast<int32_t>(frame.height)};
  Result<RenderedFrame> rendered = RenderRegion(frame, whole, options);
  EXPECT_TRUE(rendered.ok());
  return rendered->picture;
}

// A plate of 32 x 32 units from above, a pixel a unit; unlit but for ambient light, so that colours
// are what textures made them.
v1::FrameScene Plate(bool rough) {
  v1::FrameScene scene = FlatScene(32, 32);
  const Result<Mesh> grid = MakeGrid(Vec3(32, 32, 0), 4, 4);
  v1::FrameObject* plate = AddMesh(&scene, *grid, Rgb(1));
  // Up and down only: from above everything stays where it is.
  if (rough) {
    v1::Parameter* direction = MakeRough(plate, 1.7, .6)->add_parameter();
    direction->set_name("direction");
    direction->add_text("UP");
  }
  return scene;
}

TEST(TextureTest, CheckerOnAGridStandsWhereUvSays) {
  for (const bool rough : {false, true}) {
    BuiltFrame frame = Built(Plate(rough));
    frame.objects[0].uv = {UvKind::kPlane, {32, 32, 0}};
    frame.objects[0].texture = Chain("checker", {{"across", {.numbers = {8}}},
                                                 {"down", {.numbers = {4}}},
                                                 {"color", {.numbers = {.25, 0, 0}}}});
    const Picture picture = DrawBuilt(frame);
    for (uint32_t y = 0; y < 32; ++y) {
      for (uint32_t x = 0; x < 32; ++x) {
        const uint32_t column = x / 4, row = (31 - y) / 8;
        const Rgb wanted = (column + row) % 2 == 1 ? Rgb(.25f, 0, 0) : Rgb(1);
        EXPECT_EQ(At(picture, x, y), wanted) << x << ' ' << y << (rough ? " rough" : "");
      }
    }
  }
}

TEST(TextureTest, StagesOfAFrameSceneAreDrawn) {
  v1::FrameScene scene = Plate(true);
  v1::FrameObject* plate = scene.mutable_object(0);
  plate->set_uv(1);
  Put(plate->mutable_uv_size(), {32, 32, 0});
  v1::FrameStage* stage = plate->mutable_material()->add_stage();
  stage->set_kind("checker");
  v1::Parameter* across = stage->add_parameter();
  across->set_name("across");
  across->add_number(2);
  BuiltFrame frame = Built(Plate(true));
  frame.objects[0].uv = {UvKind::kPlane, {32, 32, 0}};
  frame.objects[0].texture = Chain("checker", {{"across", {.numbers = {2}}}});
  EXPECT_EQ(PixelDigest(Draw(scene)), PixelDigest(DrawBuilt(frame)));
  EXPECT_NE(DigestOf(scene), DigestOf(Plate(true)));
  stage->set_kind("chequer");
  EXPECT_FALSE(RenderFrame(scene, {.threads = 1}).ok());
}

TEST(TextureTest, CheckerOnASphereFollowsLongitudeAndLatitude) {
  v1::FrameScene scene = FlatScene(64, 64);
  AddMesh(&scene, *MakeEllipsoid(Vec3(30), 96, 64), Rgb(1));
  BuiltFrame frame = Built(scene);
  frame.objects[0].uv = {UvKind::kSphere, Vec3(30)};
  frame.objects[0].texture =
      Chain("checker", {{"across", {.numbers = {6}}}, {"down", {.numbers = {4}}}});
  const Picture picture = DrawBuilt(frame);
  int checked = 0;
  for (uint32_t py = 0; py < 64; ++py) {
    for (uint32_t px = 0; px < 64; ++px) {
      const double x = px + .5 - 32, y = 32 - (py + .5), level = std::hypot(x, y);
      if (level > 28) continue;
      const double z = std::sqrt(900 - level * level);
      const double u = (std::atan2(y, x) / (2 * M_PI) + .5) * 6;
      const double v = (std::atan2(z, level) / M_PI + .5) * 4;
      if (std::fabs(u - std::round(u)) < .06 || std::fabs(v - std::round(v)) < .06) continue;
      const bool dark =
          (static_cast<int>(std::floor(u)) + static_cast<int>(std::floor(v))) % 2 != 0;
      EXPECT_EQ(At(picture, px, py).r < .5f, dark) << px << ' ' << py;
      ++checked;
    }
  }
  EXPECT_GT(checked, 1000);
}

// What noise gives at a place, as the stage mixes it.
float NoiseAt(const Vec3& rest, double width) {
  const double noise = NoiseSum(rest * (1 / width), 5, 3, .5);
  const double share = std::min(std::max(.5 + .5 * 1.5 * noise, 0.), 1.);
  return static_cast<float>(1 - share);
}

std::shared_ptr<const TextureChain> BlackNoise(double width) {
  return Chain("noise", {{"width", {.numbers = {width}}},
                         {"octaves", {.wholes = {3}}},
                         {"seed", {.wholes = {5}}},
                         {"color", {.numbers = {0, 0, 0}}}});
}

TEST(TextureTest, SolidNoiseIsThatOfTheRestPoseWhereverThingsMove) {
  for (const bool rough : {false, true}) {
    v1::FrameScene scene = Plate(rough);
    v1::FrameObject* plate = scene.mutable_object(0);
    *plate->mutable_rest() = plate->point();
    // Now: turned by a quarter, moved, and half as large along one side.
    for (int i = 0; i < plate->point_size(); i += 3) {
      const double x = plate->point(i), y = plate->point(i + 1);
      plate->set_point(i, -y * .5 + 3);
      plate->set_point(i + 1, x);
    }
    BuiltFrame frame = Built(scene);
    frame.objects[0].texture = BlackNoise(9);
    const Picture picture = DrawBuilt(frame);
    int seen = 0;
    for (uint32_t py = 1; py < 31; ++py) {
      for (uint32_t px = 12; px < 26; ++px) {
        const double x = px + .5 - 16, y = 16 - (py + .5);
        const Vec3 rest(y, (x - 3) * -2, 0);
        EXPECT_NEAR(At(picture, px, py).r, NoiseAt(rest, 9), 2e-5) << px << ' ' << py;
        ++seen;
      }
    }
    EXPECT_GT(seen, 300);
  }
}

TEST(TextureTest, VertexColoursRunEvenlyOverWhatIsMadeFine) {
  v1::FrameScene scene = Plate(true);
  v1::FrameObject* plate = scene.mutable_object(0);
  plate->mutable_material()->set_vertex_color(true);
  for (int i = 0; i < plate->point_size(); i += 3) {
    plate->add_color(.5 + plate->point(i) / 32);
    plate->add_color(.5 + plate->point(i + 1) / 32);
    plate->add_color(.25);
  }
  const Picture picture = Draw(scene);
  for (uint32_t y = 0; y < 32; ++y) {
    for (uint32_t x = 0; x < 32; ++x) {
      EXPECT_NEAR(At(picture, x, y).r, (x + .5) / 32, 1e-5);
      EXPECT_NEAR(At(picture, x, y).g, 1 - (y + .5) / 32, 1e-5);
      EXPECT_EQ(At(picture, x, y).b, .25f);
    }
  }
}

TEST(TextureTest, D4_OnePictureForEveryTileThreadPatchAndOrder) {
  v1::FrameScene scene = PerspectiveScene(150, 101, {.3, -2.2, 1.3}, {0, 0, 0}, 40);
  scene.mutable_output()->set_samples(4);
  AddSun(&scene, {1, -.3, .6}, {1, .9f, .8f});
  const Result<Mesh> grid = MakeGrid(Vec3(30, 30, 0), 3, 3);
  // Goes through the near plane: cut triangles have places too.
  v1::FrameObject* ground = AddMesh(&scene, *grid, {.9f, .8f, .7f});
  ground->mutable_material()->set_diffuse(.9);
  MakeRough(ground, .4, .05);
  v1::FrameObject* ball = AddMesh(&scene, *MakeEllipsoid(Vec3(.5), 24, 12), {.9f, .8f, .7f});
  ball->mutable_material()->set_diffuse(.9);
  ball->mutable_material()->set_smooth(true);
  const auto build = [](const v1::FrameScene& from) {
    BuiltFrame frame = Built(from);
    frame.objects[0].texture = BlackNoise(.7);
    frame.objects[1].texture = Chain("checker", {});
    frame.objects[1].uv = {UvKind::kSphere, Vec3(.5)};
    return frame;
  };
  const BuiltFrame frame = build(scene);
  const Digest wanted = PixelDigest(DrawBuilt(frame));
  EXPECT_EQ(PixelDigest(DrawBuilt(frame, {.threads = 3, .tile_size = 32})), wanted);
  EXPECT_EQ(PixelDigest(DrawBuilt(frame, {.threads = 1, .tile_size = 16, .patch_size = 64})),
            wanted);
  // Faces in the opposite order, each turned.
  for (v1::FrameObject& object : *scene.mutable_object()) {
    auto* vertex = object.mutable_face_vertex();
    if (object.face_size(0) != 3) continue;
    for (int i = 0, j = vertex->size() - 3; i < j; i += 3, j -= 3) {
      for (int k = 0; k < 3; ++k) vertex->SwapElements(i + k, j + (k + 1) % 3);
    }
  }
  EXPECT_EQ(PixelDigest(DrawBuilt(build(scene))), wanted);
}

}  // namespace
}  // namespace fjord
