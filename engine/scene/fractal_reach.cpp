#include "engine/scene/fractal_reach.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/fractal/registry.h"
#include "engine/geometry/triangulate.h"
#include "engine/scene/parameters.h"

namespace fjord {
namespace {

constexpr size_t kMostPoses = 16;    // looked at of one object
constexpr double kMostLeaves = 2e6;  // of one pose; beyond that it is made more coarsely

// Grows a box by all that is streamed, and wants nothing that cannot grow it.
class BoxSink final : public StreamSink {
 public:
  explicit BoxSink(const Box& box) : box_(box) {}

  bool Wants(const Vec3& a, const Vec3& b, const Vec3& c, const StreamReach& reach) override {
    for (int k = 0; k < 3; ++k) {
      const double least = std::min(std::min(a[k], b[k]), c[k]);
      const double most = std::max(std::max(a[k], b[k]), c[k]);
      const double around = reach.Towards(Vec3(k == 0, k == 1, k == 2));
      if (most + around > box_.high[k] || least - around < box_.low[k]) return true;
    }
    return false;
  }
  void Take(const StreamBatch& batch) override {
    for (const StreamVertex& vertex : batch.vertices) box_.Add(vertex.position);
  }
  const Box& box() const { return box_; }

 private:
  Box box_;
};

Box BoxOf(const Geometry& geometry) {
  Box box;
  for (const Vec3& point : geometry.points) box.Add(point);
  return box;
}

double Largest(const Vec3& v) { return std::max(std::max(v.x, v.y), v.z); }

CoarseShape ShapeOf(const Geometry& now, const Geometry& rest, Takes takes) {
  CoarseShape shape;
  shape.now = now.points;
  shape.rest = now.points.size() == rest.points.size() ? rest.points : now.points;
  shape.curve = now.curve;
  shape.closed = now.closed;
  if (now.curve) return shape;
  if (takes == Takes::kFaces) {
    shape.face_size = now.face_size;
    shape.face_vertex = now.face_vertex;
  } else {
    shape.triangles = Triangulate(shape.rest, now.face_size, now.face_vertex);
  }
  return shape;
}

// The length of edges that a picture of the shape alone would not split, or a longer one where that
// would be too many.
double EpsilonOf(const v1::Scene& scene, const v1::Fractal& fractal, const CoarseShape& shape) {
  Box box;
  for (const Vec3& point : shape.rest) box.Add(point);
  const double size = Largest(box.Size());
  const double side = std::max(scene.output().width(), scene.output().height());
  double epsilon = .5 * size / side;
  if (fractal.has_pixels()) epsilon *= fractal.pixels();
  if (fractal.has_epsilon()) epsilon = std::max(epsilon, fractal.epsilon());
  double squares = 0;  // of edges
  for (const Triangle& t : shape.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 edge = shape.rest[t[(k + 1) % 3]] - shape.rest[t[k]];
      squares += glm::dot(edge, edge) / 3;
    }
  }
  return std::max(epsilon, std::sqrt(squares / kMostLeaves));
}

void AddPose(const v1::Scene& scene, const v1::Fractal& fractal, const Geometry& now,
             const Geometry& rest, FractalReach* reach) {
  const MethodInfo* method = FindFractalMethod(fractal.method());
  if (method == nullptr) return;
  MethodSettings settings;
  settings.method = fractal.method();
  settings.seed = fractal.seed();
  settings.max_level = fractal.max_level();
  std::vector<KnobDefect> defects;
  settings.own = method->knobs.Read(ValuesOf(ParametersOf(fractal)), method->name, &defects);
  if (!defects.empty()) return;
  CoarseShape shape = ShapeOf(now, rest, method->takes);
  settings.fineness.epsilon = EpsilonOf(scene, fractal, shape);
  if (!(settings.fineness.epsilon > 0)) return;
  const auto prepared = PrepareMethod(std::move(shape), settings);
  if (!prepared) return;
  const Box coarse = BoxOf(now);
  BoxSink sink(coarse);
  for (size_t root = 0; root < (*prepared)->RootCount(); ++root) {
    (*prepared)->Stream(root, sink, 256);
  }
  for (int k = 0; k < 3; ++k) {
    reach->low[k] = std::max(reach->low[k], coarse.low[k] - sink.box().low[k]);
    reach->high[k] = std::max(reach->high[k], sink.box().high[k] - coarse.high[k]);
  }
}

// Frames at which the object is looked at: its keys and those of its tracks, or an even choice; and
// where tracks change what it is, frames between these, for a fractal between two may reach further
// than both.
std::vector<double> PoseFrames(const v1::Object& object, const TrackSet& own, uint32_t frames) {
  std::vector<double> poses = own.KeyFrames();
  for (const v1::Key& key : object.key()) poses.push_back(key.frame());
  for (double& frame : poses) frame = std::clamp<double>(frame, 1, frames);
  if (poses.empty()) poses.push_back(1);
  std::sort(poses.begin(), poses.end());
  poses.erase(std::unique(poses.begin(), poses.end()), poses.end());
  while (own.size() > 0 && poses.size() > 1 && poses.size() < kMostPoses) {
    size_t widest = 1;
    const auto gap = [&](size_t i) { return poses[i] - poses[i - 1]; };
    for (size_t i = 2; i < poses.size(); ++i) widest = gap(i) > gap(widest) ? i : widest;
    if (gap(widest) <= 1) break;
    const double middle = poses[widest - 1] + .5 * gap(widest);
    poses.insert(poses.begin() + static_cast<std::ptrdiff_t>(widest), middle);
  }
  if (poses.size() <= kMostPoses) return poses;
  std::vector<double> chosen;
  for (size_t i = 0; i < kMostPoses; ++i) {
    chosen.push_back(poses[i * (poses.size() - 1) / (kMostPoses - 1)]);
  }
  return chosen;
}

}  // namespace

