#include "engine/animation/inbetween.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/animation/assemble.h"
#include "engine/animation/camera_check.h"
#include "engine/animation/fineness.h"
#include "engine/animation/frame_geometry.h"
#include "engine/animation/motion.h"
#include "engine/animation/placements.h"
#include "engine/animation/shot_fineness.h"
#include "engine/base/fpenv.h"
#include "engine/scene/track.h"

namespace fjord {
namespace {

// An object with the lists that tracks do not lead into left out, so that copying it is cheap.
void Lighten(bool keep_shape, v1::Object* object) {
  if (!keep_shape) object->clear_shape();
  object->clear_placements();
  object->clear_key();
}

// The size that tracks may change of heights, or of a grid that is drawn as such.
Vec3 SizeOfHeights(const v1::Shape& shape) {
  if (shape.has_heights()) {
    const v1::Vec3& size = shape.heights().size();
    return {size.x(), size.y(), size.z()};
  }
  return {shape.primitive().size().x(), shape.primitive().size().y(), 1};
}

class SceneAnimation final : public Animation {
 public:
  explicit SceneAnimation(LoadedScene loaded) : loaded_(std::move(loaded)) {}

  Result<> Prepare(const std::atomic<bool>* cancel) {
    const Error cancelled = MakeError(ErrorCode::kCancelled, "cancelled");
    const auto stop = [&] { return cancel != nullptr && cancel->load(std::memory_order_relaxed); };
    tracks_ = TrackSet(scene());
    own_tracks_ = tracks_.OfObjects(scene().objects_size());
    template_ = scene();
    template_.clear_track();
    std::optional<v1::Scene> at_end;
    for (int i = 0; i < scene().objects_size(); ++i) {
      if (stop()) return cancelled;
      if (Result<> made = PrepareObject(i, &at_end); !made) return made;
    }
    const TrackSet camera = tracks_.Inside({Route().Then("camera")});
    v1::Scene scratch = template_;
    if (const auto blind = FindBlindFrame(camera, last_frame(), &scratch)) {
      return Blind(blind->frame, blind->defect);
    }
    for (int i = 0; i < scene().objects_size(); ++i) {
      PrepareFineness(i, camera, &scratch, cancel);
      if (stop()) return cancelled;
    }
    return {};
  }

  const v1::Scene& scene() const override { return loaded_.scene; }
  uint32_t first_frame() const override { return 1; }
  uint32_t last_frame() const override { return scene().output().frames(); }

  Result<v1::FrameScene> Inbetween(uint32_t frame, AssetSet* assets) const override {
    SetFloatEnvironment();
    if (frame < first_frame() || frame > last_frame()) {
      return Invalid("frame " + std::to_string(frame) + " is outside the animation, frames " +
                     std::to_string(first_frame()) + " to " + std::to_string(last_frame()));
    }
    v1::Scene now = template_;
    tracks_.Apply(frame, &now);
    const std::string defect = CameraState(now.camera()).Defect();
    if (!defect.empty()) return Blind(frame, defect);
    v1::FrameScene out;
    AssembleSurroundings(now, &out);
    for (int i = 0; i < now.objects_size(); ++i) {
      Result<> added = AddObject(now, i, frame, &out, assets);
      if (!added) return added.error();
    }
    return out;
  }

 private:
  struct ObjectPlan {
    Motion motion;
    bool shape_tracked = false;          // by tracks; then there are no keys
    FramePose still;                     // the lists that are long and never change
    std::optional<HeightsPose> heights;  // drawn from its samples; then no more of a shape
    PlacementList placements;
    SharedAsset placements_asset;
    std::vector<PlacementGroup> groups;
    std::optional<v1::FrameFineness> fineness;  // of the shot; none: by frame
  };

  static Error Blind(uint32_t frame, const std::string& defect) {
    return Invalid("frame " + std::to_string(frame) + ": the camera's " + defect);
  }

