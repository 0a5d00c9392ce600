// The sea: the plane z = level out to the horizon, seen through the same depths as everything else.
//
// Its depth is linear over the picture, so it is evaluated, not drawn. Land that lies in the plane
// wins: the sea is taken to be farther by what rounding to the fixed grid can move a triangle's
// plane.
#pragma once

#include <optional>

#include "engine/render/view.h"

namespace fjord {

struct SeaPlane {
  double depth = 0, along_x = 0,
         along_y = 0;          // depth = (depth + along_x x) + along_y y, 1/256 pixel
  double behind = 0;           // how much farther it counts
  double least = 0, most = 0;  // depths it can have: horizon and near plane

  double At(double x, double y) const { return (depth + along_x * x) + along_y * y; }
  bool Seen(double at) const { return at > least && at <= most; }
};

// None where the eye lies in the plane or never meets it.
std::optional<SeaPlane> MakeSeaPlane(const View& view, double level);

}  // namespace fjord
