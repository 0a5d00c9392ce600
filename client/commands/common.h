// What several commands share: frames, changes to a scene (--set, --size, --samples), loading an
// animation.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/animation/inbetween.h"
#include "engine/base/frame_set.h"
#include "engine/base/result.h"
#include "engine/scene/load.h"

namespace fjord {

// --frames: "7", "1-48", "1-10,12,20-40x2"; empty: none is named, which is all. kUsage otherwise.
Result<FrameSet> ParseFrames(const std::string& text);
// Adds --frames.
void AddFrames(CLI::App* command, std::string* frames);

inline constexpr double kMostFrameSeconds = 604'800;  // --frame-limit: a week

// "960x540", or "50%" of the scene's. kUsage otherwise.
struct PictureSize {
  uint32_t width = 0;
  uint32_t height = 0;
  double share = 0;  // > 0: of the scene's size, instead of width and height
};
Result<PictureSize> ParseSize(const std::string& text);

// What the command line changes of a scene.
struct SceneChanges {
  std::vector<std::string> sets;  // --set PATH=VALUE
  std::string size;               // --size
  uint32_t samples = 0;           // --samples; 0: the scene's
};
// Adds --set, --size and --samples.
void AddSceneChanges(CLI::App* command, SceneChanges* changes);
void AddSets(CLI::App* command, SceneChanges* changes);  // --set alone

// "objects[coast].fractal.H=.5". kUsage where there is no '='.
Result<std::vector<Setting>> ParseSettings(const std::vector<std::string>& texts);

// `frames`, or, where none is named, all; kInvalid naming both where they are not within the
// animation.
Result<FrameSet> WithinAnimation(const FrameSet& frames, uint32_t first, uint32_t last,
                                 const std::string& scene_file);

// All changes as settings of the scene. The file is read where the size is a share of its own; a
// defect of it is left to whoever loads it.
Result<std::vector<Setting>> SettingsOf(const SceneChanges& changes, const std::string& scene_file);

struct OpenedScene {
  std::shared_ptr<const Animation> animation;
  std::string digest;  // of the complete scene
};

// The error with the scene file as its place, where it has none of its own.
Error InScene(Error error, const std::string& scene_file);

// Loads, checks and readies a scene; every defect comes back.
Errors OpenScene(const std::string& path, const std::vector<Setting>& settings,
                 OpenedScene* opened);

}  // namespace fjord
