// Light against numbers worked out by hand.
#include <algorithm>
#include <cmath>

#include "engine/geometry/primitives.h"
#include "tests/render/scenes.h"

namespace fjord {
namespace {

constexpr double kSin60 = 0.8660254037844386;

// A plate that fills the picture, seen from above.
v1::FrameScene Plate(const Rgb& color, double diffuse, double ambient = 0) {
  v1::FrameScene scene = FlatScene(16, 16);
  v1::FrameObject* plate = AddObject(
      &scene, {{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}}, {{0, 1, 2, 3}}, color);
  plate->mutable_material()->set_ambient(ambient);
  plate->mutable_material()->set_diffuse(diffuse);
  return scene;
}

void ExpectColor(const Rgb& got, const Rgb& wanted, float tolerance = 1e-6f) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[k], wanted[k], tolerance) << "channel " << k;
}

TEST(ShadeTest, W40_PlateAt60DegreesIsHalfAsBright) {
  v1::FrameScene straight = Plate({.8, .4, .2}, .5), slanted = straight;
  AddSun(&straight, {0, 0, 3}, Rgb(1, .5f, 1));
  AddSun(&slanted, {kSin60, 0, .5}, Rgb(1, .5f, 1));
  ExpectColor(At(Draw(straight), 8, 8), {.4, .1, .1});
  ExpectColor(At(Draw(slanted), 8, 8), {.2, .05, .05});
}

TEST(ShadeTest, W40_LightFromBehindGivesNothingAndBothSidesAreLit) {
  v1::FrameScene scene = Plate({1, 1, 1}, 1);
  AddSun(&scene, {0, 0, -1}, Rgb(1));
  ExpectColor(At(Draw(scene), 8, 8), Rgb(0));
  // The same plate wound the other way round is the same picture.
  v1::FrameScene lit = Plate({1, 1, 1}, 1), turned = FlatScene(16, 16);
  AddObject(&turned, {{-50, -50, 0}, {-50, 50, 0}, {50, 50, 0}, {50, -50, 0}}, {{0, 1, 2, 3}},
            Rgb(1));
  turned.mutable_object(0)->mutable_material()->set_ambient(0);
  turned.mutable_object(0)->mutable_material()->set_diffuse(1);
  AddSun(&lit, {1, 1, 2}, Rgb(1));
  AddSun(&turned, {1, 1, 2}, Rgb(1));
  EXPECT_EQ(DigestOf(lit), DigestOf(turned));
}

// Share of a shiny sphere's pixels that are brighter than half the highlight.
int HighlightWidth(double shininess) {
  v1::FrameScene scene = FlatScene(96, 96);
  const Result<Mesh> sphere = MakeEllipsoid(Vec3(44), 96, 64);
  v1::FrameMaterial* material = AddMesh(&scene, *sphere, Rgb(0))->mutable_material();
  material->set_ambient(0);
  material->set_specular(1);
  material->set_shininess(shininess);
  material->set_smooth(true);
  AddSun(&scene, {0, 0, 1}, Rgb(1));
  const Picture picture = Draw(scene);
  int wide = 0;
  for (uint32_t i = 0; i < 96 * 96; ++i) wide += At(picture, i % 96, i / 96).r > .5f ? 1 : 0;
  return wide;
}

TEST(ShadeTest, W41_HighlightNarrowsWithItsExponent) {
  int last = 1 << 30;
  for (const double n : {1., 2.5, 10., 50., 50.5, 200.}) {
    const int width = HighlightWidth(n);
    EXPECT_LT(width, last) << n;
    EXPECT_GT(width, 0) << n;
    last = width;
  }
  EXPECT_EQ(HighlightWidth(0), 0) << "W42: n = 0 has no highlight";
}

TEST(ShadeTest, W41_HighlightIsWhatTheSurfaceLeavesOfTheLight) {
  // Light, normal and eye in one line: N.H = 1. C + (I - C) ks, with I - C never below 0.
  v1::FrameScene scene = Plate({.25, .5, 1.5}, 0);
  v1::FrameMaterial* material = scene.mutable_object(0)->mutable_material();
  material->set_specular(.5);
  material->set_shininess(10);
  AddSun(&scene, {0, 0, 1}, Rgb(1));
  ExpectColor(At(Draw(scene), 8, 8), {.375, .25, 0}, 1e-5f);
}

