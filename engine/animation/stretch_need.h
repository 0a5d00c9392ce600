// What all frames of a stretch ask of an object together, from the bounds on their numbers.
#pragma once

#include "engine/animation/fineness.h"
#include "engine/animation/stretch.h"

namespace fjord {

// Puts the numbers into the scene's camera and into one of its objects.
void Show(const ShotNumbers& numbers, int object, v1::Scene* scene);

// The most that any frame asks for whose numbers lie within the bounds. `ratio`: the largest that
// two sizes along the axes have to each other in any of the frames; 0: unknown. `scratch`: the
// scene; its camera and object change.
FinenessNeed NeedBetween(const ShotBounds& bounds, double ratio, const Box& rest, int object,
                         v1::Scene* scratch);

}  // namespace fjord
