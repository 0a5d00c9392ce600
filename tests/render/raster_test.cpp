// Coverage and depth against geometry worked out by hand.
#include <algorithm>

#include "engine/geometry/primitives.h"
#include "tests/render/scenes.h"

namespace fjord {
namespace {

const Rgb kRed(1, 0, 0), kGreen(0, 1, 0), kWhite(1);

// Two quads through each other along the line x = 0: z = x/2 and z = -x/2.
v1::FrameScene Crossing(bool swapped) {
  v1::FrameScene scene = FlatScene(40, 20);
  const std::vector<std::vector<uint32_t>> face = {{0, 1, 2, 3}};
  const auto red = [&] {
    AddObject(&scene, {{-15, -8, -7.5}, {15, -8, 7.5}, {15, 8, 7.5}, {-15, 8, -7.5}}, face, kRed);
  };
  const auto green = [&] {
    AddObject(&scene, {{-15, -8, 7.5}, {15, -8, -7.5}, {15, 8, -7.5}, {-15, 8, 7.5}}, face, kGreen);
  };
  swapped ? (green(), red()) : (red(), green());
  return scene;
}

TEST(RasterTest, W38_C24_G27_CrossingQuadsSplitAtTheExactLine) {
  const Picture picture = Draw(Crossing(false));
  for (uint32_t y = 2; y < 18; ++y) {
    for (uint32_t x = 0; x < 40; ++x) {
      const Rgb expected = x < 5 || x >= 35 ? Rgb(0) : x < 20 ? kGreen : kRed;
      EXPECT_EQ(At(picture, x, y), expected) << x << ' ' << y;
    }
  }
  EXPECT_EQ(At(picture, 20, 1), Rgb(0));
  EXPECT_EQ(At(picture, 20, 18), Rgb(0));
}

TEST(RasterTest, W38_C24_G27_DrawOrderIsIrrelevant) {
  EXPECT_EQ(DigestOf(Crossing(false)), DigestOf(Crossing(true)));
  // Also within an object, with equal depths: two faces that share their plane.
  const std::vector<Vec3> points = {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0},
                                    {-6, -4, 0}, {6, -4, 0}, {0, 7, 0}};
  v1::FrameScene one = FlatScene(20, 20), two = one;
  AddObject(&one, points, {{0, 1, 2}, {3, 4, 5}}, kRed);
  AddObject(&two, points, {{4, 5, 3}, {2, 0, 1}}, kRed);
  for (v1::FrameScene* scene : {&one, &two}) {
    v1::FrameObject* object = scene->mutable_object(0);
    for (const double c : {1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}) {
      object->add_color(c);
    }
    object->mutable_material()->set_vertex_color(true);
  }
  EXPECT_EQ(DigestOf(one), DigestOf(two));
}

double EdgeError(uint32_t samples) {
  // The half plane below the line y = x, moved so that pixels are cut everywhere.
  v1::FrameScene scene = FlatScene(32, 32);
  scene.mutable_output()->set_samples(samples);
  AddObject(&scene, {{-40, -40.37, 0}, {40, -40.37, 0}, {40, 39.63, 0}}, {{0, 1, 2}}, kWhite);
  const Picture picture = Draw(scene);
  double error = 0;
  for (uint32_t y = 0; y < 32; ++y) {
    for (uint32_t x = 0; x < 32; ++x) {
      double covered = 0;
      for (int i = 0; i < 4096; ++i) {
        const double px = x + (i % 64 + .5) / 64 - 16, py = 16 - (y + (i / 64 + .5) / 64);
        covered += py < px - .37 ? 1. / 4096 : 0;
      }
      const double off = At(picture, x, y).r - covered;
      error += off * off;
    }
  }
  return error;
}

TEST(RasterTest, W39_MoreSamplesComeCloserToTheReference) {
  const double one = EdgeError(1), four = EdgeError(4), sixteen = EdgeError(16);
  EXPECT_LT(four, .5 * one);
  EXPECT_LT(sixteen, .5 * four);
}

TEST(RasterTest, W39_DiagonalEdgeHasIntermediateLevels) {
  v1::FrameScene scene = FlatScene(32, 32);
  scene.mutable_output()->set_samples(4);
  AddObject(&scene, {{-40, -40.37, 0}, {40, -40.37, 0}, {40, 39.63, 0}}, {{0, 1, 2}}, kWhite);
  const Picture picture = Draw(scene);
  int between = 0;
  for (uint32_t y = 0; y < 32; ++y) {
    for (uint32_t x = 0; x < 32; ++x) {
      const float level = At(picture, x, y).r;
      between += level > 0 && level < 1 ? 1 : 0;
    }
  }
  EXPECT_GE(between, 31);
}

TEST(RasterTest, SharedEdgesBelongToExactlyOneTriangle) {
  // A fan of slivers and large triangles round odd places; pixels counted triangle by triangle.
  const std::vector<Vec3> points = {{-12, -12, 0}, {12, -12, 0}, {12, 12, 0},   {-12, 12, 0},
                                    {.5, .5, 0},   {3, -7, 0},   {-2.5, 4.5, 0}};
  const std::vector<std::vector<uint32_t>> faces = {{0, 5, 6}, {0, 1, 5}, {5, 1, 4}, {1, 2, 4},
                                                    {4, 2, 6}, {2, 3, 6}, {3, 0, 6}, {5, 4, 6}};
  for (const double scale : {1., .05, 4.}) {
    std::vector<Vec3> scaled = points;
    for (Vec3& p : scaled) p = p * scale;
    std::vector<int> count(64 * 64, 0);
    for (const auto& face : faces) {
      v1::FrameScene scene = FlatScene(64, 64);
      AddObject(&scene, scaled, {face}, kWhite);
      const Picture picture = Draw(scene);
      for (uint32_t i = 0; i < 64 * 64; ++i) count[i] += At(picture, i % 64, i / 64).r > 0 ? 1 : 0;
    }
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const double px = x + .5 - 32, py = 32 - (y + .5), half = 12 * scale;
        const bool inside = px > -half && px < half && py > -half && py < half;
        EXPECT_EQ(count[y * 64 + x], inside ? 1 : 0) << x << ' ' << y << ' ' << scale;
      }
    }
  }
}

