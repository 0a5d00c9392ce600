#include "engine/fractal/surface_weld.h"

#include <string>
#include <utility>

#include "engine/base/check.h"
#include "engine/base/parallel.h"
#include "engine/fractal/surface_plan.h"

namespace fjord {
namespace {

constexpr uint32_t kNone = SurfacePlan::kNone;

// Brings what a plan announces into one shape.
class SurfaceWriter {
 public:
  SurfaceWriter(SurfacePlan* plan, bool details)
      : plan_(*plan), details_(details), shape_(plan->shape) {}

  // Where everything goes; false beyond the limit.
  bool PlacePoints() {
    for (uint32_t side = 0; side < 3 * plan_.parts.size(); ++side) {
      const SurfacePlan::Part& part = plan_.parts[side / 3];
      SurfacePlan::Border& border = plan_.borders[part.side[side % 3].border];
      if (border.middle != kNone || border.side != kNone) continue;
      border.side = side;
      border.count = part.along[side % 3];
    }
    uint64_t points = shape_.mesh.points.size(), leaves = 0;
    for (SurfacePlan::Border& border : plan_.borders) {
      border.first = static_cast<uint32_t>(points);
      points += border.count;
      if (points > plan_.limit) return false;
    }
    for (SurfacePlan::Group& group : plan_.groups) {
      group.first_point = points;
      group.first_leaf = leaves;
      points += group.inner;
      leaves += group.leaves;
      if (points > plan_.limit) return false;
    }
    shape_.mesh.points.resize(points);
    if (plan_.colored) shape_.mesh.colors.resize(points);
    if (details_) {
      shape_.identity.resize(points);
      shape_.level.resize(points);
      shape_.direction.resize(points);
      shape_.coast.resize(points);
    }
    shape_.mesh.face_size.assign(leaves, 3);
    shape_.mesh.face_vertex.resize(3 * leaves);
    return true;
  }

  WeldedShape Write(int threads) {
    ParallelFor(plan_.groups.size(), threads, [this](size_t g) { WriteGroup(plan_.groups[g]); });
    if (!details_) {
      shape_.identity = {};
      shape_.level = {};
      shape_.direction = {};
      shape_.coast = {};
    }
    return std::move(shape_);
  }

 private:
  void WriteGroup(const SurfacePlan::Group& group) {
    std::unique_ptr<SurfaceGroup> made = plan_.Borrow();
    FJORD_CHECK(plan_.Expand(group, details_, made.get()), group.first);
    const Patch& patch = made->patch();
    std::vector<uint32_t> place(patch.vertices.count, kNone);  // of each of the patch's vertices
    const uint32_t corners = 3 * (group.end - group.first);
    for (uint32_t i = 0; i < corners; ++i) {
      const uint32_t number = group.first + i / 3;
      const SurfacePlan::Part& part = plan_.parts[number];
      place[i] = part.corner[i % 3];
      const std::span<const uint32_t> along = made->Along(i);
      const uint32_t* next = along.data();
      Place(part.side[i % 3], &next, &place);
      FJORD_CHECK(next == along.data() + along.size(), number);
      const SurfacePlan::Border& border = plan_.borders[part.side[i % 3].border];
      if (border.side != 3 * number + i % 3) continue;
      for (const uint32_t v : along) WritePoint(*made, v, place[v], border.coast);
    }
    auto inner = static_cast<uint32_t>(group.first_point);
    for (uint32_t v = corners; v < patch.vertices.count; ++v) {
      if (place[v] != kNone) continue;
      place[v] = inner++;
      WritePoint(*made, v, place[v], false);
    }
    uint32_t* corner = shape_.mesh.face_vertex.data() + 3 * group.first_leaf;
    for (size_t t = 0; t < patch.leaves.count; ++t) {
      for (const PatchBuffer<uint32_t>& leaf : patch.leaves.corner) *corner++ = place[leaf[t]];
    }
    plan_.Return(std::move(made));
  }

  // The places of a side's points; `next` is the first of those that are left.
  void Place(const SurfacePlan::Side& side, const uint32_t** next,
             std::vector<uint32_t>* place) const {
    const SurfacePlan::Border& border = plan_.borders[side.border];
    if (border.middle != kNone) {
      Place(side.Half(border, 0), next, place);
      (*place)[*(*next)++] = border.middle;
      Place(side.Half(border, 1), next, place);
      return;
    }
    for (uint32_t i = 0; i < border.count; ++i) {
      (*place)[*(*next)++] = border.first + (side.against ? border.count - 1 - i : i);
    }
  }

  void WritePoint(const SurfaceGroup& made, size_t vertex, size_t place, bool coast) {
    const StreamVertex& v = made.patch().vertices.value[vertex];
    shape_.mesh.points[place] = v.position;
    if (plan_.colored) shape_.mesh.colors[place] = made.patch().vertices.color[vertex];
    if (!details_) return;
    shape_.identity[place] = made.IdentityOf(vertex);
    shape_.level[place] = made.LevelOf(vertex);
    shape_.direction[place] = v.direction;
    shape_.coast[place] = coast ? 1 : 0;
  }

  SurfacePlan& plan_;
  const bool details_;
  WeldedShape& shape_;
};

Error TooMany(uint64_t limit) {
  return MakeError(ErrorCode::kLimit, "the shape has more than " + std::to_string(limit) +
                                          " points at this fineness; take a larger epsilon or a "
                                          "smaller max_level");
}

}  // namespace

Result<WeldedShape> WeldSurface(const SurfaceRoots& roots, const CoarseSurface& coarse,
                                const SurfaceRules& rules, const WeldLimits& limits) {
  if (coarse.vertices.size() > limits.max_points) return TooMany(limits.max_points);
  SurfacePlan plan(roots, coarse, rules, limits);
  if (!plan.Make()) return TooMany(limits.max_points);
  SurfaceWriter writer(&plan, limits.details);
  if (!writer.PlacePoints()) return TooMany(limits.max_points);
  return writer.Write(limits.threads);
}

}  // namespace fjord
