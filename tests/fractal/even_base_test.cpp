// A planet on the even base is as rough at its poles as at its equator.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/fractal/surface_shapes.h"

namespace fjord::test {
namespace {

// Mean squared step of the radius along edges, over what fBm of this H has: near the poles and near
// the equator.
struct Roughness {
  double pole = 0, equator = 0;
};

Roughness RoughnessOf(const CoarseShape& ball, double H) {
  double sum[2] = {0, 0}, count[2] = {0, 0};
  for (uint64_t seed = 1; seed <= 24; ++seed) {
    FractalSettings settings = SurfaceSettings(.06);
    settings.H = H;
    settings.amplitude = .02;
    settings.seed = seed;
    const WeldedShape welded = Weld(*Prepare(ball, settings));
    settings.sigma = 0;  // the facets of the ball alone, halved in the same places
    const WeldedShape bare = Weld(*Prepare(ball, settings));
    const auto& v = welded.mesh.face_vertex;
    for (size_t corner = 0; corner < v.size(); ++corner) {
      const uint32_t i = v[corner], j = v[corner % 3 == 2 ? corner - 2 : corner + 1];
      const Vec3 a = bare.mesh.points[i], b = bare.mesh.points[j];
      const double height = std::abs((Unit(a) + Unit(b)).z * .5);
      if (height < .9 && height > .3) continue;
      const double step = glm::dot(welded.mesh.points[i] - a, Unit(a)) -
                          glm::dot(welded.mesh.points[j] - b, Unit(b));
      const double along = Length(a - b);
      sum[height < .5] += step * step / (.0004 * std::pow(along, 2 * H));
      count[height < .5] += 1;
    }
  }
  return {sum[0] / count[0], sum[1] / count[1]};
}

TEST(EvenBaseTest, S23_PolesAreAsRoughAsTheEquator) {
  const CoarseShape even = Made(MakeEvenEllipsoid(Vec3(1), 5));
  const CoarseShape latitude = Made(MakeEllipsoid(Vec3(1), 24, 12));
  for (const double H : {.5, .8}) {
    const Roughness on_even = RoughnessOf(even, H);
    EXPECT_NEAR(on_even.pole / on_even.equator, 1, .06) << H;
    EXPECT_NEAR(on_even.pole, .8, .35) << H;
    const Roughness on_latitude = RoughnessOf(latitude, H);
    EXPECT_GT(std::abs(on_latitude.pole / on_latitude.equator - 1),
              2 * std::abs(on_even.pole / on_even.equator - 1))
        << H;
    RecordProperty("even", std::to_string(on_even.pole) + " " + std::to_string(on_even.equator));
    RecordProperty("latitude",
                   std::to_string(on_latitude.pole) + " " + std::to_string(on_latitude.equator));
  }
}

}  // namespace
}  // namespace fjord::test
