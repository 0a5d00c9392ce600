// `fjord check --animation`: proves on a scene that nothing pops or boils while its shapes move.
//
// For every object with a fractal, every frame's shape is made whole (as coarse as it takes to stay
// within most_points; fineness does not change what is checked), in object space. Asked of each:
// - the same identities in every frame (under split SHOT), so that no vertex comes or goes;
// - between neighbouring frames, at unchanged settings, no vertex jumps: detail rides with the
//   shape. A vertex that steps further than kStepProportion times the largest step of a coarse
//   vertex is looked at closer, at times between the two frames: what jumps does so at one of them,
//   what moves steeply takes smaller steps. Settings that tracks change move vertices evenly; their
//   part is left out by making the later frame with the earlier frame's settings.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/animation/inbetween.h"

namespace fjord {

// A midpoint follows the mean of its coarse neighbours, and its offset turns and grows with the
// shape around it; fixed directions stay below 2 even from flat to steep and rough. A vertex that
// pops jumps by its offset however small the coarse step is.
inline constexpr double kStepProportion = 4;

struct AnimationCheckOptions {
  uint64_t most_points = 100'000;  // of one object
  // Called with each frame done; false ends with kCancelled. May be empty.
  std::function<bool(uint32_t frame)> progress;
};

struct ObjectCheck {
  std::string object;
  size_t vertices = 0;
  double coarser = 1;              // by how much than the scene asks for
  bool by_frame = false;           // split ADAPTIVE or LENGTH: identities may differ
  uint32_t identities_change = 0;  // first frame with others than frame 1, or 0
  double largest_step = 0;         // of a vertex, between neighbouring frames
  double coarse_step = 0;          // of a coarse vertex, between the same frames
  double proportion = 0;           // largest over the shot of step / largest coarse step
  uint32_t worst_frame = 0;        // where that is: from this frame to the next
  uint32_t pops = 0;               // first frame after which a vertex jumps, or 0
  bool good = true;
  std::string verdict;  // a sentence
};

struct AnimationCheck {
  std::vector<ObjectCheck> objects;  // those with a fractal
  bool good = true;
};

Result<AnimationCheck> CheckAnimation(const Animation& animation,
                                      const AnimationCheckOptions& options = {});

}  // namespace fjord
