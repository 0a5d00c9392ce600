// Many placements of one object, as far as fineness goes: the object is prepared once, so the
// finest that any placement asks for counts for all. Near ones are told from far ones by groups.
#pragma once

#include <span>
#include <vector>

#include "engine/asset/asset.h"
#include "engine/scene/shapes.h"
#include "fjord/v1/frame.pb.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {

// One map for each placement, in their order.
PlacementList PlacementsOf(const v1::Object& object);

struct PlacementGroup {
  Box box;           // round the rest pose at every placement of the group
  double scale = 0;  // the largest of the group
};

// Few groups, each close together; none of an object without placements. `rest`: the object's box.
std::vector<PlacementGroup> GroupPlacements(const v1::Object& object, const Box& rest);

// What is asked of each group, with its box in place of the object's, as one length for the object
// itself: the finest. `fineness`: one a group.
v1::FrameFineness FinestOf(std::span<const PlacementGroup> groups,
                           std::span<const v1::FrameFineness> fineness);

}  // namespace fjord