TEST(RasterTest, DenseSphereLetsNoBackgroundThrough) {
  for (const uint32_t samples : {1u, 4u, 16u}) {
    v1::FrameScene scene = FlatScene(64, 64);
    scene.mutable_output()->set_samples(samples);
    Put(scene.mutable_background(), {0, 50, 0, 0, 50, 0});
    const Result<Mesh> sphere = MakeEllipsoid(Vec3(24), 180, 120);
    ASSERT_TRUE(sphere.ok());
    AddMesh(&scene, *sphere, kRed);
    const Picture picture = Draw(scene);
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const double px = x - 31.5, py = y - 31.5;
        if (px * px + py * py < 22. * 22) {
          EXPECT_EQ(At(picture, x, y).g, 0) << x << ' ' << y;
        }
      }
    }
  }
}

TEST(RasterTest, NearPlaneCutsAndNothingBehindTheEyeIsSeen) {
  // A floor from behind the eye to far away: seen below the horizon only, right up to the lower
  // edge.
  v1::FrameScene scene = PerspectiveScene(64, 64, {0, 0, 1}, {0, 10, 1}, 60);
  AddObject(&scene, {{-1000, -500, 0}, {1000, -500, 0}, {1000, 500, 0}, {-1000, 500, 0}},
            {{0, 1, 2, 3}}, kWhite);
  const Picture picture = Draw(scene);
  for (uint32_t x = 0; x < 64; ++x) {
    for (uint32_t y = 0; y < 64; ++y) {
      EXPECT_EQ(At(picture, x, y).r, y < 32 ? 0 : 1) << x << ' ' << y;
    }
  }
  v1::FrameScene behind = PerspectiveScene(32, 32, {0, 0, 1}, {0, 10, 1}, 60);
  AddObject(&behind, {{-9, -5, -9}, {9, -5, -9}, {0, -5, 9}}, {{0, 1, 2}}, kWhite);
  const Picture nothing = Draw(behind);
  for (uint32_t i = 0; i < 32 * 32; ++i) EXPECT_EQ(At(nothing, i % 32, i / 32).r, 0);
}

TEST(RasterTest, HugeAndTinyTriangles) {
  v1::FrameScene huge = FlatScene(16, 16);
  AddObject(&huge, {{-1e9, -1e9, 0}, {1e9, -1e9, 0}, {0, 2e9, 0}}, {{0, 1, 2}}, kWhite);
  const Picture full = Draw(huge);
  for (uint32_t i = 0; i < 256; ++i) EXPECT_EQ(At(full, i % 16, i / 16), kWhite);

  // Smaller than the fixed grid, and without any area: not seen, not harmful.
  v1::FrameScene tiny = FlatScene(16, 16);
  AddObject(&tiny, {{0, 0, 0}, {1e-9, 0, 0}, {0, 1e-9, 0}, {5, 5, 0}}, {{0, 1, 2}, {0, 3, 3}},
            kWhite);
  const Picture empty = Draw(tiny);
  for (uint32_t i = 0; i < 256; ++i) EXPECT_EQ(At(empty, i % 16, i / 16), Rgb(0));
}

