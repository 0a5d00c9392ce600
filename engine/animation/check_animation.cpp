#include "engine/animation/check_animation.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/animation/coarse.h"
#include "engine/animation/frame_geometry.h"
#include "engine/base/clamp.h"

namespace fjord {
namespace {

constexpr int kMostCoarsenings = 60;

// Looking closer: this many halvings of the time between two frames, always of the half with the
// larger step. Of an even movement about 1/64 of the step is left then, of a jump all of it.
constexpr int kHalvings = 6;
constexpr double kShareOfAJump = .25;

// One frame of one object, as far as the check goes.
struct Made {
  std::vector<Identity> identity;
  std::vector<Vec3> points;
};

v1::FrameObject Coarsened(v1::FrameObject object, double factor) {
  v1::FrameFineness* fineness = object.mutable_fractal()->mutable_fineness();
  fineness->set_epsilon(fineness->epsilon() * factor);
  fineness->set_pixels(fineness->pixels() * factor);
  return object;
}

void SortByIdentity(Made* made) {
  std::vector<uint32_t> order(made->identity.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return made->identity[a] != made->identity[b] ? made->identity[a] < made->identity[b] : a < b;
  });
  const Made before = *made;
  for (size_t i = 0; i < order.size(); ++i) {
    made->identity[i] = before.identity[order[i]];
    made->points[i] = before.points[order[i]];
  }
}

Result<Made> Make(const v1::FrameObject& object, uint64_t most_points) {
  Result<std::unique_ptr<PreparedFractal>> prepared = PrepareFractal(object);
  if (!prepared) return prepared.error();
  Result<WeldedShape> welded = (*prepared)->Weld({most_points});
  if (!welded) return welded.error();
  Made made{std::move(welded->identity), std::move(welded->mesh.points)};
  // The frame's own lengths may change the order of vertices where they do not change the tree.
  if (object.fractal().split() != v1::Fractal::SHOT) SortByIdentity(&made);
  return made;
}

double LargestStep(std::span<const Vec3> before, std::span<const Vec3> after) {
  double largest = 0;
  for (size_t i = 0; i < before.size(); ++i) {
    const Vec3 step = after[i] - before[i];
    largest = std::max(largest, glm::dot(step, step));
  }
  return std::sqrt(largest);
}

std::vector<Vec3> CoarsePoints(const v1::FrameObject& object) {
  std::vector<Vec3> points;
  for (int i = 0; i + 2 < object.point_size(); i += 3) {
    points.emplace_back(object.point(i), object.point(i + 1), object.point(i + 2));
  }
  return points;
}

// Halfway between two frames of an object as far as its shape goes; all else is the later one's.
v1::FrameObject Halfway(const v1::FrameObject& a, const v1::FrameObject& b) {
  v1::FrameObject middle = b;
  for (int i = 0; i < middle.point_size(); ++i) {
    middle.set_point(i, (a.point(i) + b.point(i)) * .5);
  }
  return middle;
}

bool SameSettings(const v1::FrameObject& a, const v1::FrameObject& b) {
  return a.fractal().SerializeAsString() == b.fractal().SerializeAsString();
}

// The frames of one object, one after another.
class ObjectChecker {
 public:
  ObjectChecker(std::string name, const AnimationCheckOptions& options) : options_(options) {
    check_.object = std::move(name);
  }

  Result<> Add(uint32_t frame, const v1::FrameObject& object) {
    Result<Made> made = MakeWithin(object);
    if (!made) return made.error();
    if (before_) {
      if (made->identity == before_->made.identity) {
        Result<> compared = Compare(frame, object, *made);
        if (!compared) return compared;
      } else if (check_.identities_change == 0) {
        check_.identities_change = frame;
      }
    }
    check_.by_frame = object.fractal().split() != v1::Fractal::SHOT;
    check_.vertices = made->points.size();
    before_ = Before{object, std::move(*made)};
    return {};
  }

  ObjectCheck Finish() {
    check_.coarser = coarser_;
    const auto frames = [](uint32_t frame) {
      return "frames " + std::to_string(frame) + " and " + std::to_string(frame + 1);
    };
    if (check_.identities_change > 0 && !check_.by_frame) {
      check_.good = false;
      check_.verdict = "vertices come or go at frame " + std::to_string(check_.identities_change);
    } else if (check_.pops > 0) {
      check_.good = false;
      check_.verdict = "a vertex pops between " + frames(check_.pops) +
                       ": the shape turns over there; use direction: UP, which does not turn with "
                       "it, or keys that turn it less";
    } else if (check_.identities_change > 0) {
      check_.verdict = "split by frame: vertices come and go from frame " +
                       std::to_string(check_.identities_change) + " on, as asked for";
    } else if (check_.proportion > kStepProportion) {
      check_.verdict = "the same vertices in every frame, none jumps; between " +
                       frames(check_.worst_frame) + " one moves " +
                       std::to_string(RoundToInt32(check_.proportion)) +
                       " times as far as the shape";
    } else {
      check_.verdict = "the same vertices in every frame, none steps out of proportion";
    }
    return std::move(check_);
  }

