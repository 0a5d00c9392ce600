// (u,v) against numbers worked out by hand.
#include "engine/texture/uv_map.h"

#include <gtest/gtest.h>

#include "engine/base/exact_math.h"

namespace fjord {
namespace {

void ExpectUv(const UvPoint& got, double u, double v) {
  EXPECT_NEAR(got.u, u, 1e-12);
  EXPECT_NEAR(got.v, v, 1e-12);
}

TEST(UvMapTest, PlaneRunsOverTheGrid) {
  const UvMap map{UvKind::kPlane, {4, 2, 0}};
  ExpectUv(MapUv(map, {-2, -1, 7}), 0, 0);
  ExpectUv(MapUv(map, {2, 1, 0}), 1, 1);
  ExpectUv(MapUv(map, {1, 0, -3}), .75, .5);
}

TEST(UvMapTest, SphereIsLongitudeAndLatitude) {
  const UvMap map{UvKind::kSphere, {2, 2, 2}};
  ExpectUv(MapUv(map, {2, 0, 0}), .5, .5);
  ExpectUv(MapUv(map, {0, 2, 0}), .75, .5);
  ExpectUv(MapUv(map, {0, 0, 2}), .5, 1);
  ExpectUv(MapUv(map, {0, 0, -2}), .5, 0);
  // A point under the surface has the (u,v) of the surface above it.
  const double s = .5, c = .8660254037844386;
  ExpectUv(MapUv(map, Vec3(c, 0, s) * .3), .5, .5 + 30. / 180);
  // An ellipsoid is a sphere that was stretched.
  ExpectUv(MapUv({UvKind::kSphere, {4, 1, 2}}, {4 * c, 0, 2 * s}), .5, .5 + 30. / 180);
}

TEST(UvMapTest, TorusRunsRoundAxisAndTube) {
  const UvMap map{UvKind::kTorus, {3, 0, 0}};
  ExpectUv(MapUv(map, {4, 0, 0}), .5, .5);
  ExpectUv(MapUv(map, {0, 3, 1}), .75, .75);
  ExpectUv(MapUv(map, {0, -2, 1e-300}), .25, 1);
}

TEST(UvMapTest, EveryFaceOfABoxIsWhole) {
  const UvMap map{UvKind::kBox, {2, 4, 6}};
  ExpectUv(MapUv(map, {1, 2, 3}), 1, 1);
  ExpectUv(MapUv(map, {-1, 0, .5}), .5, .5 + .5 / 6);
  ExpectUv(MapUv(map, {.5, 2, 0}), .75, .5);
}

TEST(UvMapTest, AlongUIsWhereUGrows) {
  const Vec3 rest(1.1, .7, .4);
  for (const UvMap& map : {UvMap{UvKind::kPlane, {4, 2, 0}}, UvMap{UvKind::kSphere, {2, 1, 3}},
                           UvMap{UvKind::kTorus, {1.2, 0, 0}}, UvMap{UvKind::kBox, {2, 4, 6}}}) {
    const UvPoint at = MapUv(map, rest);
    const Vec3 step = Unit(at.along_u) * 1e-6;
    const UvPoint next = MapUv(map, rest + step);
    EXPECT_GT(next.u, at.u) << static_cast<uint32_t>(map.kind);
    EXPECT_NEAR(next.v, at.v, 1e-10) << static_cast<uint32_t>(map.kind);
  }
}

}  // namespace
}  // namespace fjord
