// How fine an object is split, in its rest pose and object space, for a whole shot or one frame
// (design 1, S15; frame.proto's FrameFineness).
//
// Z1 Over a shot, no frame is coarser than what it asks for alone.
// Z2 Under SHOT the answer is the same in every frame, so nothing pops.
#pragma once

#include <span>
#include <vector>

#include "engine/animation/eye_bound.h"
#include "engine/scene/shapes.h"
#include "engine/scene/transform.h"
#include "fjord/v1/frame.pb.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {

struct CameraState {
  Vec3 eye{0};
  Vec3 look_at{0};
  Vec3 up{0};
  bool orthographic = false;
  double fov = 0;
  double view_height = 0;
  double near = 0;

  explicit CameraState(const v1::Camera& camera);
  // Pixels a unit at distance 1 (perspective).
  double Focal(uint32_t picture_height) const;
  // Empty, or why nothing can be seen through it.
  std::string Defect() const;
};

// What one frame asks of one object.
struct FinenessDemand {
  CameraState camera;
  ObjectTransform transform;
  // one of these is > 0
  double epsilon = 0;
  double pixels = 0;
  double viewing = 0;
};

// The most that one frame, or every frame of a stretch, asks of one object.
struct FinenessNeed {
  bool any = false;    // false: the object has no size
  double epsilon = 0;  // as one length for the whole object
  // The same as pixels, in object space, seen from wherever in a ball the eye may be. focal 0:
  // what is asked has no such form.
  double pixels = 0;
  double focal = 0;
  double near = 0;
  EyeBound eye;
};

// `rest`: the box of the rest pose.
FinenessNeed NeedOf(const FinenessDemand& demand, const Box& rest, uint32_t picture_height);

// One fineness for all needs. Those without size do not count. `cells_along`: how closely a moving
// eye is bounded (eye_bound.h).
v1::FrameFineness FinenessFor(std::span<const FinenessNeed> needs, const Box& rest,
                              int cells_along = 8);

// Both in one, for frames.
v1::FrameFineness WorkOutFineness(std::span<const FinenessDemand> demands, const Box& rest,
                                  uint32_t picture_height, int cells_along = 8);

// The eight corners of the box, in the world.
Box WorldBox(const Box& box, const ObjectTransform& transform);

}  // namespace fjord
