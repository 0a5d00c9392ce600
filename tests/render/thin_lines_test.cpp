// Strokes thinner than a pixel fade; they never fall into dots.
#include <algorithm>
#include <cmath>

#include "engine/render/fragments.h"
#include "tests/render/scenes.h"

namespace fjord {
namespace {

constexpr uint32_t kSize = 48;

// A white line across a black picture.
v1::FrameScene Line(double width, uint32_t samples, double slope = .3) {
  v1::FrameScene scene = FlatScene(kSize, kSize);
  scene.mutable_output()->set_samples(samples);
  v1::FrameObject* line =
      AddObject(&scene, {{-40, -40 * slope, 0}, {40, 40 * slope, 0}}, {}, Rgb(1));
  line->set_curve(true);
  line->mutable_material()->set_line_width(width);
  line->mutable_material()->set_fading(1);
  return scene;
}

// What each column of the picture shows of it.
std::vector<double> InkOfColumns(const Picture& picture) {
  std::vector<double> ink(kSize, 0);
  for (uint32_t x = 0; x < kSize; ++x) {
    for (uint32_t y = 0; y < kSize; ++y) ink[x] += At(picture, x, y).r;
  }
  return ink;
}

TEST(ThinLinesTest, HaveNoGapsAndFadeByTheirWidth) {
  for (const uint32_t samples : {1u, 4u, 16u}) {
    for (const double slope : {0., .3, .77, 1.}) {
      const std::vector<double> full = InkOfColumns(Draw(Line(1, samples, slope)));
      for (const double width : {.9, .5, .1, .01}) {
        const std::vector<double> ink = InkOfColumns(Draw(Line(width, samples, slope)));
        for (uint32_t x = 0; x < kSize; ++x) {
          ASSERT_GT(ink[x], .5 * width) << "a gap: " << samples << ' ' << slope << ' ' << x;
          ASSERT_NEAR(ink[x], full[x] * width, 1e-5) << samples << ' ' << width << ' ' << x;
        }
      }
    }
  }
}

// At a pixel's width the line is opaque, as it always was; just below nothing jumps.
TEST(ThinLinesTest, AreContinuousAtAPixel) {
  const Picture below = Draw(Line(.999, 4)), at = Draw(Line(1, 4));
  double largest = 0;
  for (uint32_t y = 0; y < kSize; ++y) {
    for (uint32_t x = 0; x < kSize; ++x) {
      largest = std::max<double>(largest, std::abs(At(below, x, y).r - At(at, x, y).r));
    }
  }
  EXPECT_LT(largest, .0011);
  v1::FrameScene opaque = Line(1, 4);
  opaque.mutable_object(0)->mutable_material()->set_fading(0);
  EXPECT_EQ(PixelDigest(at).Hex(), DigestOf(opaque));
}

// A line over itself, and joints, are no denser than the line.
TEST(ThinLinesTest, AreNoDenserWhereTheyOverlap) {
  v1::FrameScene scene = Line(.4, 4);
  v1::FrameObject* line = scene.mutable_object(0);
  Put(line->mutable_point(), {-20, -5, 0, 20, 5, 0, -20, 5, 1, 20, -5, 2, -20, -5, 3});
  const Picture picture = Draw(scene);
  float most = 0;
  for (uint32_t y = 0; y < kSize; ++y) {
    for (uint32_t x = 0; x < kSize; ++x) most = std::max(most, At(picture, x, y).r);
  }
  EXPECT_EQ(most, .4f);
}

// Two lines cross: the near one over the far one over what is behind, whatever their order.
TEST(ThinLinesTest, AreLaidOverEachOtherByDepth) {
  const auto middle = [](bool far_first) {
    v1::FrameScene scene = FlatScene(9, 9);
    Put(scene.mutable_background(), {.2, .2, .2, .2, .2, .2});
    for (const bool far : {far_first, !far_first}) {
      const double z = far ? 0 : 5;
      v1::FrameObject* line = far ? AddObject(&scene, {{-9, 0, z}, {9, 0, z}}, {}, Rgb(1, 0, 0))
                                  : AddObject(&scene, {{0, -9, z}, {0, 9, z}}, {}, Rgb(0, 1, 0));
      line->set_curve(true);
      line->mutable_material()->set_line_width(far ? .5 : .25);
      line->mutable_material()->set_fading(1);
    }
    return At(Draw(scene), 4, 4);
  };
  const Rgb seen = middle(true);
  EXPECT_EQ(middle(false), seen);
  EXPECT_FLOAT_EQ(seen.r, (.2f * .5f + .5f) * .75f);
  EXPECT_FLOAT_EQ(seen.g, .2f * .5f * .75f + .25f);
  EXPECT_FLOAT_EQ(seen.b, .2f * .5f * .75f);
}

// Land hides what lies behind it, the sea what lies below.
TEST(ThinLinesTest, AreHiddenAsEverythingIs) {
  v1::FrameScene scene = Line(.5, 1, 0);
  AddObject(&scene, {{-30, -30, 1}, {0, -30, 1}, {0, 30, 1}, {-30, 30, 1}}, {{0, 1, 2, 3}},
            {0, 0, .5f});
  const Picture picture = Draw(scene);
  EXPECT_EQ(InkOfColumns(picture)[10], 0);
  EXPECT_FLOAT_EQ(static_cast<float>(InkOfColumns(picture)[40]), .5f);
}

TEST(ThinLinesTest, FragmentsAreInOneOrder) {
  std::vector<Fragment> fragments = {{7, 1, .5}, {7, 0, .5}, {7, 2, .9}, {3, 4, .1}, {7, 3, .2}};
  SortFragments(&fragments);
  std::vector<uint32_t> owners;
  for (const Fragment& fragment : fragments) owners.push_back(fragment.owner);
  EXPECT_EQ(owners, (std::vector<uint32_t>{4, 3, 1, 0, 2}));
  EXPECT_EQ(FragmentsOf(fragments, 4, 8).size(), 4u);
  EXPECT_TRUE(FragmentsOf(fragments, 4, 7).empty());
}

}  // namespace
}  // namespace fjord
