// --budget: the leaves of one frame that are made without being asked twice (engine/animation/
// estimate.h).
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "client/commands/common.h"
#include "engine/animation/estimate.h"

namespace fjord {

// `fallback`: what --help says is the default.
void AddBudget(CLI::App* command, std::string* budget, const std::string& fallback = "2e9");

// A number above 0 or `unlimited`; empty: `otherwise`. kUsage.
Result<double> ParseBudget(const std::string& text, double otherwise);

// Where a scene came from: for telling where a knob stands.
struct SceneOrigin {
  std::string file;
  std::vector<Setting> settings;
};

// The frame against the budget: an error stands at the knob.
Result<> CheckFrameBudget(const Animation& animation, const v1::FrameScene& frame,
                          const AssetResolver* assets, uint32_t number, double budget,
                          Counted counted, const SceneOrigin& origin);

// What was found besides.
struct BudgetReport {
  FrameEstimate worst;  // the largest estimate
  // A line with its place where a frame is large that another split would make small; else empty.
  std::string advice;
};

// The same for some of the frames: the first, the last and an even choice between.
Result<> CheckBudget(const Animation& animation, const FrameSet& frames, double budget,
                     Counted counted, const SceneOrigin& origin, BudgetReport* report);

}  // namespace fjord