TEST(RasterTest, OnePixelPictures) {
  v1::FrameScene scene = FlatScene(1, 1);
  AddObject(&scene, {{-5, -5, 0}, {5, -5, 0}, {0, 5, 0}}, {{0, 1, 2}}, kGreen);
  EXPECT_EQ(At(Draw(scene), 0, 0), kGreen);
  scene.mutable_output()->set_samples(16);
  EXPECT_EQ(At(Draw(scene), 0, 0), kGreen);
}

TEST(RasterTest, W36_PositionAndColorInterpolateAsGeometrySays) {
  // A wall that runs away from the eye, coloured by its own coordinates: each pixel must show the
  // coordinates where its ray meets the wall (perspective-correct).
  v1::FrameScene scene = PerspectiveScene(48, 48, {0, 0, 0}, {0, 1, 0}, 50);
  const std::vector<Vec3> points = {{-1, 2, -1}, {3, 6, -3}, {3, 6, 3}, {-1, 2, 1}};
  v1::FrameObject* wall = AddObject(&scene, points, {{0, 1, 2, 3}}, kWhite);
  for (const Vec3& p : points) {
    wall->add_color(p.x + 2);
    wall->add_color(p.y);
    wall->add_color(p.z + 4);
  }
  wall->mutable_material()->set_vertex_color(true);
  const Picture picture = Draw(scene);
  const double focal = 24 / (exact::Sin(25 * exact::kPi / 180) / exact::Cos(25 * exact::kPi / 180));
  int seen = 0;
  for (uint32_t y = 0; y < 48; ++y) {
    for (uint32_t x = 0; x < 48; ++x) {
      const Rgb color = At(picture, x, y);
      if (color == Rgb(0)) continue;
      ++seen;
      // y = x + 3 meets (rx, 1, rz) t
      const double rx = (x + .5 - 24) / focal, rz = (24 - (y + .5)) / focal;
      const double t = 3 / (1 - rx);
      EXPECT_NEAR(color.r, rx * t + 2, 2e-2) << x << ' ' << y;
      EXPECT_NEAR(color.g, t, 2e-2) << x << ' ' << y;
      EXPECT_NEAR(color.b, rz * t + 4, 2e-2) << x << ' ' << y;
    }
  }
  EXPECT_GT(seen, 500);
}

TEST(RasterTest, StrokesHaveTheirWidth) {
  v1::FrameScene scene = FlatScene(64, 32);
  scene.mutable_output()->set_samples(16);
  v1::FrameObject* line = AddObject(&scene, {{-20, 0, 0}, {20, 0, 0}}, {}, kWhite);
  line->set_curve(true);
  line->mutable_material()->set_line_width(5);
  const Picture picture = Draw(scene);
  for (uint32_t x = 14; x < 50; ++x) {
    float sum = 0;
    for (uint32_t y = 0; y < 32; ++y) sum += At(picture, x, y).r;
    EXPECT_NEAR(sum, 5, .01) << x;
  }
  EXPECT_EQ(At(picture, 5, 16).r, 0);
}

TEST(RasterTest, ClosedCurvesAreFilledByWinding) {
  v1::FrameScene scene = FlatScene(48, 32);
  v1::FrameObject* star = AddObject(
      &scene, {{-18, -10, 0}, {18, -10, 0}, {18, 10, 0}, {0, -4, 0}, {-18, 10, 0}}, {}, kWhite);
  star->set_curve(true);
  star->set_closed(true);
  star->mutable_material()->set_fill(true);
  star->mutable_material()->set_line_width(0);
  const Picture picture = Draw(scene);
  for (uint32_t y = 0; y < 32; ++y) {
    for (uint32_t x = 0; x < 48; ++x) {
      const double px = x + .5 - 24, py = 16 - (y + .5);
      const double notch = -4 + 14. / 18 * (px < 0 ? -px : px);
      const bool inside = px > -18 && px < 18 && py > -10 && py < notch && py < 10;
      if (py - notch < 1e-6 && notch - py < 1e-6) continue;  // on the border
      EXPECT_EQ(At(picture, x, y).r, inside ? 1 : 0) << x << ' ' << y;
    }
  }
  for (const int tile : {16, 32}) {
    EXPECT_EQ(DigestOf(scene, {.threads = 1, .tile_size = tile}), PixelDigest(picture).Hex());
  }
  // An orthographic view has no eye to be behind.
  Put(scene.mutable_camera()->mutable_eye(), {0, 0, 5});
  EXPECT_EQ(DigestOf(scene), PixelDigest(picture).Hex());
}

}  // namespace
}  // namespace fjord
