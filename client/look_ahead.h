// What stands in the way of rendering frames of a scene, found on some of them before any is
// rendered: the first, the last, those at keys (between keys every number goes one way, so what
// tracks take out of bounds they mostly take there) and an even choice. `check`, `render` and
// `submit` all look, so what `render` refuses `check` finds.
#pragma once

#include <string>

#include "client/budget.h"

namespace fjord {

struct LookAhead {
  FrameEstimate worst;  // the largest estimate
  // A line with its place where a frame is large that another split would make small; else empty.
  std::string advice;
};

// An error stands at its field where that is known. `animation` is of the scene at `origin`.
Result<> LookAtFrames(const Animation& animation, const FrameSet& frames, double budget,
                      const SceneOrigin& origin, LookAhead* found);

}  // namespace fjord
