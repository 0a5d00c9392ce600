// The fineness of one object for a whole shot, from its tracks and the camera's.
//
// H1 No frame of the shot is coarser than what it asks for alone (Z1 of fineness.h).
// H2 Where few frames move, each is asked for itself. Else the shot is cut into at most as many
//    stretches, bounded as a whole, and cut again where the bound is not close.
// H3 The scene alone decides how the shot is cut: every machine finds the same fineness.
#pragma once

#include <atomic>

#include "engine/animation/fineness.h"
#include "engine/scene/track.h"

namespace fjord {

struct ShotObject {
  const TrackSet& camera;  // those of the scene's tracks that move the camera
  const TrackSet& own;     // those of the object's that change its place or its fineness
  int index = 0;
  Box rest;
  int objects = 1;  // of the scene: the more, the less each is looked at
};

// `scratch`: the scene, shapes may be left out; tracks are applied to it. `cancel` may be null;
// once it is set the answer comes soon and is of no use.
v1::FrameFineness FinenessOverShot(const ShotObject& object, v1::Scene* scratch,
                                   const std::atomic<bool>* cancel);

}  // namespace fjord
