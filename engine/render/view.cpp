#include "engine/render/view.h"

#include <algorithm>

#include "engine/base/clamp.h"
#include "engine/base/exact_math.h"

namespace fjord {
namespace {

// `direction . (M p - eye)` as a row over p.
std::array<double, 4> RowOf(const Vec3& direction, const Transform& m, const Vec3& eye) {
  std::array<double, 4> row{};
  for (int column = 0; column < 4; ++column) {
    row[column] =
        (direction.x * m[column] + direction.y * m[4 + column]) + direction.z * m[8 + column];
  }
  row[3] = row[3] - glm::dot(direction, eye);
  return row;
}

int32_t ToFixed(double v) {
  const double inside = std::min(std::max(v, -double{kFixedGuard}), double{kFixedGuard});
  return FloorToInt32(inside + .5);
}

}  // namespace

View MakeView(const Camera& camera, uint32_t width, uint32_t height) {
  View view;
  view.eye = camera.eye;
  view.forward = Unit(camera.look_at - camera.eye, Vec3(0, 1, 0));
  const Vec3 choices[] = {camera.up, Vec3(0, 0, 1), Vec3(0, 1, 0)};
  for (const Vec3& up : choices) {
    const Vec3 right = glm::cross(view.forward, Unit(up));
    if (glm::dot(right, right) < 1e-18) continue;
    view.right = Unit(right);
    break;
  }
  view.up = glm::cross(view.right, view.forward);
  view.width = width;
  view.height = height;
  view.center_x = width * .5;
  view.center_y = height * .5;
  view.orthographic = camera.orthographic;
  view.near = camera.near;
  if (camera.orthographic) {
    view.focal = height / camera.view_height;
  } else {
    view.near = std::max(camera.near, 1e-12);
    const double half_angle = camera.fov * (exact::kPi / 360);
    view.focal = height * .5 * exact::Cos(half_angle) / exact::Sin(half_angle);
  }
  return view;
}

Projection MakeProjection(const View& view, const Transform& transform) {
  Projection to;
  to.orthographic = view.orthographic;
  to.near = view.near;
  to.z = RowOf(view.forward, transform, view.eye);
  const std::array<double, 4> right = RowOf(view.right, transform, view.eye);
  const std::array<double, 4> up = RowOf(view.up, transform, view.eye);
  const std::array<double, 4> one = {0, 0, 0, 1};
  const std::array<double, 4>& w = view.orthographic ? one : to.z;
  for (int i = 0; i < 4; ++i) {
    to.x[i] = kFixedOne * (view.focal * right[i] + view.center_x * w[i]);
    to.y[i] = kFixedOne * (view.center_y * w[i] - view.focal * up[i]);
  }
  return to;
}

ScreenPoint ToScreen(const Projection& to, const ClipPoint& p) {
  if (to.orthographic) return {ToFixed(p.x), ToFixed(p.y), -p.z};
  const double inverse = 1 / p.z;
  return {ToFixed(p.x * inverse), ToFixed(p.y * inverse), inverse};
}

Vec3 PointAt(const View& view, double x, double y, double depth) {
  const double right = (x * (1. / kFixedOne) - view.center_x) / view.focal;
  const double up = (view.center_y - y * (1. / kFixedOne)) / view.focal;
  if (view.orthographic) {
    return view.eye + (view.right * right + view.up * up) - view.forward * depth;
  }
  return view.eye + (view.forward + view.right * right + view.up * up) * (1 / depth);
}

Vec3 Apply(const Transform& m, const Vec3& p) {
  return {((m[0] * p.x + m[1] * p.y) + m[2] * p.z) + m[3],
          ((m[4] * p.x + m[5] * p.y) + m[6] * p.z) + m[7],
          ((m[8] * p.x + m[9] * p.y) + m[10] * p.z) + m[11]};
}

Vec3 ApplyInverse(const Transform& m, const Vec3& world) {
  const Vec3 r0(m[0], m[1], m[2]), r1(m[4], m[5], m[6]), r2(m[8], m[9], m[10]);
  const Vec3 c0 = glm::cross(r1, r2), c1 = glm::cross(r2, r0), c2 = glm::cross(r0, r1);
  const double determinant = glm::dot(r0, c0);
  if (determinant == 0) return Vec3(0);
  const Vec3 p = world - Vec3(m[3], m[7], m[11]);
  return ((c0 * p.x + c1 * p.y) + c2 * p.z) / determinant;
}

}  // namespace fjord
