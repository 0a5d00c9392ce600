#include "engine/animation/view_cone.h"

#include <algorithm>
#include <cmath>

#include "engine/base/exact_math.h"

namespace fjord {
namespace {

Vec3 ToVec3(const google::protobuf::RepeatedField<double>& v, const Vec3& otherwise) {
  return v.size() == 3 ? Vec3(v[0], v[1], v[2]) : otherwise;
}

}  // namespace

ViewCone::ViewCone(const v1::FrameScene& frame) {
  const v1::FrameCamera& camera = frame.camera();
  const double aspect =
      static_cast<double>(frame.output().width()) / std::max<uint32_t>(frame.output().height(), 1);
  const double diagonal = std::sqrt(1 + aspect * aspect);
  eye_ = ToVec3(camera.eye(), Vec3(0));
  forward_ = Unit(ToVec3(camera.look_at(), Vec3(0)) - eye_, Vec3(0, 1, 0));
  orthographic_ = camera.orthographic();
  if (orthographic_) {
    radius_ = .5 * camera.view_height() * diagonal;
    return;
  }
  const double half = camera.fov() * (exact::kPi / 360);
  const double slope = exact::Sin(half) / exact::Cos(half) * diagonal;
  cosine_ = 1 / std::sqrt(1 + slope * slope);
  sine_ = slope * cosine_;
}

double ViewCone::Depth(const Vec3& center) const {
  const Vec3 from_eye = center - eye_;
  const double along = glm::dot(from_eye, forward_);
  const double beside = Length(from_eye - forward_ * along);
  if (orthographic_) return radius_ - beside;
  return along * sine_ - beside * cosine_;
}

}  // namespace fjord
