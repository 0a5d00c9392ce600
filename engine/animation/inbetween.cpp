#include "engine/animation/inbetween.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/animation/assemble.h"
#include "engine/animation/fineness.h"
#include "engine/animation/frame_geometry.h"
#include "engine/animation/motion.h"
#include "engine/base/clamp.h"
#include "engine/base/fpenv.h"
#include "engine/scene/track.h"

namespace fjord {
namespace {

// The frames of first..last in which the tracks change anything; one frame where none do.
std::vector<uint32_t> ChangingFrames(const TrackSet& tracks, uint32_t last) {
  if (tracks.empty()) return {1};
  const int64_t from = FloorToInt64(tracks.first_frame());
  const int64_t to = -FloorToInt64(-tracks.last_frame());
  std::vector<uint32_t> frames;
  for (int64_t f = std::clamp<int64_t>(from, 1, last); f <= std::clamp<int64_t>(to, 1, last); ++f) {
    frames.push_back(static_cast<uint32_t>(f));
  }
  return frames;
}

// An object with the lists that tracks do not lead into left out, so that copying it is cheap.
void Lighten(bool keep_shape, v1::Object* object) {
  if (!keep_shape) object->clear_shape();
  object->clear_key();
}

class SceneAnimation final : public Animation {
 public:
  explicit SceneAnimation(LoadedScene loaded) : loaded_(std::move(loaded)) {}

  Result<> Prepare() {
    tracks_ = TrackSet(scene());
    own_tracks_ = tracks_.OfObjects(scene().objects_size());
    template_ = scene();
    template_.clear_track();
    for (int i = 0; i < scene().objects_size(); ++i) {
      if (Result<> made = PrepareObject(i); !made) return made;
    }
    if (Result<> seen = PrepareCamera(); !seen) return seen;
    v1::Scene scratch = template_;
    for (int i = 0; i < scene().objects_size(); ++i) PrepareFineness(i, &scratch);
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
    bool shape_tracked = false;                 // by tracks; then there are no keys
    FramePose still;                            // the lists that are long and never change
    std::optional<v1::FrameFineness> fineness;  // of the shot; none: by frame
  };

