#include "engine/scene/transform.h"

#include <algorithm>

#include "engine/base/clamp.h"
#include "engine/base/exact_math.h"

namespace fjord {
namespace {

struct Turn {
  double sine;
  double cosine;
};

// Quarter turns are exact, so that an object turned by 90 degrees stays on its axes.
Turn TurnBy(double degrees) {
  const double turns = degrees / 360;
  const double angle = 360 * (turns - Floor(turns));
  if (angle == 0 || angle == 360) return {0, 1};
  if (angle == 90) return {1, 0};
  if (angle == 180) return {0, -1};
  if (angle == 270) return {-1, 0};
  const double radians = angle * (exact::kPi / 180);
  return {exact::Sin(radians), exact::Cos(radians)};
}

double Magnitude(double x) { return x < 0 ? -x : x; }

}  // namespace

ObjectTransform::ObjectTransform(const v1::Transform& transform) {
  const v1::Vec3& scale = transform.scale();
  scale_ = {scale.has_x() ? scale.x() : 1, scale.has_y() ? scale.y() : 1,
            scale.has_z() ? scale.z() : 1};
  move_ = {transform.translate().x(), transform.translate().y(), transform.translate().z()};
  const Turn x = TurnBy(transform.rotate().x());
  const Turn y = TurnBy(transform.rotate().y());
  const Turn z = TurnBy(transform.rotate().z());
  // Rz Ry Rx
  turn_[0] = {z.cosine * y.cosine, z.cosine * y.sine * x.sine - z.sine * x.cosine,
              z.cosine * y.sine * x.cosine + z.sine * x.sine};
  turn_[1] = {z.sine * y.cosine, z.sine * y.sine * x.sine + z.cosine * x.cosine,
              z.sine * y.sine * x.cosine - z.cosine * x.sine};
  turn_[2] = {-y.sine, y.cosine * x.sine, y.cosine * x.cosine};
  const double sizes[] = {Magnitude(scale_.x), Magnitude(scale_.y), Magnitude(scale_.z)};
  least_scale_ = std::min({sizes[0], sizes[1], sizes[2]});
  largest_scale_ = std::max({sizes[0], sizes[1], sizes[2]});
}

Vec3 ObjectTransform::ToWorld(const Vec3& point) const {
  const Vec3 scaled = point * scale_;
  return Vec3(glm::dot(turn_[0], scaled), glm::dot(turn_[1], scaled), glm::dot(turn_[2], scaled)) +
         move_;
}

Vec3 ObjectTransform::ToObject(const Vec3& point) const {
  const Vec3 moved = point - move_;
  const Vec3 turned = turn_[0] * moved.x + turn_[1] * moved.y + turn_[2] * moved.z;
  return {turned.x / scale_.x, turned.y / scale_.y, turned.z / scale_.z};
}

std::array<double, 12> ObjectTransform::Rows() const {
  std::array<double, 12> rows{};
  for (size_t r = 0; r < 3; ++r) {
    for (size_t c = 0; c < 3; ++c) {
      rows[4 * r + c] = turn_[r][static_cast<int>(c)] * scale_[static_cast<int>(c)];
    }
    rows[4 * r + 3] = move_[static_cast<int>(r)];
  }
  return rows;
}

bool ObjectTransform::IsIdentity() const {
  return Rows() == std::array<double, 12>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
}

}  // namespace fjord
