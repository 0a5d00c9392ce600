#include "engine/fractal/surface.h"

#include <gtest/gtest.h>

#include <mutex>

#include "engine/base/parallel.h"
#include "tests/fractal/surface_shapes.h"

namespace fjord::test {
namespace {

struct Variety {
  std::string name;
  FractalSettings settings;
};

// Every law, direction, variant and split, with and without coasts.
std::vector<Variety> Varieties() {
  std::vector<Variety> all;
  const MethodInfo& method = *FindFractalMethod("surface");
  for (const Law law : LawsOf(method)) {
    for (const Direction direction : DirectionsOf(method)) {
      for (const Variant variant : VariantsOf(method)) {
        for (const Split split : kSplits) {
          for (const bool coast : {false, true}) {
            FractalSettings settings = PixelSettings(2, 60, Vec3(0, 0, 6), coast ? .5 : 0);
            settings.law = law;
            settings.direction = direction;
            settings.variant = variant;
            settings.split = split;
            settings.coast = coast;
            settings.max_level = 3;
            settings.uniforms = coast ? 7 : 4;
            // One of the six pairs of split and coast keeps to plain halving.
            if (coast && split == Split::kShot) settings.increments = Increments::kMidpoint;
            all.push_back({std::string(LawName(law)) + ' ' + std::string(DirectionName(direction)) +
                               ' ' + std::string(VariantName(variant)) + ' ' +
                               std::string(SplitName(split)) + (coast ? " coast" : ""),
                           settings});
          }
        }
      }
    }
  }
  return all;
}

TEST(SurfaceTest, S24_StreamedIsWeldedBitForBitInEveryVarietyAtEverySimdLevel) {
  for (const Variety& one : Varieties()) {
    const auto prepared = Prepare(Island(), one.settings);
    const std::vector<Leaf> truth = WeldedLeaves(Weld(*prepared));
    ASSERT_GT(truth.size(), 60u) << one.name;
    for (const std::string& level : SimdLevels()) {
      const AtSimdLevel at(level);
      const auto again = Prepare(Island(), one.settings);
      ASSERT_TRUE(StreamedLeaves(*again, level == "scalar" ? 16 : 2048) == truth)
          << one.name << ' ' << level;
      ASSERT_TRUE(WeldedLeaves(Weld(*again)) == truth) << one.name << ' ' << level;
    }
  }
}

TEST(SurfaceTest, S24_PatchSizeAndSimdLevelChangeNoBit) {
  const auto prepared = Prepare(TaiwanRelief(), SurfaceSettings(.06));
  const std::vector<Leaf> truth = WeldedLeaves(Weld(*prepared));
  EXPECT_GT(truth.size(), 5000u);
  for (const std::string& level : SimdLevels()) {
    const AtSimdLevel at(level);
    for (const size_t hint : {1u, 100u, 300u, 2048u, 65536u}) {
      EXPECT_TRUE(StreamedLeaves(*prepared, hint) == truth) << level << ' ' << hint;
    }
  }
}

TEST(SurfaceTest, S24_OrderOfTrianglesAndCornersChangesNoBit) {
  const FractalSettings settings = SurfaceSettings(.07);
  const CoarseShape shape = TaiwanRelief();
  const std::vector<Leaf> truth = StreamedLeaves(*Prepare(shape, settings));
  CoarseShape shuffled = shape;
  uint64_t state = 5;
  for (size_t i = shuffled.triangles.size(); i > 1; --i) {
    state = Mix64(state + 1);
    std::swap(shuffled.triangles[i - 1], shuffled.triangles[state % i]);
  }
  for (size_t i = 0; i < shuffled.triangles.size(); ++i) {
    Triangle& t = shuffled.triangles[i];
    std::rotate(t.begin(), t.begin() + static_cast<long>(i % 3), t.end());
  }
  EXPECT_TRUE(StreamedLeaves(*Prepare(shuffled, settings)) == truth);
  EXPECT_TRUE(WeldedLeaves(Weld(*Prepare(shuffled, settings))) == truth);
}

TEST(SurfaceTest, S3_EachRootAloneAgainAndInAnyOrderGivesTheSameBits) {
  const FractalSettings settings = SurfaceSettings(.1);
  const auto prepared = Prepare(Island(), settings);
  const auto again = Prepare(Island(), settings);
  CollectSink backwards;
  for (size_t root = prepared->RootCount(); root-- > 0;) {
    CollectSink alone, repeated;
    prepared->Stream(root, alone, 512);
    again->Stream(root, repeated, 512);
    EXPECT_EQ(alone.leaves, repeated.leaves) << root;
    backwards.leaves.insert(backwards.leaves.end(), alone.leaves.begin(), alone.leaves.end());
  }
  std::sort(backwards.leaves.begin(), backwards.leaves.end());
  EXPECT_EQ(backwards.leaves, StreamedLeaves(*prepared));
}

TEST(SurfaceTest, S3_SeedAloneMakesAnother) {
  FractalSettings settings = SurfaceSettings(.2);
  const WeldedShape one = Weld(*Prepare(Island(), settings));
  settings.seed = 2;
  const WeldedShape two = Weld(*Prepare(Island(), settings));
  ASSERT_EQ(one.mesh.points.size(), two.mesh.points.size());
  size_t moved = 0;
  for (size_t v = 0; v < one.level.size(); ++v) {
    if (one.level[v] > 0 && one.mesh.points[v] != two.mesh.points[v]) ++moved;
    if (one.level[v] == 0) {
      EXPECT_EQ(one.mesh.points[v], two.mesh.points[v]);
    }
  }
  EXPECT_GT(moved, one.level.size() / 2);
}

TEST(SurfaceTest, G29_ThreadsChangeNoBit) {
  const auto prepared = Prepare(TaiwanRelief(), SurfaceSettings(.08));
  const std::vector<Leaf> truth = StreamedLeaves(*prepared);
  for (const int threads : {2, 7}) {
    std::mutex mutex;
    std::vector<Leaf> leaves;
    ParallelFor(prepared->RootCount(), threads, [&](size_t root) {
      CollectSink sink;
      prepared->Stream(root, sink, 200);
      const std::lock_guard lock(mutex);
      leaves.insert(leaves.end(), sink.leaves.begin(), sink.leaves.end());
    });
    std::sort(leaves.begin(), leaves.end());
    EXPECT_TRUE(leaves == truth) << threads;
  }
}

// The shape moves, turns and grows; its tree does not, and no vertex jumps.
TEST(SurfaceTest, C16a_TheTreeIsTheSameInEveryFrame) {
  const CoarseShape rest = TaiwanRelief();
  const FractalSettings settings = SurfaceSettings(.1);
  std::vector<Identity> identities;
  WeldedShape before;
  for (int frame = 0; frame <= 20; ++frame) {
    CoarseShape shape = rest;
    const double t = frame * .05;
    for (Vec3& p : shape.now) {
      p = Vec3(p.x * (.2 + .8 * t), p.y * (.2 + .8 * t) + t * .3, p.z * t) + Vec3(t, 0, 0);
    }
    WeldedShape welded = Weld(*Prepare(shape, settings));
    if (frame > 0) {
      ASSERT_TRUE(welded.identity == before.identity);
      EXPECT_EQ(welded.mesh.face_vertex, before.mesh.face_vertex);
      double step = 0, coarse_step = 0;
      for (size_t v = 0; v < welded.level.size(); ++v) {
        const double moved = Length(welded.mesh.points[v] - before.mesh.points[v]);
        step = std::max(step, moved);
        if (welded.level[v] == 0) coarse_step = std::max(coarse_step, moved);
      }
      EXPECT_LT(step, 1.5 * coarse_step) << frame;
    }
    before = std::move(welded);
  }
}

// Offsets follow the size of the shape: twice the shape, twice the picture, unless switched off.
TEST(SurfaceTest, C16a_StretchKeepsRoughnessInProportion) {
  CoarseShape twice = TaiwanRelief();
  for (Vec3& p : twice.now) p = p * 2.0;
  FractalSettings settings = SurfaceSettings(.15);
  const WeldedShape rest = Weld(*Prepare(TaiwanRelief(), settings));
  const WeldedShape grown = Weld(*Prepare(twice, settings));
  settings.stretch = false;
  const WeldedShape stiff = Weld(*Prepare(twice, settings));
  double off_grown = 0, off_stiff = 0;
  for (size_t v = 0; v < rest.level.size(); ++v) {
    off_grown = std::max(off_grown, Length(grown.mesh.points[v] - rest.mesh.points[v] * 2.0));
    off_stiff = std::max(off_stiff, Length(stiff.mesh.points[v] - rest.mesh.points[v] * 2.0));
  }
  EXPECT_LT(off_grown, 1e-6);  // stretch is a float
  EXPECT_GT(off_stiff, .01);
}

// The camera's place in a shot, and what is seen of the object, change no vertex.
TEST(SurfaceTest, G44_CullingAndPlacingChangeNoVertex) {
  const auto prepared = Prepare(TaiwanRelief(), PixelSettings(2, 100, Vec3(0, -4, 3), 1));
  const std::vector<Leaf> all = StreamedLeaves(*prepared);
  CollectSink sink;
  size_t asked = 0;
  sink.wanted = [&](const Vec3&, const Vec3&, const Vec3&, const StreamReach&) {
    return ++asked % 3 != 0;
  };
  for (size_t root = 0; root < prepared->RootCount(); ++root) prepared->Stream(root, sink, 64);
  std::sort(sink.leaves.begin(), sink.leaves.end());
  EXPECT_LT(sink.leaves.size(), all.size());
  EXPECT_TRUE(std::includes(all.begin(), all.end(), sink.leaves.begin(), sink.leaves.end()));
}

TEST(SurfaceTest, C49_StatsCountWhatWasMade) {
  const auto prepared = Prepare(TaiwanRelief(), SurfaceSettings(.06));
  const WeldedShape welded = Weld(*prepared);
  StreamStats sum;
  CollectSink sink;
  for (size_t root = 0; root < prepared->RootCount(); ++root) {
    const StreamStats one = prepared->Stream(root, sink, 100);
    sum.triangles += one.triangles;
    sum.midpoints += one.midpoints;
    sum.culled += one.culled;
    sum.depth = std::max(sum.depth, one.depth);
  }
  EXPECT_EQ(sum.triangles, sink.leaves.size());
  EXPECT_EQ(sum.triangles, welded.mesh.FaceCount());
  EXPECT_GE(sum.midpoints, welded.mesh.points.size() - 101);
  EXPECT_LT(sum.midpoints, 2 * welded.mesh.points.size());
  EXPECT_EQ(sum.culled, 0u);
  EXPECT_EQ(sum.depth, *std::max_element(welded.level.begin(), welded.level.end()));
}

TEST(SurfaceTest, ColoursOfMidpointsAreMeans) {
  CoarseShape shape = Roof();
  shape.colors = {Rgb(1, 0, 0), Rgb(0, 1, 0), Rgb(0, 0, 1), Rgb(1, 1, 1)};
  FractalSettings settings = SurfaceSettings(.8);
  settings.max_level = 1;
  const WeldedShape welded = Weld(*Prepare(shape, settings));
  ASSERT_EQ(welded.mesh.colors.size(), welded.mesh.points.size());
  const Identity middle = MidpointIdentity(CoarseIdentity(1, 1), CoarseIdentity(1, 2));
  const auto at = std::find(welded.identity.begin(), welded.identity.end(), middle);
  ASSERT_NE(at, welded.identity.end());
  EXPECT_EQ(welded.mesh.colors[static_cast<size_t>(at - welded.identity.begin())],
            Rgb(0, .5f, .5f));
}

}  // namespace
}  // namespace fjord::test