Box FractalReach::Around(const Box& box) const {
  if (box.empty) return box;
  Box around = box;
  around.Add(box.low - low);
  around.Add(box.high + high);
  return around;
}

FractalReach ReachOfFractal(const v1::Scene& scene, int index, const SceneShapes& shapes,
                            const TrackSet& own) {
  const v1::Object& object = scene.objects(index);
  FractalReach reach;
  if (!object.has_fractal()) return reach;
  const auto& geometries = shapes.of[static_cast<size_t>(index)];
  const Geometry* rest = nullptr;
  for (size_t k = 0; k < geometries.size(); ++k) {
    if (!geometries[k]) return reach;
    const bool is_rest =
        object.key_size() > 0 && object.key(static_cast<int>(k)).frame() == object.rest_frame();
    if (rest == nullptr || is_rest) rest = &*geometries[k];
  }
  if (rest == nullptr) return reach;
  const Route route = Route().Then("objects", index);
  const bool shape_moves = own.Touches(route.Then("shape"));
  v1::Scene now;
  *now.mutable_output() = scene.output();
  for (int i = 0; i < scene.objects_size(); ++i)
    now.add_objects()->set_name(scene.objects(i).name());
  *now.mutable_objects(index) = object;
  if (!shape_moves) {
    now.mutable_objects(index)->clear_shape();
    now.mutable_objects(index)->clear_key();
  }
  const TrackSet moves = own.Inside({route.Then("fractal"), route.Then("shape")});
  for (const double frame : PoseFrames(object, moves, scene.output().frames())) {
    moves.Apply(frame, &now);
    const v1::Fractal& fractal = now.objects(index).fractal();
    if (shape_moves) {
      Result<Geometry> shape = DecodeShape(now.objects(index).shape(), {});
      if (shape) shape = WithMesh(std::move(*shape));
      if (shape) AddPose(scene, fractal, *shape, *shape, &reach);
      continue;
    }
    // The key before the frame and the key after it, which may be one.
    size_t before = 0, after = geometries.size() - 1;
    for (int k = 0; k < object.key_size(); ++k) {
      if (object.key(k).frame() <= frame) before = static_cast<size_t>(k);
    }
    for (int k = object.key_size(); k-- > 0;) {
      if (object.key(k).frame() >= frame) after = static_cast<size_t>(k);
    }
    AddPose(scene, fractal, *geometries[before], *rest, &reach);
    if (after != before) AddPose(scene, fractal, *geometries[after], *rest, &reach);
  }
  return reach;
}

}  // namespace fjord
