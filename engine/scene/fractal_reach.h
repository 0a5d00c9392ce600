// How far what a fractal method makes of an object lies beyond the box of its coarse shape: what a
// camera needs to know that is to have all of it in view.
//
// Found by making the fractal itself, about as finely as a picture of it alone would, of each key
// picture and of the values that tracks give at their keys; between keys every number goes one way.
// Of a subtree that its bound keeps within the box so far nothing is made. A pure function of the
// object, so a scene gets the same camera everywhere.
#pragma once

#include "engine/scene/scene_shapes.h"
#include "engine/scene/track.h"

namespace fjord {

// Beyond each side of the box, object space; 0 or more.
struct FractalReach {
  Vec3 low{0}, high{0};

  Box Around(const Box& box) const;
};

// `own`: the tracks that lead into the object. Nothing for objects without a fractal, and for those
// that cannot be prepared, which whoever renders them says.
FractalReach ReachOfFractal(const v1::Scene& scene, int object, const SceneShapes& shapes,
                            const TrackSet& own);

}  // namespace fjord