  // `at_end`: the scene in its last frame, made once it is needed.
  Result<> PrepareObject(int index, std::optional<v1::Scene>* at_end) {
    const v1::Object& object = scene().objects(index);
    const bool shape_tracked =
        object.has_shape() && own_tracks_[static_cast<size_t>(index)].Touches(
                                  Route().Then("objects", index).Then("shape"));
    std::vector<Geometry> keys;
    const auto read = [&](const v1::Shape& shape) -> Result<> {
      Result<Geometry> geometry = DecodeShape(shape, loaded_.assets);
      if (!geometry) return geometry.error();
      if (object.has_fractal() || !object.has_shape()) geometry = WithMesh(std::move(*geometry));
      if (!geometry) return geometry.error();
      keys.push_back(std::move(*geometry));
      return {};
    };
    if (object.has_shape()) {
      // a shape that tracks change rests as it is at the end
      if (shape_tracked && !*at_end) {
        *at_end = scene();
        tracks_.Apply(last_frame(), &**at_end);
      }
      if (Result<> done = read(shape_tracked ? (*at_end)->objects(index).shape() : object.shape());
          !done) {
        return done;
      }
    }
    for (const v1::Key& key : object.key()) {
      if (object.has_shape()) break;
      if (Result<> done = read(key.shape()); !done) return done;
    }
    if (keys.empty()) return Invalid("objects[" + object.name() + "] has no shape");
    const bool one_key = keys.size() == 1 && !shape_tracked;
    const std::optional<HeightField> heights = keys[0].heights;
    plans_.push_back({Motion::Make(object, std::move(keys)), shape_tracked});
    ObjectPlan& plan = plans_.back();
    if (heights) {
      HeightsPose& pose = plan.heights.emplace();
      pose.now = *heights;
      pose.rest_size = heights->size;
      pose.flat = !object.shape().has_heights();
      // what decides how finely they are drawn stands where an object's fractal has it
      v1::Fractal* fineness = template_.mutable_objects(index)->mutable_fractal();
      fineness->set_split(v1::Fractal::SHOT);
      const v1::Heights& written = object.shape().heights();
      if (written.has_epsilon()) fineness->set_epsilon(written.epsilon());
      if (!written.has_epsilon()) fineness->set_pixels(pose.flat ? 1 : written.pixels());
      if (!pose.flat) pose.samples_asset = AssetOf(heights->source);
    }
    plan.placements = PlacementsOf(object);
    plan.placements_asset = AssetOf(plan.placements);
    plan.groups = GroupPlacements(object, RestBox(index));
    plan.still.rest_asset = AssetOf(plan.motion.rest());
    plan.still.faces_asset = AssetOf(plan.motion.topology());
    if (one_key) {
      plan.still.points_asset = plan.still.rest_asset;
      plan.still.colors_asset = AssetOf(plan.motion.ColorsAt(1));
    }
    Lighten(shape_tracked, template_.mutable_objects(index));
    return {};
  }

  Box RestBox(int index) const {
    Box box;
    for (const Vec3& point : plans_[static_cast<size_t>(index)].motion.rest()) box.Add(point);
    return box;
  }

  // What work(box) asks for the object's box, or for the finest of its placements.
  template <typename Work>
  v1::FrameFineness AtAllPlaces(int index, const Work& work) const {
    const ObjectPlan& plan = plans_[static_cast<size_t>(index)];
    if (plan.placements.empty()) return work(RestBox(index));
    std::vector<v1::FrameFineness> asked;
    for (const PlacementGroup& group : plan.groups) asked.push_back(work(group.box));
    return FinestOf(plan.groups, asked);
  }

  // `scratch`: a scene to apply tracks to; its camera and the object's own fields change.
  void PrepareFineness(int index, const TrackSet& camera, v1::Scene* scratch,
                       const std::atomic<bool>* cancel) {
    const v1::Object& object = template_.objects(index);
    if (!object.has_fractal() || object.fractal().split() != v1::Fractal::SHOT) return;
    const Route route = Route().Then("objects", index);
    const Route fractal = route.Then("fractal");
    const TrackSet own = own_tracks_[static_cast<size_t>(index)].Inside(
        {route.Then("transform"), fractal.Then("epsilon"), fractal.Then("pixels"),
         fractal.Then("viewing")});
    plans_[static_cast<size_t>(index)].fineness = AtAllPlaces(index, [&](const Box& rest) {
      return FinenessOverShot({camera, own, index, rest, scene().objects_size()}, scratch, cancel);
    });
  }

