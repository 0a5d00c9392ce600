// FillViewDefaults of defaults.h: what depends on where things are over the whole shot.
#include <algorithm>
#include <array>
#include <optional>

#include "engine/base/clamp.h"
#include "engine/base/exact_math.h"
#include "engine/scene/defaults.h"
#include "engine/scene/fractal_reach.h"
#include "engine/scene/track.h"
#include "engine/scene/transform.h"

namespace fjord {
namespace {

constexpr double kDefaultFov = 35;
constexpr double kMargin = 1.06;   // of the picture's half size, left around everything
constexpr int kMostSamples = 500;  // frames looked at while a transform moves

Vec3 ToVec3(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

void Put(v1::Vec3* message, const Vec3& v) {
  message->set_x(v.x);
  message->set_y(v.y);
  message->set_z(v.z);
}

// Frames at which a tracked thing is looked at: all it changes in, or an even choice of them.
std::vector<double> SampledFrames(const TrackSet& tracks, uint32_t frames) {
  if (tracks.empty()) return {1};
  const double first = std::clamp<double>(tracks.first_frame(), 1, frames);
  const double last = std::clamp<double>(tracks.last_frame(), 1, frames);
  const double from = Floor(first), to = -Floor(-last);
  const int64_t count = std::min<int64_t>(kMostSamples, ClampToInt64(to - from) + 1);
  std::vector<double> sampled;
  for (int64_t i = 0; i < count; ++i) {
    const double share = count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0;
    sampled.push_back(Floor(from + share * (to - from)));
  }
  return sampled;
}

// Where control points may pull the points of an object to.
Box WithPaths(const v1::Object& object, Box box) {
  const Box keys = box;
  for (const v1::Vec3& control : object.path().control()) {
    box.Add(keys.low + ToVec3(control));
    box.Add(keys.high + ToVec3(control));
  }
  for (const v1::PointPath& path : object.point_path()) {
    for (const v1::Vec3& control : path.path().control()) box.Add(ToVec3(control));
  }
  return box;
}

// A shape that tracks change has no keys; it is looked at as it is at the sampled frames.
Box TrackedBox(const v1::Scene& scene, int object, const TrackSet& tracks, Box box) {
  v1::Scene now;
  now = scene;
  for (const double frame : SampledFrames(tracks, scene.output().frames())) {
    tracks.Apply(frame, &now);
    Result<Geometry> geometry = DecodeShape(now.objects(object).shape(), {});
    if (!geometry) continue;
    for (const Vec3& point : geometry->points) box.Add(point);
  }
  return box;
}

std::array<Vec3, 8> CornersOf(const Box& box) {
  std::array<Vec3, 8> corners;
  for (size_t i = 0; i < 8; ++i) {
    corners[i] = {(i & 1) != 0 ? box.high.x : box.low.x, (i & 2) != 0 ? box.high.y : box.low.y,
                  (i & 4) != 0 ? box.high.z : box.low.z};
  }
  return corners;
}

// Round the box at every placement.
Box PlacedBox(const v1::Object& object, const Box& box) {
  if (object.placements_size() == 0) return box;
  Box placed;
  for (const v1::Transform& placement : object.placements()) {
    const ObjectTransform transform(placement);
    for (const Vec3& corner : CornersOf(box)) placed.Add(transform.ToWorld(corner));
  }
  return placed;
}

// A scene without its shapes, light enough to apply tracks to.
v1::Scene WithoutShapes(const v1::Scene& scene) {
  v1::Scene light;
  *light.mutable_output() = scene.output();
  *light.mutable_camera() = scene.camera();
  for (const v1::Object& object : scene.objects()) {
    v1::Object* copy = light.add_objects();
    copy->set_name(object.name());
    if (object.has_transform()) *copy->mutable_transform() = object.transform();
  }
  return light;
}

// Round the coarse shapes, or round what fractals make of them.
enum class Boxed : uint8_t { kCoarse, kFractal };

// Everything in the world: a box round it, and the corners of the objects' own boxes, which fit
// closer where an object is turned.
struct World {
  Box box;
  std::vector<Vec3> corners;

  void Add(const Vec3& corner) {
    box.Add(corner);
    corners.push_back(corner);
  }
  void Add(const Box& part) {
    for (const Vec3& corner : CornersOf(part)) Add(corner);
  }
};

World WorldOf(const v1::Scene& scene, const SceneShapes& shapes, const TrackSet& tracks,
              Boxed boxed) {
  World world;
  v1::Scene now = WithoutShapes(scene);
  const std::vector<TrackSet> own = tracks.OfObjects(scene.objects_size());
  for (int i = 0; i < scene.objects_size(); ++i) {
    const TrackSet& of_object = own[static_cast<size_t>(i)];
    const Route route = Route().Then("objects", i);
    Box box = WithPaths(scene.objects(i), shapes.BoundsOf(static_cast<size_t>(i)));
    const TrackSet shape_tracks = of_object.Inside({route.Then("shape")});
    if (!shape_tracks.empty()) box = TrackedBox(scene, i, shape_tracks, box);
    if (box.empty) continue;
    if (boxed == Boxed::kFractal) box = ReachOfFractal(scene, i, shapes, of_object).Around(box);
    box = PlacedBox(scene.objects(i), box);
    const TrackSet moves = of_object.Inside({route.Then("transform")});
    if (moves.empty()) {
      const ObjectTransform transform(now.objects(i).transform());
      for (const Vec3& corner : CornersOf(box)) world.Add(transform.ToWorld(corner));
      continue;
    }
    Box moved;
    for (const double frame : SampledFrames(moves, scene.output().frames())) {
      moves.Apply(frame, &now);
      const ObjectTransform transform(now.objects(i).transform());
      for (const Vec3& corner : CornersOf(box)) moved.Add(transform.ToWorld(corner));
    }
    world.Add(moved);
  }
  if (scene.has_sea() && !world.box.empty) {
    Box at_sea = world.box;
    at_sea.Add({at_sea.low.x, at_sea.low.y, scene.sea().level()});
    if (at_sea.low.z < world.box.low.z || at_sea.high.z > world.box.high.z) world.Add(at_sea);
  }
  return world;
}

// From the scene towards the camera: from above for what is flat, level for what stands in a plane,
// else three quarters from the south, 30 degrees up.
Vec3 DefaultSide(const Box& box) {
  const Vec3 size = box.Size();
  const double flat = 1e-9 * std::max({size.x, size.y, size.z});
  if (size.z <= flat) return {0, 0, 1};
  if (size.y <= flat) return {0, -1, 0};
  if (size.x <= flat) return {1, 0, 0};
  return Unit(Vec3(.32, -.80, .50));
}

struct Frame {
  Vec3 right, up, back;
};

Frame FrameOf(const Vec3& back, const Vec3& up) {
  const Vec3 right = Unit(glm::cross(up, back), Vec3(1, 0, 0));
  return {right, glm::cross(back, right), back};
}

// What the window must hold to show the box around `center`: half sizes, and the distance from
// which a window of the given slopes holds it in perspective.
struct Extent {
  double half_width = 0;
  double half_height = 0;
  double distance = 0;
};

Extent ExtentOf(const World& world, const Vec3& center, const Frame& frame, double slope,
                double aspect) {
  Extent extent;
  for (const Vec3& corner : world.corners) {
    const Vec3 point = corner - center;
    const double x = glm::dot(point, frame.right), y = glm::dot(point, frame.up);
    const double width = (x < 0 ? -x : x) * kMargin, height = (y < 0 ? -y : y) * kMargin;
    extent.half_width = std::max(extent.half_width, width);
    extent.half_height = std::max(extent.half_height, height);
    const double needed = std::max(height / slope, width / (slope * aspect));
    extent.distance = std::max(extent.distance, needed + glm::dot(point, frame.back));
  }
  return extent;
}

double LeastEyeDistance(const v1::Scene& scene, const TrackSet& tracks) {
  const TrackSet moves = tracks.Inside({Route().Then("camera")});
  v1::Scene now = WithoutShapes(scene);
  double least = Length(ToVec3(scene.camera().eye()) - ToVec3(scene.camera().look_at()));
  for (const double frame : SampledFrames(moves, scene.output().frames())) {
    moves.Apply(frame, &now);
    const double distance = Length(ToVec3(now.camera().eye()) - ToVec3(now.camera().look_at()));
    if (distance > 0) least = least > 0 ? std::min(least, distance) : distance;
  }
  return least;
}

void FillVector(v1::Vec3* v) {
  if (!v->has_x()) v->set_x(0);
  if (!v->has_y()) v->set_y(0);
  if (!v->has_z()) v->set_z(0);
}

}  // namespace

void FillViewDefaults(v1::Scene* scene, const SceneShapes& shapes) {
  const TrackSet tracks(*scene);
  const World coarse = WorldOf(*scene, shapes, tracks, Boxed::kCoarse);
  const Box& box = coarse.box;
  const double aspect = static_cast<double>(scene->output().width()) / scene->output().height();
  v1::Camera* camera = scene->mutable_camera();
  if (!camera->has_fov()) camera->set_fov(kDefaultFov);

  const bool free_height =
      camera->projection() == v1::Camera::ORTHOGRAPHIC && !camera->has_view_height();
  const World seen =
      !camera->has_eye() || free_height ? WorldOf(*scene, shapes, tracks, Boxed::kFractal) : coarse;
  if (!camera->has_look_at()) Put(camera->mutable_look_at(), seen.box.Center());
  FillVector(camera->mutable_look_at());
  const Vec3 look_at = ToVec3(camera->look_at());
  if (camera->has_eye()) FillVector(camera->mutable_eye());
  const Vec3 side =
      camera->has_eye() ? Unit(ToVec3(camera->eye()) - look_at, Vec3(0, 0, 1)) : DefaultSide(box);
  if (!camera->has_up()) {
    const bool upright = Length(glm::cross(side, Vec3(0, 0, 1))) > 1e-6;
    Put(camera->mutable_up(), upright ? Vec3(0, 0, 1) : Vec3(0, 1, 0));
  }
  FillVector(camera->mutable_up());

  const double half = camera->fov() * (exact::kPi / 360);
  const double slope = exact::Sin(half) / exact::Cos(half);
  const Extent extent = ExtentOf(seen, look_at, FrameOf(side, ToVec3(camera->up())), slope, aspect);
  if (!camera->has_eye()) {
    const double distance = extent.distance > 0 ? extent.distance : 1;
    Put(camera->mutable_eye(), look_at + side * distance);
  }
  if (!camera->has_view_height()) {
    const double height = 2 * std::max(extent.half_height, extent.half_width / aspect);
    camera->set_view_height(height > 0 ? height : 1);
  }
  if (!camera->has_near()) {
    const double distance = LeastEyeDistance(*scene, tracks);
    camera->set_near(distance > 0 ? .01 * distance : .01);
  }
  if (scene->has_haze() && !scene->haze().has_density()) {
    const double across = Length(box.Size());
    scene->mutable_haze()->set_density(across > 0 ? .2 / across : 0);
  }
  for (v1::Light& light : *scene->mutable_lights()) {
    if (light.kind() == v1::Light::LOCAL && !light.has_range()) {
      const double reach = 2 * Length(box.Size());
      light.set_range(reach > 0 ? reach : 1);
    }
    if (light.shadow() && !light.has_shadow_detail()) {
      constexpr double kTexels = 2048;  // across all that is there during the shot
      const double across = Length(box.Size());
      light.set_shadow_detail(across > 0 ? across / kTexels : 1);
    }
  }
}

}  // namespace fjord
