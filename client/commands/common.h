// What several commands share: frame ranges, sizes, --set, loading an animation.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/animation/inbetween.h"
#include "engine/base/result.h"
#include "engine/scene/load.h"

namespace fjord {

struct FrameRange {
  uint32_t first = 0;  // 0, 0: all
  uint32_t last = 0;
};

// "7", "1-48"; empty: all. kUsage otherwise.
Result<FrameRange> ParseFrameRange(const std::string& text);

// "960x540". kUsage otherwise.
struct PictureSize {
  uint32_t width = 0;
  uint32_t height = 0;
};
Result<PictureSize> ParseSize(const std::string& text);

// "objects[coast].fractal.H=.5". kUsage where there is no '='.
Result<std::vector<Setting>> ParseSettings(const std::vector<std::string>& texts);

// The range within the animation; kInvalid naming both where it is not.
Result<FrameRange> WithinAnimation(FrameRange range, uint32_t first, uint32_t last,
                                   const std::string& scene_file);

// `size` (may be empty) becomes settings of output.width and output.height.
Result<std::vector<Setting>> SettingsOf(const std::vector<std::string>& sets,
                                        const std::string& size);

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
