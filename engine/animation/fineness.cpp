#include "engine/animation/fineness.h"

#include <algorithm>

#include "engine/animation/eye_bound.h"
#include "engine/base/exact_math.h"

namespace fjord {
namespace {

Vec3 ToVec3(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

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

// The needs by pixels with one eye for all, in its possible forms. None where a need has no such
// form.
std::vector<v1::FrameFineness> ByPixels(std::span<const FinenessNeed> needs, const Box& rest,
                                        int along) {
  std::vector<EyeBound> eyes;
  double pixels = 0, focal = 0, near = 0;
  for (const FinenessNeed& need : needs) {
    if (need.focal <= 0) return {};
    pixels = eyes.empty() ? need.pixels : std::min(pixels, need.pixels);
    near = eyes.empty() ? need.near : std::min(near, need.near);
    focal = std::max(focal, need.focal);
    eyes.push_back(need.eye);
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

Box WorldBox(const Box& box, const ObjectTransform& transform) {
  Box world;
  for (int corner = 0; corner < 8; ++corner) {
    world.Add(transform.ToWorld({(corner & 1) != 0 ? box.high.x : box.low.x,
                                 (corner & 2) != 0 ? box.high.y : box.low.y,
                                 (corner & 4) != 0 ? box.high.z : box.low.z}));
  }
  return world;
}

FinenessNeed NeedOf(const FinenessDemand& demand, const Box& rest, uint32_t picture_height) {
  FinenessNeed need;
  // lengths grow by at most the largest scale, distances by at least the smallest
  const double least = demand.transform.least_scale(), largest = demand.transform.largest_scale();
  if (largest <= 0) return need;
  need.any = true;
  need.epsilon = EpsilonOf(demand, rest, picture_height);
  if (demand.pixels <= 0 || demand.camera.orthographic || least <= 0) return need;
  need.pixels = demand.pixels;
  need.near = demand.camera.near / least;
  need.focal = demand.camera.Focal(picture_height) * (largest / least);
  need.eye.center = demand.transform.ToObject(demand.camera.eye);
  return need;
}

v1::FrameFineness FinenessFor(std::span<const FinenessNeed> needs, const Box& rest,
                              int cells_along) {
  std::vector<FinenessNeed> seen;
  for (const FinenessNeed& need : needs) {
    if (need.any) seen.push_back(need);
  }
  v1::FrameFineness fineness;
  if (seen.empty()) {  // never any size: nothing is split
    fineness.set_epsilon(1e100);
    return fineness;
  }
  double epsilon = 0;
  for (const FinenessNeed& need : seen) {
    epsilon = epsilon > 0 ? std::min(epsilon, need.epsilon) : need.epsilon;
  }
  fineness.set_epsilon(epsilon);
  // One eye lets far parts be coarse; where the camera goes round the object, one length may be
  // less.
  const std::vector<v1::FrameFineness> forms = ByPixels(seen, rest, cells_along);
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

v1::FrameFineness WorkOutFineness(std::span<const FinenessDemand> demands, const Box& rest,
                                  uint32_t picture_height, int cells_along) {
  std::vector<FinenessNeed> needs;
  for (const FinenessDemand& demand : demands) {
    needs.push_back(NeedOf(demand, rest, picture_height));
  }
  return FinenessFor(needs, rest, cells_along);
}

}  // namespace fjord
