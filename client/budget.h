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

// How many leaves in view the frame's object would have instead of `leaves` under split ADAPTIVE,
// as a clause; empty where that would be no help.
std::string AdaptiveAdvice(const Animation& animation, int object, uint32_t frame, double leaves,
                           const SceneOrigin& origin);

}  // namespace fjord
