#include "engine/geometry/plane.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace fjord {
namespace {

Vec3 SmallPoint() {
  const auto coordinate = [] { return *rc::gen::inRange(-1000, 1001) / 8.; };
  return {coordinate(), coordinate(), coordinate()};
}

TEST(PlaneTest, G51_HandWorkedPlane) {
  const Plane plane = PlaneThrough({1, 0, 0}, {0, 2, 0}, {0, 0, 3});
  EXPECT_EQ(plane.normal, Vec3(6, 3, 2));  // 6x + 3y + 2z = 6
  EXPECT_EQ(plane.d, 6);
  EXPECT_EQ(plane.Value({1, 2, 3}), 12);
}

// Eighths of small integers make every operation exact, so the equation holds without tolerance.
RC_GTEST_PROP(PlaneTest, G51_PointsSatisfyTheEquationWithThePlusSign, ()) {
  const Vec3 p1 = SmallPoint(), p2 = SmallPoint(), p3 = SmallPoint();
  const Plane plane = PlaneThrough(p1, p2, p3);
  for (const Vec3& p : {p1, p2, p3}) {
    RC_ASSERT(glm::dot(plane.normal, p - p1) == 0);
    RC_ASSERT(plane.normal.x * p.x + plane.normal.y * p.y + plane.normal.z * p.z - plane.d == 0);
  }
}

TEST(PlaneTest, G51_PointsOnOneLineHaveNoNormal) {
  EXPECT_EQ(PlaneThrough({0, 0, 0}, {1, 1, 1}, {3, 3, 3}).normal, Vec3(0));
}

TEST(PlaneTest, CounterClockwiseFacesTheNormal) {
  EXPECT_GT(PlaneThrough({0, 0, 0}, {1, 0, 0}, {0, 1, 0}).Value({0, 0, 5}), 0);
}

}  // namespace
}  // namespace fjord