TEST(ShadeTest, W41_ExponentMatchesTheFormula) {
  for (const double n : {7., 7.25}) {
    v1::FrameScene scene = Plate({0, 0, 0}, 0);
    v1::FrameMaterial* material = scene.mutable_object(0)->mutable_material();
    material->set_specular(1);
    material->set_shininess(n);
    AddSun(&scene, {kSin60, 0, .5}, Rgb(1));  // H is 30 degrees off
    const double wanted = exact::Pow(kSin60, n);
    EXPECT_NEAR(At(Draw(scene), 8, 8).r, wanted, 1e-5) << n;
  }
}

TEST(ShadeTest, W42_LocalLightFallsOffWithRange) {
  // Straight above the middle of the plate, at half its range: factor .25.
  v1::FrameScene scene = Plate({1, 1, 1}, 1);
  scene.mutable_output()->set_width(17);
  scene.mutable_output()->set_height(17);
  scene.mutable_camera()->set_view_height(17);
  v1::FrameLight* light = scene.add_light();
  light->set_local(true);
  Put(light->mutable_place(), {0, 0, 20});
  Put(light->mutable_color(), {1, 1, 1});
  light->set_range(40);
  ExpectColor(At(Draw(scene), 8, 8), Rgb(.25f), 1e-5f);
  light->set_range(20);
  ExpectColor(At(Draw(scene), 8, 8), Rgb(0));
  // 3 pixels to the side of it
  light->set_range(40);
  const double d = std::sqrt(9. + 400), left = 1 - d / 40;
  ExpectColor(At(Draw(scene), 11, 8), Rgb(static_cast<float>(left * left * 20 / d)), 1e-5f);
}

TEST(ShadeTest, W42_SixteenLightsAddUp) {
  v1::FrameScene scene = Plate({1, 1, 1}, 1, .5);
  for (int i = 0; i < 20; ++i) AddSun(&scene, {0, 0, 1.}, Rgb(.01f * (i + 1)));
  ExpectColor(At(Draw(scene), 8, 8), Rgb(.5f + 2.1f), 1e-5f);
}

TEST(ShadeTest, W42_OutputIsClamped) {
  v1::FrameScene scene = Plate({1, 1, 1}, 40);
  scene.mutable_output()->set_format(0);
  AddSun(&scene, {0, 0, 1}, Rgb(1));
  EXPECT_EQ(Draw(scene).bytes[0], 255);
}

TEST(ShadeTest, C21_KnownFacetAndLightsGiveKnownColor) {
  // Ambient .2 .4 .6, half of it kept; sun at 60 degrees; one facet leant by 30 degrees.
  v1::FrameScene scene = FlatScene(16, 16);
  Put(scene.mutable_ambient(), {.2, .4, .6});
  v1::FrameObject* facet =
      AddObject(&scene, {{-50, -50, 0}, {50, -50, 0}, {0, 50, 57.735026918962575}}, {{0, 1, 2}},
                {.5, .5, .5});  // normal (0, -1/2, sqrt(3)/2)
  facet->mutable_material()->set_ambient(.5);
  facet->mutable_material()->set_diffuse(.8);
  AddSun(&scene, {0, 0, 1}, Rgb(1, 1, 0));
  AddSun(&scene, {0, -1, 0}, Rgb(0, 0, 1));
  const float d1 = static_cast<float>(.8 * kSin60 * .5), d2 = .8f * .5f * .5f;
  ExpectColor(At(Draw(scene), 8, 8), {.05f + d1, .1f + d1, .15f + d2}, 1e-5f);
}

TEST(ShadeTest, C21_DirectionalLightDoesNotCareWhereTheFacetIs) {
  const auto shade = [](double z, bool local) {
    v1::FrameScene scene = FlatScene(9, 9);
    AddObject(&scene, {{-50, -50, z}, {50, -50, z}, {0, 50, z}}, {{0, 1, 2}}, Rgb(1));
    scene.mutable_object(0)->mutable_material()->set_ambient(0);
    scene.mutable_object(0)->mutable_material()->set_diffuse(1);
    v1::FrameLight* light = scene.add_light();
    light->set_local(local);
    light->set_range(1000);
    Put(light->mutable_place(), {30, 0, 30});
    Put(light->mutable_color(), {1, 1, 1});
    return At(Draw(scene), 4, 4).r;
  };
  EXPECT_EQ(shade(0, false), shade(20, false));
  EXPECT_GT(shade(0, true), shade(20, true) + .01f);
}