  Result<> PrepareObject(int index) {
    const v1::Object& object = scene().objects(index);
    const bool shape_tracked =
        object.has_shape() && own_tracks_[static_cast<size_t>(index)].Touches(
                                  Route().Then("objects", index).Then("shape"));
    std::vector<Geometry> keys;
    const auto read = [&](const v1::Shape& shape) -> Result<> {
      Result<Geometry> geometry = DecodeShape(shape, loaded_.assets);
      if (!geometry) return geometry.error();
      keys.push_back(std::move(*geometry));
      return {};
    };
    if (object.has_shape()) {
      // a shape that tracks change rests as it is at the end
      v1::Scene end;
      if (shape_tracked) {
        end = scene();
        tracks_.Apply(last_frame(), &end);
      }
      if (Result<> done = read(shape_tracked ? end.objects(index).shape() : object.shape());
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
    plans_.push_back({Motion::Make(object, std::move(keys)), shape_tracked, {}, std::nullopt});
    ObjectPlan& plan = plans_.back();
    plan.still.rest_asset = AssetOf(plan.motion.rest());
    plan.still.faces_asset = AssetOf(plan.motion.topology());
    if (one_key) {
      plan.still.points_asset = plan.still.rest_asset;
      plan.still.colors_asset = AssetOf(plan.motion.ColorsAt(1));
    }
    Lighten(shape_tracked, template_.mutable_objects(index));
    return {};
  }

  // The camera in every frame where it changes; it must always see something.
  Result<> PrepareCamera() {
    const TrackSet moves = tracks_.Inside({Route().Then("camera")});
    v1::Scene now;
    *now.mutable_camera() = scene().camera();
    for (const uint32_t frame : ChangingFrames(moves, last_frame())) {
      moves.Apply(frame, &now);
      camera_.emplace_back(now.camera());
      camera_from_ = camera_.size() == 1 ? frame : camera_from_;
      const std::string defect = camera_.back().Defect();
      if (!defect.empty()) {
        return Invalid("frame " + std::to_string(frame) + ": the camera's " + defect);
      }
    }
    return {};
  }

  const CameraState& CameraAt(uint32_t frame) const {
    const size_t at = frame > camera_from_ ? frame - camera_from_ : 0;
    return camera_[std::min(at, camera_.size() - 1)];
  }

  FinenessDemand DemandOf(const v1::Object& now, uint32_t frame) const {
    const v1::Fractal& fractal = now.fractal();
    return {CameraAt(frame), ObjectTransform(now.transform()), fractal.epsilon(), fractal.pixels(),
            fractal.viewing()};
  }

  Box RestBox(int index) const {
    Box box;
    for (const Vec3& point : plans_[static_cast<size_t>(index)].motion.rest()) box.Add(point);
    return box;
  }

  // Cells for bounding the eye, so that many objects over many frames stay affordable. A choice by
  // the scene alone: every machine makes the same.
  int CellsAlong(size_t frames) const {
    const uint64_t work = uint64_t{frames} * static_cast<uint64_t>(scene().objects_size());
    return work <= 5'000 ? 8 : work <= 100'000 ? 4 : work <= 1'000'000 ? 2 : 1;
  }

  // `scratch`: a scene to apply tracks to; the object's own fields of it change.
  void PrepareFineness(int index, v1::Scene* scratch) {
    const v1::Object& object = scene().objects(index);
    if (!object.has_fractal() || object.fractal().split() != v1::Fractal::SHOT) return;
    const Route route = Route().Then("objects", index);
    const Route fractal = route.Then("fractal");
    const TrackSet own = own_tracks_[static_cast<size_t>(index)].Inside(
        {route.Then("transform"), fractal.Then("epsilon"), fractal.Then("pixels"),
         fractal.Then("viewing")});
    std::vector<uint32_t> frames;
    if (!own.empty()) frames = ChangingFrames(own, last_frame());
    if (own.empty() || camera_.size() > 1) {  // and wherever the camera moves
      for (size_t i = 0; i < camera_.size(); ++i) {
        frames.push_back(camera_from_ + static_cast<uint32_t>(i));
      }
    }
    std::sort(frames.begin(), frames.end());
    frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
    std::vector<FinenessDemand> demands;
    for (const uint32_t frame : frames) {
      own.Apply(frame, scratch);
      demands.push_back(DemandOf(scratch->objects(index), frame));
    }
    plans_[static_cast<size_t>(index)].fineness = WorkOutFineness(
        demands, RestBox(index), scene().output().height(), CellsAlong(frames.size()));
  }

  Result<> AddObject(const v1::Scene& now, int index, uint32_t frame, v1::FrameScene* out,
                     AssetSet* assets) const {
    const v1::Object& object = now.objects(index);
    const ObjectPlan& plan = plans_[static_cast<size_t>(index)];
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
    for (int i = 1; i < object.material().ramp_size(); ++i) {
      if (object.material().ramp(i).height() <= object.material().ramp(i - 1).height()) {
        return AtFrame(frame, object, "tracks take ramp heights out of order");
      }
    }
    v1::FrameObject* message = out->add_object();
    const uint32_t height = scene().output().height();
    AssembleGeometry(pose, message, assets);
    if (Result<> done = AssembleObject(object, height, message); !done)
      return AtFrame(frame, object, done.error().message);
    if (!object.has_fractal()) return {};
    if (Result<> done = AssembleFractal(object.fractal(), message->mutable_fractal()); !done)
      return AtFrame(frame, object, done.error().message);
    const FinenessDemand demand = DemandOf(object, frame);
    *message->mutable_fractal()->mutable_fineness() =
        plan.fineness ? *plan.fineness : WorkOutFineness({&demand, 1}, RestBox(index), height);
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
  std::vector<CameraState> camera_;
  uint32_t camera_from_ = 1;  // the frame of camera_[0]
};

}  // namespace

Result<std::shared_ptr<const Animation>> Animation::Make(LoadedScene scene) {
  SetFloatEnvironment();
  auto animation = std::make_shared<SceneAnimation>(std::move(scene));
  if (Result<> prepared = animation->Prepare(); !prepared) return prepared.error();
  return std::shared_ptr<const Animation>(std::move(animation));
}

}  // namespace fjord
