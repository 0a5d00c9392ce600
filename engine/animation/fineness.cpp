#include "engine/animation/fineness.h"

#include <algorithm>

#include "engine/base/exact_math.h"

namespace fjord {
namespace {

Vec3 ToVec3(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

double DistanceTo(const Box& box, const Vec3& point) {
  Vec3 apart(0);
  for (int i = 0; i < 3; ++i) {
    apart[i] = std::max({0.0, box.low[i] - point[i], point[i] - box.high[i]});
  }
  return Length(apart);
}

Box WorldBox(const Box& box, const ObjectTransform& transform) {
  Box world;
  for (int corner = 0; corner < 8; ++corner) {
    world.Add(transform.ToWorld({(corner & 1) != 0 ? box.high.x : box.low.x,
                                 (corner & 2) != 0 ? box.high.y : box.low.y,
                                 (corner & 4) != 0 ? box.high.z : box.low.z}));
  }
  return world;
}

// The demand as one length for the whole object: exact but for pixels seen in perspective, where
// the nearest point of the object's box decides.
double EpsilonOf(const FinenessDemand& demand, const Box& rest, uint32_t height) {
  const CameraState& camera = demand.camera;
  const double scale = demand.transform.largest_scale();
  if (demand.epsilon > 0) return demand.epsilon / scale;
  if (demand.viewing > 0) return .01 * Length(camera.eye - camera.look_at) / demand.viewing / scale;
  if (camera.orthographic) return demand.pixels * camera.view_height / height / scale;
  const double distance = DistanceTo(WorldBox(rest, demand.transform), camera.eye);
  return demand.pixels * std::max(camera.near, distance) / camera.Focal(height) / scale;
}

// By pixels, with a ball round all eyes. False where some frame has no such form.
bool ByPixels(std::span<const FinenessDemand> demands, uint32_t height,
              v1::FrameFineness* fineness) {
  Box eyes;
  double pixels = 0, focal = 0, near = 0;
  for (const FinenessDemand& demand : demands) {
    const double least = demand.transform.least_scale(), largest = demand.transform.largest_scale();
    if (demand.pixels <= 0 || demand.camera.orthographic || least <= 0) return false;
    const bool first = eyes.empty;
    eyes.Add(demand.transform.ToObject(demand.camera.eye));
    const double this_focal = demand.camera.Focal(height) * (largest / least);
    const double this_near = demand.camera.near / least;
    pixels = first ? demand.pixels : std::min(pixels, demand.pixels);
    focal = std::max(focal, this_focal);
    near = first ? this_near : std::min(near, this_near);
  }
  const bool one_place = eyes.low == eyes.high;
  const Vec3 center = one_place ? eyes.low : eyes.Center();
  double radius = 0;
  for (const FinenessDemand& demand : demands) {
    if (one_place) break;
    radius = std::max(radius, Length(demand.transform.ToObject(demand.camera.eye) - center));
  }
  fineness->set_pixels(pixels);
  fineness->set_focal(focal);
  fineness->set_near(near);
  for (int i = 0; i < 3; ++i) fineness->add_eye(center[i]);
  fineness->set_eye_radius(radius);
  return true;
}

}  // namespace

CameraState::CameraState(const v1::Camera& camera)
    : eye(ToVec3(camera.eye())),
      look_at(ToVec3(camera.look_at())),
      up(ToVec3(camera.up())),
      orthographic(camera.projection() == v1::Camera::ORTHOGRAPHIC),
      fov(camera.fov()),
      view_height(camera.view_height()),
      near(camera.near()) {}

double CameraState::Focal(uint32_t picture_height) const {
  const double half = fov * (exact::kPi / 360);
  return .5 * picture_height * (exact::Cos(half) / exact::Sin(half));
}

std::string CameraState::Defect() const {
  const Vec3 view = look_at - eye;
  if (Length(view) == 0) return "eye and look_at are at one place";
  if (Length(up) == 0) return "up has no direction";
  if (Length(glm::cross(Unit(view), Unit(up))) < 1e-9) return "up runs along the view";
  return "";
}

v1::FrameFineness WorkOutFineness(std::span<const FinenessDemand> demands, const Box& rest,
                                  uint32_t picture_height) {
  std::vector<FinenessDemand> seen;
  for (const FinenessDemand& demand : demands) {
    if (demand.transform.largest_scale() > 0) seen.push_back(demand);
  }
  v1::FrameFineness fineness;
  if (seen.empty()) {  // never any size: nothing is split
    fineness.set_epsilon(1e100);
    return fineness;
  }
  double epsilon = 0;
  for (const FinenessDemand& demand : seen) {
    const double wanted = EpsilonOf(demand, rest, picture_height);
    epsilon = epsilon > 0 ? std::min(epsilon, wanted) : wanted;
  }
  v1::FrameFineness by_pixels;
  if (ByPixels(seen, picture_height, &by_pixels)) {
    // The ball is the better form, as it lets far parts be coarse, unless the eyes go so far round
    // the object that the ball takes in what none of them comes near to.
    const Vec3 center(by_pixels.eye(0), by_pixels.eye(1), by_pixels.eye(2));
    const double distance = DistanceTo(rest, center) - by_pixels.eye_radius();
    const double finest =
        by_pixels.pixels() * std::max(by_pixels.near(), distance) / by_pixels.focal();
    if (seen.size() == 1 || finest >= .5 * epsilon) return by_pixels;
  }
  fineness.set_epsilon(epsilon);
  return fineness;
}

}  // namespace fjord