TEST(ShadeTest, C21_TheEyesPlaceChangesHighlightsOnly) {
  const auto shade = [](double x, double specular) {
    v1::FrameScene scene = PerspectiveScene(9, 9, {x, 0, 10}, {0, 0.001, 0}, 10);
    AddObject(&scene, {{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}}, {{0, 1, 2, 3}}, Rgb(.5f));
    v1::FrameMaterial* material = scene.mutable_object(0)->mutable_material();
    material->set_diffuse(1);
    material->set_specular(specular);
    material->set_shininess(20);
    AddSun(&scene, {1, 0, 1}, Rgb(1));
    return At(Draw(scene), 4, 4).r;
  };
  EXPECT_NEAR(shade(-10, 0), shade(5, 0), 1e-6);
  EXPECT_GT(shade(-10, 1), shade(5, 1) + .1f);
}

TEST(ShadeTest, C23_OneColorAFacetAndSmoothTurnsNormals) {
  v1::FrameScene scene = FlatScene(32, 32);
  // A roof: two facets, ridge along y.
  const std::vector<Vec3> points = {{-12, -12, 0}, {0, -12, 6},  {0, 12, 6},
                                    {-12, 12, 0},  {12, -12, 0}, {12, 12, 0}};
  v1::FrameObject* roof = AddObject(&scene, points, {{0, 1, 2, 3}, {1, 4, 5, 2}}, Rgb(1));
  roof->mutable_material()->set_ambient(0);
  roof->mutable_material()->set_diffuse(1);
  AddSun(&scene, {-1, 0, 0}, Rgb(1));
  const Picture flat = Draw(scene);
  const double n = 6 / std::sqrt(180.);
  for (uint32_t x = 5; x < 16; ++x) ExpectColor(At(flat, x, 16), Rgb(static_cast<float>(n)));
  for (uint32_t x = 17; x < 27; ++x) ExpectColor(At(flat, x, 16), Rgb(0));
  roof->mutable_material()->set_smooth(true);
  const Picture smooth = Draw(scene);
  EXPECT_NEAR(At(smooth, 4, 16).r, n, .03);
  EXPECT_NEAR(At(smooth, 16, 16).r, 0, .03);
  for (uint32_t x = 5; x < 16; ++x) EXPECT_LT(At(smooth, x, 16).r, At(smooth, x - 1, 16).r);
}

TEST(ShadeTest, W36_InterpolatedNormalMatchesTheFormula) {
  v1::FrameScene scene = FlatScene(32, 32);
  // An octahedron's upper half: vertex normals are known, so is their mix.
  const std::vector<Vec3> points = {{12, 0, 0},  {0, 12, 0}, {-12, 0, 0},
                                    {0, -12, 0}, {0, 0, 12}, {0, 0, -12}};
  v1::FrameObject* shape = AddObject(
      &scene, points,
      {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}},
      Rgb(1));
  shape->mutable_material()->set_ambient(0);
  shape->mutable_material()->set_diffuse(1);
  shape->mutable_material()->set_smooth(true);
  AddSun(&scene, {1, 0, 0}, Rgb(1));
  const Picture picture = Draw(scene);
  for (uint32_t x = 17; x < 27; ++x) {
    for (uint32_t y = 10; y < 16; ++y) {
      const double px = x + .5 - 16, py = 16 - (y + .5);
      if (px + py > 11.5) continue;
      const double a = px / 12, b = py / 12, c = 1 - a - b;
      EXPECT_NEAR(At(picture, x, y).r, a / std::sqrt(a * a + b * b + c * c), 2e-3) << x << ' ' << y;
    }
  }
}

TEST(ShadeTest, S29_RampColorsByHeight) {
  // A slope whose height is its x: 0 at the left edge of the picture, 16 at the right.
  v1::FrameScene scene = FlatScene(16, 16);
  v1::FrameObject* slope =
      AddObject(&scene, {{-20, -50, -12}, {20, -50, 28}, {20, 50, 28}, {-20, 50, -12}},
                {{0, 1, 2, 3}}, Rgb(9));
  for (const double v : {4., 1., 0., 0., 8., 0., 1., 0., 8., 0., 0., 0., 12., 0., 0., 1.}) {
    slope->mutable_material()->add_ramp(v);
  }
  const Picture picture = Draw(scene);
  for (uint32_t x = 0; x < 16; ++x) {
    const float z = x + .5f;
    Rgb wanted(0);
    if (z <= 4)
      wanted = {1, 0, 0};
    else if (z < 8)
      wanted = {1 - (z - 4) / 4, (z - 4) / 4, 0};
    else if (z < 12)
      wanted = {0, 0, (z - 8) / 4};
    else
      wanted = {0, 0, 1};
    ExpectColor(At(picture, x, 8), wanted, 1e-4f);
  }
}

