#include "engine/animation/placements.h"

#include <algorithm>

#include "engine/base/check.h"
#include "engine/scene/transform.h"

namespace fjord {
namespace {

constexpr size_t kGroups = 64;

struct Placed {
  Box box;
  double scale = 0;
};

using Iterator = std::vector<Placed>::iterator;

// Halves along the longest side, by number, until there are `groups`.
void Split(Iterator begin, Iterator end, size_t groups, std::vector<PlacementGroup>* out) {
  Box centers, whole;
  double scale = 0;
  for (Iterator placed = begin; placed != end; ++placed) {
    centers.Add(placed->box.Center());
    whole.Add(placed->box.low);
    whole.Add(placed->box.high);
    scale = std::max(scale, placed->scale);
  }
  const Vec3 size = centers.Size();
  const double longest = std::max({size.x, size.y, size.z});
  if (groups < 2 || longest == 0) {
    out->push_back({whole, scale});
    return;
  }
  const int axis = size.x == longest ? 0 : size.y == longest ? 1 : 2;
  const Iterator middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end, [axis](const Placed& a, const Placed& b) {
    return a.box.Center()[axis] < b.box.Center()[axis];
  });
  Split(begin, middle, groups / 2, out);
  Split(middle, end, groups / 2, out);
}

double Apart(const Box& box, const Vec3& point) {
  Vec3 apart(0);
  for (int i = 0; i < 3; ++i) {
    apart[i] = std::max({0.0, box.low[i] - point[i], point[i] - box.high[i]});
  }
  return Length(apart);
}

// The finest that is asked anywhere in the box, as a length.
double EpsilonIn(const Box& box, const v1::FrameFineness& fineness) {
  if (fineness.focal() <= 0) return fineness.epsilon();
  const Vec3 eye(fineness.eye(0), fineness.eye(1), fineness.eye(2));
  const double distance = std::max(fineness.near(), Apart(box, eye) - fineness.eye_radius());
  return fineness.pixels() * distance / fineness.focal();
}

}  // namespace

PlacementList PlacementsOf(const v1::Object& object) {
  PlacementList placements;
  placements.reserve(static_cast<size_t>(object.placements_size()));
  for (const v1::Transform& placement : object.placements()) {
    placements.push_back(ObjectTransform(placement).Rows());
  }
  return placements;
}

std::vector<PlacementGroup> GroupPlacements(const v1::Object& object, const Box& rest) {
  std::vector<Placed> placed;
  for (const v1::Transform& placement : object.placements()) {
    const ObjectTransform transform(placement);
    Placed one;
    one.scale = transform.largest_scale();
    if (one.scale <= 0) continue;  // nothing is seen of it
    for (int corner = 0; corner < 8; ++corner) {
      one.box.Add(transform.ToWorld({(corner & 1) != 0 ? rest.high.x : rest.low.x,
                                     (corner & 2) != 0 ? rest.high.y : rest.low.y,
                                     (corner & 4) != 0 ? rest.high.z : rest.low.z}));
    }
    placed.push_back(one);
  }
  std::vector<PlacementGroup> groups;
  if (!placed.empty()) Split(placed.begin(), placed.end(), kGroups, &groups);
  return groups;
}

v1::FrameFineness FinestOf(std::span<const PlacementGroup> groups,
                           std::span<const v1::FrameFineness> fineness) {
  FJORD_CHECK(groups.size() == fineness.size(), groups.size(), fineness.size());
  double epsilon = 1e100;  // never any size: nothing is split
  for (size_t i = 0; i < groups.size(); ++i) {
    epsilon = std::min(epsilon, EpsilonIn(groups[i].box, fineness[i]) / groups[i].scale);
  }
  v1::FrameFineness finest;
  finest.set_epsilon(epsilon);
  return finest;
}

}  // namespace fjord
