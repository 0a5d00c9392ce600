// The affine map of an object: scaled, then turned about x, y, z in that order, then moved.
#pragma once

#include <array>

#include "engine/geometry/vec.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {

// Absent numbers count as 0, of scale as 1.
class ObjectTransform {
 public:
  ObjectTransform() = default;
  explicit ObjectTransform(const v1::Transform& transform);

  Vec3 ToWorld(const Vec3& point) const;
  // Needs least_scale() > 0.
  Vec3 ToObject(const Vec3& point) const;

  double least_scale() const { return least_scale_; }
  double largest_scale() const { return largest_scale_; }
  // 3 rows of 4, object to world.
  std::array<double, 12> Rows() const;
  bool IsIdentity() const;

 private:
  std::array<Vec3, 3> turn_ = {Vec3(1, 0, 0), Vec3(0, 1, 0),
                               Vec3(0, 0, 1)};  // rows of the rotation
  Vec3 scale_{1};
  Vec3 move_{0};
  double least_scale_ = 1;
  double largest_scale_ = 1;
};

}  // namespace fjord
