// A whole job on this machine: inbetween, key, render, encode, write; frame after frame. Encoding
// and writing of one frame overlap the rendering of the next where more than one thread is allowed.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "client/frame_folder.h"
#include "client/progress.h"
#include "engine/animation/inbetween.h"
#include "engine/base/frame_set.h"

namespace fjord {

struct LocalRenderJob {
  std::shared_ptr<const Animation> animation;
  FrameSet frames;
  int threads = 0;  // on one frame; 0: one a core
  const std::atomic<bool>* cancel = nullptr;
  double frame_seconds = 0;  // that one frame may take; 0: any time
  // Asked before a frame is rendered; an error ends the job. May be empty.
  std::function<Result<>(const v1::FrameScene& frame, const AssetResolver* assets, uint32_t number)>
      allow = {};
};

struct LocalRenderReport {
  uint32_t rendered = 0;
  uint32_t kept = 0;            // were there already
  uint64_t triangles_made = 0;  // RenderStats
};

// kLimit where a frame takes longer than it may. kCancelled when the flag is set: what was finished
// is written and named in the manifest. `report` is filled in either way.
Result<> RenderLocally(const LocalRenderJob& job, FrameFolder* folder, FrameProgress* progress,
                       LocalRenderReport* report);

}  // namespace fjord
