// How much a frame will make, worked out from its coarse shapes before anything is made: a scene
// can ask for more than any machine ever makes, and must be told so instead of running for ever.
//
// The estimate is of leaves: triangles, or segments of a curve, that nothing splits any further. It
// costs what the coarse shapes cost. It lies on the upper side: tests/animation/estimate_test.cpp
// says by how much.
#pragma once

#include <string>
#include <vector>

#include "engine/animation/inbetween.h"

namespace fjord {

// Leaves of one frame that are made without being asked twice: some minutes on one core.
inline constexpr double kFrameBudget = 2e9;
inline constexpr double kNoBudget = 1e300;

struct ObjectEstimate {
  double leaves = 0;   // of the whole object, as files and checks make it
  double in_view = 0;  // of those that may touch the picture, as rendering makes them
};

struct FrameEstimate {
  std::vector<ObjectEstimate> objects;
  ObjectEstimate all;
};

// `coarser`: with every length that ends splitting so many times as large.
// `assets`: where long lists come from, as in BuildFrame.
Result<ObjectEstimate> EstimateObject(const v1::FrameScene& frame, const AssetResolver* assets,
                                      int object, double coarser = 1);
Result<FrameEstimate> EstimateFrame(const v1::FrameScene& frame, const AssetResolver* assets);

// "3e17", "1200".
std::string LeavesText(double leaves);

// What a budget is held against.
enum class Counted { kInView, kWhole };

// An object that takes its frame over the budget.
struct OverBudget {
  int object = 0;
  std::string knob;  // "epsilon", "pixels" or "viewing"; empty: no fineness can help
  std::string message;
};

// Ok and nothing in `over`: the frame is within the budget. `lift`: how to get more, as
// "--budget lifts it". `scene`: what their knobs are.
Result<> HoldAgainstBudget(const v1::FrameScene& frame, const AssetResolver* assets,
                           const v1::Scene& scene, double budget, Counted counted,
                           const std::string& lift, OverBudget* over);

}  // namespace fjord
