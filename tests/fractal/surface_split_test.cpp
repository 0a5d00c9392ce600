#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "engine/fractal/amount.h"
#include "tests/fractal/surface_shapes.h"

namespace fjord::test {
namespace {

// The shape stays flat on its rest pose, so that places tell rest lengths.
FractalSettings Flat(FractalSettings settings) {
  settings.sigma = 0;
  return settings;
}

TEST(SurfaceSplitTest, S21_AllFourCasesOccurOnTaiwan) {
  FractalSettings settings = SurfaceSettings(.3);
  settings.max_level = 1;
  const auto prepared = Prepare(TaiwanRelief(), settings);
  std::set<size_t> cases;
  for (size_t root = 0; root < prepared->RootCount(); ++root) {
    CollectSink sink;
    prepared->Stream(root, sink, 100);
    cases.insert(sink.leaves.size());
  }
  EXPECT_EQ(cases, (std::set<size_t>{1, 2, 3, 4}));
}

// With two long edges, what is left of the triangle is cut from the middle of the longer one.
TEST(SurfaceSplitTest, S21_TwoLongEdgesAreCutFromTheLongerOnesMiddle) {
  for (const bool first_longer : {false, true}) {
    CoarseShape shape;  // sides 0-1 and 1-2 long
    shape.now = {{0, 0, 0}, {first_longer ? 1.6 : 1.2, 0, 0}, {.4, .8, 0}};
    if (!first_longer) shape.now[2] = {-.3, .6, 0};
    shape.rest = shape.now;
    shape.triangles = {{0, 1, 2}};
    FractalSettings settings = Flat(SurfaceSettings(1.1));
    settings.max_level = 1;
    const WeldedShape welded = Weld(*Prepare(shape, settings));
    ASSERT_EQ(welded.mesh.FaceCount(), 3u);
    std::set<std::pair<uint32_t, uint32_t>> edges;
    for (const auto& [a, b] : EdgesOf(welded)) edges.insert(std::minmax(a, b));
    const auto middle = [&](uint32_t a, uint32_t b) {
      const Identity id = MidpointIdentity(welded.identity[a], welded.identity[b]);
      return static_cast<uint32_t>(std::find(welded.identity.begin(), welded.identity.end(), id) -
                                   welded.identity.begin());
    };
    EXPECT_EQ(edges.count({2, middle(0, 1)}), first_longer ? 1u : 0u);
    EXPECT_EQ(edges.count({0, middle(1, 2)}), first_longer ? 0u : 1u);
  }
}

// An edge gets a midpoint exactly when it is longer than epsilon in the rest pose.
TEST(SurfaceSplitTest, S21_EachEdgeDecidesAlone) {
  const double epsilon = .11;
  size_t split = 0, kept = 0;
  for (uint32_t level = 0; level < 5; ++level) {
    FractalSettings settings = Flat(SurfaceSettings(epsilon));
    settings.max_level = level;
    const WeldedShape coarse = Weld(*Prepare(TaiwanRelief(), settings));
    settings.max_level = level + 1;
    const Places fine = PlacesOf(Weld(*Prepare(TaiwanRelief(), settings)));
    for (const auto& [a, b] : EdgesOf(coarse)) {
      const double length = Length(coarse.mesh.points[a] - coarse.mesh.points[b]);
      if (std::abs(length - epsilon) < 1e-12) continue;
      const bool has_midpoint =
          fine.count(MidpointIdentity(coarse.identity[a], coarse.identity[b])) > 0;
      EXPECT_EQ(has_midpoint, length > epsilon) << length;
      (has_midpoint ? split : kept) += 1;
    }
  }
  EXPECT_GT(split, 1000u);
  EXPECT_GT(kept, 1000u);
}

TEST(SurfaceSplitTest, S21_EveryLeafEdgeIsShortOrAtTheLastLevel) {
  for (const double epsilon : {.3, .1, .04}) {
    const WeldedShape welded = Weld(*Prepare(TaiwanRelief(), Flat(SurfaceSettings(epsilon))));
    for (const auto& [a, b] : EdgesOf(welded)) {
      EXPECT_LE(Length(welded.mesh.points[a] - welded.mesh.points[b]), epsilon * (1 + 1e-12));
    }
  }
  FractalSettings settings = Flat(SurfaceSettings(.001));
  settings.max_level = 3;
  const WeldedShape limited = Weld(*Prepare(TaiwanRelief(), settings));
  EXPECT_EQ(*std::max_element(limited.level.begin(), limited.level.end()), 3);
  EXPECT_EQ(limited.mesh.FaceCount(), 167u * 64);
}

// By pixels: against the formula of frame.proto, up to the float that keeps distances.
TEST(SurfaceSplitTest, S15_PixelsAreMeasuredAtTheEdgesMiddle) {
  for (const double radius : {0., .8}) {
    const Vec3 eye(.3, -3, 2);
    const auto split_for = [&](double pixels) {
      const WeldedShape welded =
          Weld(*Prepare(TaiwanRelief(), Flat(PixelSettings(pixels, 100, eye, radius))));
      double largest = 0;
      for (const auto& [a, b] : EdgesOf(welded)) {
        const Vec3 p = welded.mesh.points[a], q = welded.mesh.points[b];
        const double distance = std::max(.01, Length((p + q) * .5 - eye) - radius);
        largest = std::max(largest, Length(p - q) * 100 / distance);
      }
      return std::make_pair(largest, welded.mesh.FaceCount());
    };
    const auto [largest, count] = split_for(3);
    EXPECT_LE(largest, 3 * (1 + 1e-5));
    EXPECT_GT(largest, 2.9);
    const auto [half, more] = split_for(1.5);
    EXPECT_LE(half, 1.5 * (1 + 1e-5));
    EXPECT_NEAR(static_cast<double>(more) / static_cast<double>(count), 4, .4);
  }
}

TEST(SurfaceSplitTest, S15_TwiceTheDistanceTwiceTheEpsilon) {
  CoarseShape flat = Roof();
  const Vec3 far(0, 0, 1e6);
  const auto count = [&](double pixels, double height) {
    return Weld(*Prepare(flat, PixelSettings(pixels, 1e6, Vec3(0, 0, height)))).mesh.FaceCount();
  };
  EXPECT_EQ(count(.05, 1e6), count(.025, 2e6));
  EXPECT_GT(count(.05, 1e6), count(.05, 2e6));
}

TEST(SurfaceSplitTest, S21_LengthReadsThisFramesLengths) {
  CoarseShape shape = TaiwanRelief();
  for (Vec3& p : shape.now) p = p * .5;
  FractalSettings settings = SurfaceSettings(.1);
  const size_t by_rest = Weld(*Prepare(shape, settings)).mesh.FaceCount();
  settings.split = Split::kLength;
  const WeldedShape welded = Weld(*Prepare(shape, settings));
  EXPECT_LT(welded.mesh.FaceCount(), by_rest / 2);
  for (const auto& [a, b] : EdgesOf(welded)) {
    EXPECT_LE(Length(welded.mesh.points[a] - welded.mesh.points[b]), .1 * (1 + 1e-12));
  }
}

// Finer, and every vertex stays: all are of one tree. By one length nothing is cut in part, so this
// holds to the last vertex; it is also how orthographic cameras ask.
TEST(SurfaceSplitTest, S21_AdaptiveCutsOneTree) {
  for (const CoarseShape& shape : {TaiwanRelief(), Sphere(), Torus()}) {
    FractalSettings settings = SurfaceSettings(.3);
    settings.split = Split::kAdaptive;
    std::vector<Identity> coarse = Weld(*Prepare(shape, settings)).identity;
    for (const double epsilon : {.19, .11, .07, .03}) {
      settings.fineness.epsilon = epsilon;
      const WeldedShape fine = Weld(*Prepare(shape, settings));
      const Places places = PlacesOf(fine);
      for (const Identity& identity : coarse) ASSERT_TRUE(places.count(identity)) << epsilon;
      EXPECT_GE(fine.identity.size(), coarse.size());
      coarse = fine.identity;
    }
    EXPECT_GT(coarse.size(), 20 * shape.now.size());
  }
}

// About as many triangles as SHOT makes, also where the eye nearly touches the surface.
TEST(SurfaceSplitTest, S21_AdaptiveCostsAboutWhatShotDoes) {
  for (const double above : {1., .1, .0001}) {
    FractalSettings settings = PixelSettings(20, 300, Vec3(1 + above, 0, 0));
    const size_t shot = Weld(*Prepare(Sphere(), settings)).mesh.FaceCount();
    settings.split = Split::kAdaptive;
    const size_t adaptive = Weld(*Prepare(Sphere(), settings)).mesh.FaceCount();
    EXPECT_GT(adaptive, shot / 3) << above;
    EXPECT_LT(adaptive, shot * 3) << above;
  }
}

// A little finer, and nothing jumps: what has just become long is not displaced yet.
TEST(SurfaceSplitTest, S21_AdaptiveFadesTheLastLevelIn) {
  FractalSettings settings = PixelSettings(4, 100, Vec3(0, 0, 5));
  settings.split = Split::kAdaptive;
  const WeldedShape before = Weld(*Prepare(TaiwanRelief(), settings));
  settings.fineness.pixels = 3.996;
  const Places after = PlacesOf(Weld(*Prepare(TaiwanRelief(), settings)));
  double jump = 0, largest = 0;
  for (size_t v = 0; v < before.identity.size(); ++v) {
    const auto at = after.find(before.identity[v]);
    if (at != after.end()) {
      jump = std::max(jump, Length(at->second - before.mesh.points[v]));
    }
  }
  settings.split = Split::kShot;
  settings.sigma = 0;
  const Places flat = PlacesOf(Weld(*Prepare(TaiwanRelief(), settings)));
  for (size_t v = 0; v < before.identity.size(); ++v) {
    const auto at = flat.find(before.identity[v]);
    if (at != flat.end()) {
      largest = std::max(largest, Length(at->second - before.mesh.points[v]));
    }
  }
  EXPECT_LT(jump, largest / 50);
  EXPECT_GT(jump, 0);
}

TEST(SurfaceSplitTest, S14_HalvingEpsilonLeavesCommonVerticesUnchanged) {
  for (const Law law : {Law::kAffine, Law::kShih, Law::kSimilar}) {
    FractalSettings settings = SurfaceSettings(.16);
    settings.law = law;
    Places coarse = PlacesOf(Weld(*Prepare(TaiwanRelief(), settings)));
    for (int halving = 0; halving < 3; ++halving) {
      settings.fineness.epsilon *= .5;
      const Places fine = PlacesOf(Weld(*Prepare(TaiwanRelief(), settings)));
      size_t common = 0;
      for (const auto& [identity, place] : coarse) {
        const auto at = fine.find(identity);
        if (at == fine.end()) continue;
        ++common;
        EXPECT_EQ(at->second, place);
      }
      // Vertices on diagonals that a finer epsilon no longer draws are gone; few are.
      EXPECT_GT(common, coarse.size() * 9 / 10);
      coarse = fine;
    }
  }
}

// The historic law is its formula: Delta_i g move times the edge as it is now.
TEST(SurfaceSplitTest, S14_TheHistoricLawIsItsFormula) {
  FractalSettings settings = SurfaceSettings(.1);
  settings.increments = Increments::kMidpoint;
  settings.law = Law::kShih;
  settings.sigma = .5;
  settings.direction = Direction::kUp;
  size_t compared = 0;
  for (uint32_t level = 0; level < 4; ++level) {
    settings.max_level = level;
    const WeldedShape coarse = Weld(*Prepare(Roof(), settings));
    settings.max_level = level + 1;
    const Places fine = PlacesOf(Weld(*Prepare(Roof(), settings)));
    for (const auto& [a, b] : EdgesOf(coarse)) {
      const Identity id = MidpointIdentity(coarse.identity[a], coarse.identity[b]);
      if (std::max(coarse.level[a], coarse.level[b]) != level || fine.count(id) == 0) continue;
      const Vec3 p = coarse.mesh.points[a], q = coarse.mesh.points[b];
      const double wanted =
          ShihDeviation(.5, .7, static_cast<int>(level)) * Gaussian(id.lo, 4) * .4 * Length(p - q);
      EXPECT_NEAR(fine.at(id).z - (p.z + q.z) * .5, wanted, 1e-12);
      ++compared;
    }
  }
  EXPECT_GT(compared, 100u);
}

// sigma A (rest length)^H c(H) g along +z, on a flat shape at rest.
TEST(SurfaceSplitTest, S14_TheAffineLawIsItsFormula) {
  for (const uint32_t uniforms : {1u, 3u, 4u, 5u, 16u}) {
    FractalSettings settings = SurfaceSettings(.3);
    settings.increments = Increments::kMidpoint;
    settings.max_level = 1;
    settings.uniforms = uniforms;
    settings.direction = Direction::kUp;
    const CoarseShape roof = Roof();
    const Places places = PlacesOf(Weld(*Prepare(roof, settings)));
    for (const auto& [a, b] : EdgePairs{{0, 1}, {1, 2}, {0, 2}, {1, 3}, {2, 3}}) {
      const Identity id = MidpointIdentity(CoarseIdentity(1, a), CoarseIdentity(1, b));
      const Vec3 p = roof.now[a], q = roof.now[b];
      const double wanted = .15 * std::pow(Length(p - q), .7) * AffineConstant(.7) *
                            Gaussian(id.lo, static_cast<int>(uniforms));
      EXPECT_NEAR(places.at(id).z - (p.z + q.z) * .5, wanted, 1e-12);
    }
  }
}

// fBm: the mean square of aligned height differences grows with the lag to the power 2H.
TEST(SurfaceSplitTest, S2_S14_AffineReliefMeasuresTheHThatIsAsked) {
  const int n = 256;
  for (const double H : {.3, .5, .7}) {
    FractalSettings settings = SurfaceSettings(1.5);
    settings.H = H;
    settings.direction = Direction::kUp;
    CoarseShape quad;
    quad.now = quad.rest = {{0, 0, 0}, {n, 0, 0}, {n, n, 0}, {0, n, 0}};
    quad.triangles = {{0, 1, 2}, {0, 2, 3}};
    std::vector<double> sums(10), counts(10);
    for (uint64_t seed = 1; seed <= 3; ++seed) {
      settings.seed = seed;
      const WeldedShape welded = Weld(*Prepare(quad, settings));
      std::vector<double> height((n + 1) * (n + 1));
      for (const Vec3& p : welded.mesh.points) {
        height[static_cast<size_t>(p.y) * (n + 1) + static_cast<size_t>(p.x)] = p.z;
      }
      for (int power = 0; power < 7; ++power) {
        const size_t lag = size_t{1} << power;
        for (size_t y = 0; y <= n; y += lag) {
          for (size_t x = 0; x + lag <= n; x += lag) {
            const double d = height[y * (n + 1) + x + lag] - height[y * (n + 1) + x];
            sums[static_cast<size_t>(power)] += d * d;
            counts[static_cast<size_t>(power)] += 1;
          }
        }
      }
    }
    const double slope = (std::log2(sums[5] / counts[5]) - std::log2(sums[0] / counts[0])) / 5;
    EXPECT_NEAR(slope, 2 * H, .1) << H;
  }
}

TEST(SurfaceSplitTest, DegenerateShapesEndCleanly) {
  const auto points_of = [](const CoarseShape& shape, const FractalSettings& settings) {
    const auto prepared = Prepare(shape, settings);
    StreamedLeaves(*prepared);
    for (size_t root = 0; root < prepared->RootCount(); ++root) (void)prepared->Bound(root);
    return Weld(*prepared).mesh.points.size();
  };
  for (const Law law : {Law::kAffine, Law::kSimilar, Law::kShih}) {
    for (const Variant variant : {Variant::kFixed, Variant::kPerturbed}) {
      FractalSettings settings = SurfaceSettings(.2);
      settings.law = law;
      settings.variant = variant;
      settings.coast = true;
      settings.max_level = 5;
      EXPECT_EQ(points_of(CoarseShape{}, settings), 0u);
      CoarseShape point = Roof();
      point.now.assign(4, Vec3(1, 2, 3));
      point.rest = point.now;
      EXPECT_EQ(points_of(point, settings), 4u);
      CoarseShape collapsed = Roof();
      collapsed.now.assign(4, Vec3(1, 2, 3));
      EXPECT_GT(points_of(collapsed, settings), 20u);
      for (const Vec3& p : Weld(*Prepare(collapsed, settings)).mesh.points) {
        EXPECT_EQ(p, Vec3(1, 2, 3));
      }
      CoarseShape grown = Roof();
      grown.rest.assign(4, Vec3(0, 0, 0));
      EXPECT_EQ(points_of(grown, settings), 4u);
      CoarseShape line = Roof();
      for (size_t i = 0; i < 4; ++i) line.now[i] = Vec3(static_cast<double>(i), 0, 0);
      line.rest = line.now;
      EXPECT_GT(points_of(line, settings), 20u);
      CoarseShape repeated = Roof();
      repeated.triangles.push_back({2, 2, 3});
      EXPECT_EQ(points_of(repeated, settings), points_of(Roof(), settings));
      CoarseShape huge = Roof();
      for (Vec3& p : huge.now) p = p * 1e200;
      huge.rest = huge.now;
      EXPECT_GT(points_of(huge, settings), 3u);
    }
  }
}

TEST(SurfaceSplitTest, BadInputAndLimitsAreErrors) {
  const MethodInfo& method = *FindFractalMethod("surface");
  const auto code = [&](const CoarseShape& shape, FractalSettings settings) {
    const auto prepared = PrepareMidpoint(method, shape, settings);
    return prepared.ok() ? ErrorCode::kInternal : prepared.error().code;
  };
  EXPECT_EQ(code(Roof(), SurfaceSettings(0)), ErrorCode::kInvalid);
  EXPECT_EQ(code(Roof(), SurfaceSettings(-1)), ErrorCode::kInvalid);
  EXPECT_EQ(code(Roof(), SurfaceSettings(std::nan(""))), ErrorCode::kInvalid);
  EXPECT_EQ(code(Roof(), PixelSettings(0, 100, Vec3(0))), ErrorCode::kInvalid);
  EXPECT_EQ(code(OutlineCurve(), SurfaceSettings(.1)), ErrorCode::kInvalid);
  CoarseShape bad = Roof();
  bad.triangles.push_back({0, 1, 4});
  EXPECT_EQ(code(bad, SurfaceSettings(.1)), ErrorCode::kInvalid);
  bad = Roof();
  bad.rest.pop_back();
  EXPECT_EQ(code(bad, SurfaceSettings(.1)), ErrorCode::kInvalid);
  FractalSettings rough = SurfaceSettings(.1);
  rough.H = 1.5;
  EXPECT_EQ(code(Roof(), rough), ErrorCode::kInvalid);

  const auto prepared = Prepare(TaiwanRelief(), SurfaceSettings(.01));
  const auto welded = prepared->Weld({.max_points = 5000});
  ASSERT_FALSE(welded.ok());
  EXPECT_EQ(welded.error().code, ErrorCode::kLimit);
}

}  // namespace
}  // namespace fjord::test
