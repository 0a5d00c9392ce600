// Nothing jumps while a shape moves (S25): as a segment or an edge swings past the direction that
// its midpoint moves in, the midpoint passes through the middle instead of changing sides.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/fractal/collect.h"

namespace fjord {
namespace {

using test::OutlineCurve;
using test::OutlineMesh;
using test::Prepare;
using test::Weld;

struct Swing {
  double proportion = 0;  // largest step of a vertex over that of the coarse ones
  double shortest = 1;    // direction of a new vertex: a segment lay along what it was made from
  bool same = true;       // identities
};

// `frames` poses, a turn of `step` from each to the next.
template <typename Pose>
Swing Watch(const FractalSettings& settings, const Pose& pose, double from, double step,
            int frames) {
  Swing swing;
  WeldedShape before;
  CoarseShape coarse_before;
  for (int frame = 0; frame <= frames; ++frame) {
    const CoarseShape coarse = pose(from + step * frame);
    WeldedShape now = Weld(*Prepare(coarse, settings));
    double largest = 0;
    double largest_coarse = 0;
    if (frame > 0) {
      swing.same = swing.same && now.identity == before.identity;
      for (size_t i = 0; swing.same && i < now.mesh.points.size(); ++i) {
        largest = std::max(largest, Length(now.mesh.points[i] - before.mesh.points[i]));
      }
      for (size_t i = 0; i < coarse.now.size(); ++i) {
        largest_coarse = std::max(largest_coarse, Length(coarse.now[i] - coarse_before.now[i]));
      }
      swing.proportion = std::max(swing.proportion, largest / largest_coarse);
    }
    for (size_t i = 0; i < now.level.size(); ++i) {
      if (now.level[i] > 0) swing.shortest = std::min(swing.shortest, Length(now.direction[i]));
    }
    before = std::move(now);
    coarse_before = coarse;
  }
  return swing;
}

// A segment that turns in the plane y = 0 about its first end; upright at a quarter turn.
CoarseShape Hand(double angle) {
  CoarseShape shape;
  shape.curve = true;
  shape.now = {{0, 0, 0}, {std::cos(angle), 0, std::sin(angle)}};
  shape.rest = {{0, 0, 0}, {1, 0, 0}};
  return shape;
}

FractalSettings Settings(const std::string& method, Direction direction, Variant variant, Law law,
                         double H, double epsilon) {
  FractalSettings s = test::SettingsOf(method, epsilon);
  s.direction = direction;
  s.variant = variant;
  s.law = law;
  s.H = H;
  s.amplitude = .5;
  return s;
}

constexpr double kUpright = 1.5707963267948966;

TEST(SwingTest, S25_ASegmentSwingsPastItsDirection) {
  for (const Variant variant : {Variant::kCurrent, Variant::kPerturbed}) {
    for (const Law law : {Law::kAffine, Law::kSimilar, Law::kShih}) {
      const auto s = Settings("curve", Direction::kUp, variant, law, .4, .3);
      const Swing swing = Watch(s, Hand, kUpright - .05, 1e-3, 100);
      EXPECT_TRUE(swing.same);
      EXPECT_LT(swing.shortest, .01);
      EXPECT_LT(swing.proportion, 6) << VariantName(variant) << LawName(law);
    }
  }
}

// One point of the outline is led round a small circle; the folds of a low H turn every way.
template <typename Shape>
auto Led(const Shape& shape, double radius) {
  return [shape, radius](double angle) {
    CoarseShape moved = shape;
    moved.now[3] += Vec3(radius * std::cos(angle), radius * std::sin(angle), 0);
    return moved;
  };
}

TEST(SwingTest, S25_FoldsOfALineTurnWithoutAJump) {
  for (const Variant variant : {Variant::kCurrent, Variant::kPerturbed}) {
    const auto s = Settings("curve", Direction::kVertex, variant, Law::kSimilar, .3, .1);
    const Swing swing = Watch(s, Led(OutlineCurve(), .3), 0, 4e-3, 1571);
    EXPECT_TRUE(swing.same);
    EXPECT_LT(swing.shortest, .3);
    EXPECT_LT(swing.proportion, 30) << VariantName(variant);
  }
}

TEST(SwingTest, S25_ACoastHasTheSameTrianglesAndNoneJumps) {
  for (const Direction direction : {Direction::kEdge, Direction::kVertex}) {
    for (const Law law : {Law::kAffine, Law::kSimilar}) {
      const auto s = Settings("coast", direction, Variant::kPerturbed, law, .5, .1);
      const Swing swing = Watch(s, Led(OutlineMesh(), .1), 0, 4e-3, 1571);
      EXPECT_TRUE(swing.same);
      EXPECT_LT(swing.proportion, 20) << DirectionName(direction) << LawName(law);
    }
  }
}

// Offsets that stay as they are while the edges below them grow: cuts become flatter and flatter.
TEST(SwingTest, S25_AGrowingCoastHasTheSameTrianglesAndNoneJumps) {
  const auto grown = [](double size) {
    CoarseShape shape = OutlineMesh();
    for (Vec3& p : shape.now) p = p * size;
    return shape;
  };
  for (const Direction direction : {Direction::kEdge, Direction::kVertex}) {
    auto s = Settings("coast", direction, Variant::kCurrent, Law::kAffine, .5, .1);
    s.stretch = false;
    const Swing swing = Watch(s, grown, .25, 1e-3, 1000);
    EXPECT_TRUE(swing.same);
    EXPECT_LT(swing.proportion, 20) << DirectionName(direction);
  }
}

// Two triangles that turn about the axis y, their edges along x upright at a quarter turn.
CoarseShape Door(double angle) {
  CoarseShape shape;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  shape.now = {{0, 0, 0}, {c, 0, s}, {c, 1, s}, {0, 1, 0}};
  shape.rest = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  shape.triangles = {{0, 1, 2}, {0, 2, 3}};
  return shape;
}

TEST(SwingTest, S25_AnEdgeOfASurfaceSwingsPastItsDirection) {
  for (const Variant variant : {Variant::kCurrent, Variant::kPerturbed}) {
    for (const Law law : {Law::kAffine, Law::kSimilar, Law::kShih}) {
      const auto s = Settings("surface", Direction::kUp, variant, law, .4, .3);
      const Swing swing = Watch(s, Door, kUpright - .05, 1e-3, 100);
      EXPECT_TRUE(swing.same);
      EXPECT_LT(swing.proportion, 15) << VariantName(variant) << LawName(law);
    }
  }
}

TEST(SwingTest, S22_S25_ACoastOfASurfaceSwingsPastTheUpright) {
  auto s = Settings("surface", Direction::kVertex, Variant::kFixed, Law::kAffine, .7, .3);
  s.coast = true;
  s.coast_H = .3;
  const Swing swing = Watch(s, Door, kUpright - .05, 1e-3, 100);
  EXPECT_TRUE(swing.same);
  EXPECT_LT(swing.proportion, 6);
}

}  // namespace
}  // namespace fjord