TEST(ShadeTest, S29_RampReadsObjectHeightWhateverTheTransform) {
  v1::FrameScene scene = FlatScene(16, 16);
  v1::FrameObject* plate =
      AddObject(&scene, {{-50, -50, 1.25}, {50, -50, 1.25}, {50, 50, 1.25}, {-50, 50, 1.25}},
                {{0, 1, 2, 3}}, Rgb(0));
  for (const double v : {1., 0., 0., 0., 2., 1., 1., 1.}) plate->mutable_material()->add_ramp(v);
  Put(plate->mutable_transform(), {2, 0, 0, 3, 0, 2, 0, 4, 0, 0, 7, -5});
  ExpectColor(At(Draw(scene), 8, 8), Rgb(.25f), 1e-5f);
}

TEST(ShadeTest, W43_OtherObjectsPixelsStayAsTheyAre) {
  v1::FrameScene alone = FlatScene(32, 16), both = alone;
  for (v1::FrameScene* scene : {&alone, &both}) {
    v1::FrameObject* left =
        AddObject(scene, {{-15, -7, 0}, {-2, -7, 0}, {-2, 7, 5}}, {{0, 1, 2}}, {.3f, .6f, .9f});
    left->mutable_material()->set_diffuse(.5);
    AddSun(scene, {1, 2, 3}, Rgb(1));
  }
  v1::FrameMaterial* other =
      AddObject(&both, {{2, -7, 0}, {15, -7, 0}, {2, 7, 3}}, {{0, 1, 2}}, Rgb(1))
          ->mutable_material();
  other->set_specular(1);
  other->set_shininess(33.3);
  other->set_smooth(true);
  const Picture a = Draw(alone), b = Draw(both);
  for (uint32_t y = 0; y < 16; ++y) {
    for (uint32_t x = 0; x < 16; ++x) EXPECT_EQ(At(a, x, y), At(b, x, y));
  }
}

TEST(ShadeTest, BackgroundIsAVerticalGradient) {
  v1::FrameScene scene = FlatScene(4, 8);
  Put(scene.mutable_background(), {1, 0, 0, 0, 1, 0});
  const Picture picture = Draw(scene);
  for (uint32_t y = 0; y < 8; ++y) {
    const float t = (y + .5f) / 8;
    ExpectColor(At(picture, 2, y), {1 - t, t, 0});
  }
}

TEST(ShadeTest, SeaMeetsTheSkyWithoutALineAndLandAtItsLevelShows) {
  v1::FrameScene scene = PerspectiveScene(64, 128, {0, 0, 2}, {0, 10, 2}, 60);
  Put(scene.mutable_background(), {.2, .4, .8, .8, .8, .8});
  v1::FrameSea* sea = scene.mutable_sea();
  sea->set_level(0);
  Put(sea->mutable_color(), {.02, .05, .08});
  AddSun(&scene, {1, 1, 1}, Rgb(1));
  const Picture picture = Draw(scene);
  // a row above and below the horizon
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(At(picture, 32, 63)[k], At(picture, 32, 64)[k], .04);
  EXPECT_GT(At(picture, 32, 64).b, At(picture, 32, 127).b + .2f) << "darker underfoot";
  // Land exactly in the plane of the sea is land, everywhere.
  v1::FrameScene land = scene;
  AddObject(&land, {{-40, 3, 0}, {40, 3, 0}, {40, 90, 0}, {-40, 90, 0}}, {{0, 1, 2, 3}}, {1, 0, 0});
  v1::FrameScene dry = land;
  dry.clear_sea();
  const Picture wet = Draw(land), without = Draw(dry);
  int shown = 0;
  for (uint32_t y = 0; y < 128; ++y) {
    for (uint32_t x = 0; x < 64; ++x) {
      const bool is_land = At(without, x, y) == Rgb(1, 0, 0);
      shown += is_land ? 1 : 0;
      EXPECT_EQ(At(wet, x, y) == Rgb(1, 0, 0), is_land) << x << ' ' << y;
    }
  }
  EXPECT_GT(shown, 1000);
  // Below the level it is not.
  v1::FrameScene sunk = scene;
  AddObject(&sunk, {{-40, 3, -.5}, {40, 3, -.5}, {40, 90, -.5}, {-40, 90, -.5}}, {{0, 1, 2, 3}},
            {1, 0, 0});
  EXPECT_EQ(DigestOf(sunk), DigestOf(scene));
}

}  // namespace
}  // namespace fjord
