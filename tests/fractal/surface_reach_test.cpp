#include <gtest/gtest.h>

#include "tests/fractal/surface_shapes.h"

namespace fjord::test {
namespace {

// Distance of a point to a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
double Distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto segment = [&](const Vec3& u, const Vec3& v) {
    const Vec3 e = v - u;
    const double ee = glm::dot(e, e);
    double t = ee > 0 ? glm::dot(p - u, e) / ee : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return Length(p - (u + e * t));
  };
  double distance = std::min({segment(a, b), segment(b, c), segment(c, a)});
  const Vec3 n = glm::cross(b - a, c - a);
  const double nn = glm::dot(n, n);
  if (nn > 0) {
    const double u = glm::dot(glm::cross(b - a, p - a), n);
    const double v = glm::dot(glm::cross(c - b, p - b), n);
    const double w = glm::dot(glm::cross(a - c, p - c), n);
    if (u >= 0 && v >= 0 && w >= 0) {
      distance = std::min(distance, std::abs(glm::dot(p - a, n)) / Length(n));
    }
  }
  return distance;
}

struct Variety {
  std::string name;
  CoarseShape shape;
  FractalSettings settings;
  double tightness;  // the largest excursion is at least this share of the reach
};

std::vector<Variety> Varieties() {
  std::vector<Variety> all;
  const auto add = [&](const std::string& name, const CoarseShape& shape, FractalSettings settings,
                       double tightness) {
    all.push_back({name, shape, std::move(settings), tightness});
  };
  for (const double H : {.3, .7}) {
    FractalSettings s = SurfaceSettings(.08);
    s.H = H;
    add("affine", TaiwanRelief(), s, .15);
    s.variant = Variant::kPerturbed;
    s.perturb = 3;
    add("affine perturbed", Island(), s, .1);
    s.coast = true;
    add("affine coast", Island(), s, .1);
    s.amplitude = 0;
    s.coast_H = .2;
    add("coast alone", Island(), s, .3);
    FractalSettings pixels = PixelSettings(3, 120, Vec3(0, -3, 1), .3);
    pixels.H = H;
    add("affine pixels", TaiwanRelief(), pixels, .1);
    FractalSettings shih = SurfaceSettings(.08);
    shih.H = H;
    shih.law = Law::kShih;
    shih.sigma = .5;
    add("shih", TaiwanRelief(), shih, .02);
    shih.variant = Variant::kPerturbed;
    shih.direction = Direction::kEdge;
    add("shih perturbed", Torus(), shih, .01);
    FractalSettings similar = SurfaceSettings(.15);
    similar.H = H;
    similar.law = Law::kSimilar;
    similar.max_level = 6;
    add("similar", Island(), similar, .005);
    FractalSettings length = SurfaceSettings(.1);
    length.split = Split::kLength;
    length.max_level = 6;
    add("affine length", Island(), length, .02);
  }
  return all;
}

TEST(SurfaceReachTest, S7_NoVertexLeavesItsBound) {
  for (const Variety& one : Varieties()) {
    double most = 0;
    for (uint64_t seed = 1; seed <= 6; ++seed) {
      FractalSettings settings = one.settings;
      settings.seed = seed;
      const auto prepared = Prepare(one.shape, settings);
      for (size_t root = 0; root < prepared->RootCount(); ++root) {
        CollectSink sink;
        std::array<Vec3, 3> corner;
        StreamReach reach(-1);
        sink.wanted = [&](const Vec3& a, const Vec3& b, const Vec3& c, const StreamReach& r) {
          if (reach.around < 0) {
            corner = {a, b, c};
            reach = r;
          }
          return true;
        };
        prepared->Stream(root, sink, 100);
        const Ball ball = prepared->Bound(root);
        for (const Vec3& p : sink.points) {
          ASSERT_LE(Length(p - ball.center), ball.radius) << one.name;
          const double away = Distance(p, corner[0], corner[1], corner[2]);
          ASSERT_LE(away, reach.Any() + 1e-12) << one.name;
          most = std::max(most, away / reach.Any());
          for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(-.48, .6, .64)}) {
            const auto [least, largest] = std::minmax(
                {glm::dot(corner[0], way), glm::dot(corner[1], way), glm::dot(corner[2], way)});
            ASSERT_LE(glm::dot(p, way), largest + reach.Towards(way) + 1e-12) << one.name;
            ASSERT_GE(glm::dot(p, way), least - reach.Towards(way) - 1e-12) << one.name;
          }
        }
      }
    }
    EXPECT_GT(most, one.tightness) << one.name << " H " << one.settings.H;
  }
}

// Culling by the reach never loses a leaf that touches what is wanted, at any patch size.
TEST(SurfaceReachTest, S7_CullingLosesNothingThatIsWanted) {
  for (const Variety& one : Varieties()) {
    const auto prepared = Prepare(one.shape, one.settings);
    for (size_t root = 0; root < prepared->RootCount(); root += 3) {
      CollectSink whole;
      prepared->Stream(root, whole, 2048);
      const Vec3 center = whole.points[whole.points.size() / 3];
      const double radius = .05;
      for (const size_t hint : {16u, 64u, 256u}) {
        CollectSink culled;
        culled.wanted = [&](const Vec3& a, const Vec3& b, const Vec3& c, const StreamReach& reach) {
          return Distance(center, a, b, c) <= radius + reach.Any();
        };
        prepared->Stream(root, culled, hint);
        std::sort(culled.leaves.begin(), culled.leaves.end());
        for (const Leaf& leaf : whole.leaves) {
          bool touches = false;
          for (const Corner& c : leaf) {
            const Vec3 p(std::bit_cast<double>(c.bits[0]), std::bit_cast<double>(c.bits[1]),
                         std::bit_cast<double>(c.bits[2]));
            touches = touches || Length(p - center) <= radius;
          }
          if (touches) {
            ASSERT_TRUE(std::binary_search(culled.leaves.begin(), culled.leaves.end(), leaf))
                << one.name << ' ' << hint;
          }
        }
      }
    }
  }
}

TEST(SurfaceReachTest, S7_CullingSavesWork) {
  const auto prepared = Prepare(TaiwanRelief(), SurfaceSettings(.01));
  StreamStats all, some;
  for (size_t root = 0; root < prepared->RootCount(); ++root) {
    CollectSink sink;
    all.triangles += prepared->Stream(root, sink, 256).triangles;
    CollectSink culled;
    culled.wanted = [](const Vec3& a, const Vec3& b, const Vec3& c, const StreamReach& reach) {
      return Distance(Vec3(0, 0, 0), a, b, c) <= .1 + reach.Any();
    };
    const StreamStats stats = prepared->Stream(root, culled, 256);
    some.triangles += stats.triangles;
    some.culled += stats.culled;
  }
  EXPECT_GT(some.culled, 100u);
  EXPECT_LT(some.triangles, all.triangles / 15);
}

}  // namespace
}  // namespace fjord::test