  Result<> AddObject(const v1::Scene& now, int index, uint32_t frame, v1::FrameScene* out,
                     AssetSet* assets) const {
    const v1::Object& object = now.objects(index);
    const ObjectPlan& plan = plans_[static_cast<size_t>(index)];
    v1::FrameObject* message = out->add_object();
    const uint32_t height = scene().output().height();
    for (int i = 1; i < object.material().ramp_size(); ++i) {
      if (object.material().ramp(i).height() <= object.material().ramp(i - 1).height()) {
        return AtFrame(frame, object, "tracks take ramp heights out of order");
      }
    }
    const bool curve = plan.motion.topology().curve;
    if (Result<> done = AssembleObject(object, curve, height, message); !done)
      return AtFrame(frame, object, done.error().message);
    AssembleReads(scene().objects(index), frame, message, out);
    AssemblePlacements(plan.placements, plan.placements_asset, message, assets);
    const auto fineness = [&] {
      const v1::Fractal& fractal = object.fractal();
      const FinenessDemand demand{CameraState(now.camera()), ObjectTransform(object.transform()),
                                  fractal.epsilon(), fractal.pixels(), fractal.viewing()};
      return plan.fineness ? *plan.fineness : AtAllPlaces(index, [&](const Box& rest) {
        return WorkOutFineness({&demand, 1}, rest, height);
      });
    };
    if (plan.heights) {
      HeightsPose pose = *plan.heights;
      if (plan.shape_tracked) pose.now.size = SizeOfHeights(object.shape());
      AssembleHeights(pose, message->mutable_heights(), assets);
      *message->mutable_heights()->mutable_fineness() = fineness();
      return {};
    }
    FramePose pose = plan.still;
    std::vector<Vec3> points;
    std::vector<Rgb> colors;
    if (plan.shape_tracked) {
      Result<Geometry> geometry = DecodeShape(object.shape(), loaded_.assets);
      if (!geometry) return AtFrame(frame, object, geometry.error().message);
      points = std::move(geometry->points);
      colors = std::move(geometry->colors);
    } else {
      if (!pose.points_asset) plan.motion.PointsAt(object, frame, &points);
      if (!pose.colors_asset) colors = plan.motion.ColorsAt(frame);
    }
    pose.topology = &plan.motion.topology();
    pose.points = points;
    pose.rest = plan.motion.rest();
    pose.colors = colors;
    AssembleGeometry(pose, message, assets);
    if (!object.has_fractal()) return {};
    if (Result<> done = AssembleFractal(object.fractal(), message->mutable_fractal()); !done)
      return AtFrame(frame, object, done.error().message);
    *message->mutable_fractal()->mutable_fineness() = fineness();
    return {};
  }

  static Error AtFrame(uint32_t frame, const v1::Object& object, const std::string& message) {
    return Invalid("frame " + std::to_string(frame) + ": objects[" + object.name() +
                   "]: " + message);
  }

  const LoadedScene loaded_;
  TrackSet tracks_;
  std::vector<TrackSet> own_tracks_;  // those that lead into each object
  v1::Scene template_;                // the scene without the shapes that tracks do not change
  std::vector<ObjectPlan> plans_;     // one an object
};

}  // namespace

Result<std::shared_ptr<const Animation>> Animation::Make(LoadedScene scene,
                                                         const std::atomic<bool>* cancel) {
  SetFloatEnvironment();
  auto animation = std::make_shared<SceneAnimation>(std::move(scene));
  if (Result<> prepared = animation->Prepare(cancel); !prepared) return prepared.error();
  return std::shared_ptr<const Animation>(std::move(animation));
}

}  // namespace fjord
