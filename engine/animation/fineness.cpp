#include "engine/animation/fineness.h"

#include <algorithm>

#include "engine/animation/eye_bound.h"
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

// The demands by pixels with one eye for all, in its possible forms. None where a demand has no
// such form.
std::vector<v1::FrameFineness> ByPixels(std::span<const FinenessDemand> demands, const Box& rest,
                                        uint32_t height, int along) {
  std::vector<Vec3> eyes;
  double pixels = 0, focal = 0, near = 0;
  for (const FinenessDemand& demand : demands) {
    // lengths grow by at most the largest scale, distances by at least the smallest
    const double least = demand.transform.least_scale(), largest = demand.transform.largest_scale();
    if (demand.pixels <= 0 || demand.camera.orthographic || least <= 0) return {};
    const double this_near = demand.camera.near / least;
    pixels = eyes.empty() ? demand.pixels : std::min(pixels, demand.pixels);
    near = eyes.empty() ? this_near : std::min(near, this_near);
    focal = std::max(focal, demand.camera.Focal(height) * (largest / least));
    eyes.push_back(demand.transform.ToObject(demand.camera.eye));
  }
  std::vector<v1::FrameFineness> forms;
  for (const EyeBound& bound : BoundEyes(eyes, rest, along)) {
    v1::FrameFineness& form = forms.emplace_back();
    form.set_pixels(pixels);
    form.set_focal(focal);
    form.set_near(near);
    for (int i = 0; i < 3; ++i) form.add_eye(bound.center[i]);
    form.set_eye_radius(bound.radius);
  }
  return forms;
}

// About how many pieces a fineness makes of something spread over the box.
double CostOf(const v1::FrameFineness& form, const BoxCells& cells) {
  double cost = 0;
  for (const Vec3& x : cells.centers) {
    double epsilon = form.epsilon();
    if (form.focal() > 0) {
      const Vec3 eye(form.eye(0), form.eye(1), form.eye(2));
      epsilon =
          form.pixels() * std::max(form.near(), Length(x - eye) - form.eye_radius()) / form.focal();
    }
    cost += 1 / (epsilon * epsilon);
  }
  return cost;
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
                                  uint32_t picture_height, int cells_along) {
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
  fineness.set_epsilon(epsilon);
  // One eye lets far parts be coarse; where the camera goes round the object, one length may be
  // less.
  const std::vector<v1::FrameFineness> forms = ByPixels(seen, rest, picture_height, cells_along);
  if (forms.size() == 1) return forms[0];
  const BoxCells cells = CutBox(rest, 6);
  double least = CostOf(fineness, cells);
  for (const v1::FrameFineness& form : forms) {
    const double cost = CostOf(form, cells);
    if (cost >= least) continue;
    least = cost;
    fineness = form;
  }
  return fineness;
}

}  // namespace fjord
