#include "engine/animation/check_animation.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "engine/animation/coarse.h"

namespace fjord {
namespace {

constexpr int kMostCoarsenings = 60;

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

Result<Made> Make(const v1::FrameObject& object, uint64_t most_points) {
  // ADAPTIVE reads a view; without a picture the shot's own lengths do
  v1::FrameObject plain = object;
  if (plain.fractal().split() == v1::Fractal::ADAPTIVE)
    plain.mutable_fractal()->set_split(v1::Fractal::LENGTH);
  Result<std::unique_ptr<PreparedFractal>> prepared = PrepareFractal(plain, nullptr);
  if (!prepared) return prepared.error();
  Result<WeldedShape> welded = (*prepared)->Weld({most_points});
  if (!welded) return welded.error();
  return Made{std::move(welded->identity), std::move(welded->mesh.points)};
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
    const std::string frames = "frames " + std::to_string(check_.worst_frame) + " and " +
                               std::to_string(check_.worst_frame + 1);
    if (check_.identities_change > 0 && !check_.by_frame) {
      check_.good = false;
      check_.verdict = "vertices come or go at frame " + std::to_string(check_.identities_change);
    } else if (check_.proportion > kStepProportion) {
      check_.good = false;
      check_.verdict = "a vertex pops between " + frames;
    } else if (check_.identities_change > 0) {
      check_.verdict = "split by frame: vertices come and go from frame " +
                       std::to_string(check_.identities_change) + " on, as asked for";
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
    double step = 0;
    if (SameSettings(before_->object, object)) {
      step = LargestStep(before_->made.points, made.points);
    } else {
      v1::FrameObject same = object;
      *same.mutable_fractal() = before_->object.fractal();
      Result<Made> other = fjord::Make(Coarsened(same, coarser_), options_.most_points);
      if (!other) return other.error();
      if (other->identity != before_->made.identity) return {};  // split LENGTH
      step = LargestStep(before_->made.points, other->points);
    }
    const double proportion = coarse > 0 ? step / coarse : step > 0 ? 1e300 : 0;
    if (proportion > check_.proportion || check_.worst_frame == 0) {
      check_.proportion = proportion;
      check_.worst_frame = frame - 1;
      check_.largest_step = step;
      check_.coarse_step = coarse;
    }
    return {};
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
    const Result<v1::FrameScene> scene = animation.Inbetween(frame);
    if (!scene) return scene.error();
    for (size_t i = 0; i < checkers.size(); ++i) {
      if (!checkers[i]) continue;
      Result<> added = checkers[i]->Add(frame, scene->object(static_cast<int>(i)));
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
