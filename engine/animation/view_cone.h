// About what a frame's picture shows: for estimates, before there is a picture.
#pragma once

#include "engine/geometry/vec.h"
#include "fjord/v1/frame.pb.h"

namespace fjord {

// The part of space that the picture shows, rounded to a cone or a cylinder around it. Immutable.
class ViewCone {
 public:
  explicit ViewCone(const v1::FrameScene& frame);

  // How far inside the cone a place is, less than 0 outside: a ball of a larger radius around it
  // reaches over the cone's side.
  double Depth(const Vec3& center) const;

 private:
  Vec3 eye_{0}, forward_{0};
  bool orthographic_ = false;
  double radius_ = 0;
  double sine_ = 0, cosine_ = 1;
};

}  // namespace fjord