 private:
  struct Before {
    v1::FrameObject object;
    Made made;
  };

  // As fine as fits; once coarser, always coarser, and what was compared so far stays compared.
  Result<Made> MakeWithin(const v1::FrameObject& object) {
    for (int i = 0;; ++i) {
      Result<Made> made = fjord::Make(Coarsened(object, coarser_), options_.most_points);
      if (made || made.error().code != ErrorCode::kLimit || i == kMostCoarsenings) return made;
      coarser_ *= 2;
      if (!before_) continue;
      made = fjord::Make(Coarsened(before_->object, coarser_), options_.most_points);
      if (!made) return made;
      before_->made = std::move(*made);
    }
  }

  Result<> Compare(uint32_t frame, const v1::FrameObject& object, const Made& made) {
    const double coarse = LargestStep(CoarsePoints(before_->object), CoarsePoints(object));
    v1::FrameObject same = object;
    std::vector<Vec3> points = made.points;
    if (!SameSettings(before_->object, object)) {
      *same.mutable_fractal() = before_->object.fractal();
      Result<Made> other = fjord::Make(Coarsened(same, coarser_), options_.most_points);
      if (!other) return other.error();
      if (other->identity != before_->made.identity) return {};  // split LENGTH
      points = std::move(other->points);
    }
    const double step = LargestStep(before_->made.points, points);
    const double proportion = coarse > 0 ? step / coarse : step > 0 ? 1e300 : 0;
    if (proportion > kStepProportion && check_.pops == 0) {
      const Result<bool> jumps = Jumps(same, std::move(points));
      if (!jumps) return jumps.error();
      if (*jumps) check_.pops = frame - 1;
    }
    if (proportion > check_.proportion || check_.worst_frame == 0) {
      check_.proportion = proportion;
      check_.worst_frame = frame - 1;
      check_.largest_step = step;
      check_.coarse_step = coarse;
    }
    return {};
  }

  // Does the step from the frame before to `after` stay when the two come closer?
  Result<bool> Jumps(v1::FrameObject after, std::vector<Vec3> after_points) const {
    v1::FrameObject before = before_->object;
    std::vector<Vec3> before_points = before_->made.points;
    const double whole = LargestStep(before_points, after_points);
    double step = whole;
    for (int i = 0; i < kHalvings; ++i) {
      v1::FrameObject middle = Halfway(before, after);
      Result<Made> made = fjord::Make(Coarsened(middle, coarser_), options_.most_points);
      if (!made) return made.error();
      if (made->identity != before_->made.identity) return false;  // split LENGTH
      const double first = LargestStep(before_points, made->points);
      const double second = LargestStep(made->points, after_points);
      step = std::max(first, second);
      (first >= second ? after : before) = std::move(middle);
      (first >= second ? after_points : before_points) = std::move(made->points);
    }
    return step > kShareOfAJump * whole;
  }

  const AnimationCheckOptions& options_;
  ObjectCheck check_;
  double coarser_ = 1;
  std::optional<Before> before_;
};

}  // namespace

Result<AnimationCheck> CheckAnimation(const Animation& animation,
                                      const AnimationCheckOptions& options) {
  std::vector<std::optional<ObjectChecker>> checkers;
  for (const v1::Object& object : animation.scene().objects()) {
    checkers.emplace_back();
    if (object.has_fractal()) checkers.back().emplace(object.name(), options);
  }
  for (uint32_t frame = animation.first_frame(); frame <= animation.last_frame(); ++frame) {
    AssetSet assets;
    const Result<v1::FrameScene> scene = animation.Inbetween(frame, &assets);
    if (!scene) return scene.error();
    for (size_t i = 0; i < checkers.size(); ++i) {
      if (!checkers[i]) continue;
      const Result<v1::FrameObject> object =
          WrittenOut(scene->object(static_cast<int>(i)), &assets);
      if (!object) return object.error();
      Result<> added = checkers[i]->Add(frame, *object);
      if (!added) return added.error();
    }
    if (options.progress && !options.progress(frame)) {
      return MakeError(ErrorCode::kCancelled, "cancelled at frame " + std::to_string(frame));
    }
  }
  AnimationCheck check;
  for (auto& checker : checkers) {
    if (!checker) continue;
    check.objects.push_back(checker->Finish());
    check.good = check.good && check.objects.back().good;
  }
  return check;
}

}  // namespace fjord
