// One eye that stands for all places a camera takes: a place and a radius so that, for every x in a
// box, |x - center| - radius is at most the distance from x to any of the eyes. A moving camera
// then never asks for more than the one eye gives (FrameFineness). An eye that is known only to be
// somewhere in a ball has the same form, so bounds can be bounded again.
#pragma once

#include <span>
#include <vector>

#include "engine/scene/shapes.h"

namespace fjord {

struct EyeBound {
  Vec3 center{0};
  double radius = 0;
};

// 0 inside the box.
double DistanceTo(const Box& box, const Vec3& point);

// A box cut into cells, to bound a function over it: places, and how far a cell reaches from each.
struct BoxCells {
  std::vector<Vec3> centers;
  double reach = 0;
};
// At most `along` cells along each side; one where the box is flat.
BoxCells CutBox(const Box& box, int along);

// Few candidates, each right; which is best depends on what is asked (fineness.cpp). One eye place
// gives one bound of its own radius. `eyes` not empty. `along`: cells along each side of the box;
// more are tighter and take longer.
std::vector<EyeBound> BoundEyes(std::span<const EyeBound> eyes, const Box& box, int along);

}  // namespace fjord
