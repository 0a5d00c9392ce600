// Brings the finished frames of a job into a folder, as `render` would have written them.
#pragma once

#include <atomic>
#include <string>

#include "client/farm_client.h"
#include "engine/base/frame_set.h"

namespace fjord {

struct FetchOrder {
  std::string job;
  std::string folder;
  FrameSet frames;       // none: all of the job
  bool replace = false;  // frames of an older version of the scene
};

struct FetchReport {
  std::string name;
  FrameSet frames;  // asked for
  uint32_t total = 0;
  uint32_t fetched = 0;
  uint32_t kept = 0;     // were there already
  uint32_t missing = 0;  // not done yet, or failed
  FrameSet lost;         // their stored pictures are gone or damaged: the farm makes them again
  double rate = 0;
};

// Every blob is checked against its digest, every picture against its pixel digest. Frames that are
// there already are kept. kCancelled when the flag is set; what came is there. Shows progress on
// stderr.
Result<FetchReport> FetchJob(FarmClient& client, const FetchOrder& order,
                             const std::atomic<bool>* cancel);

// kNotFound, and what to do, unless every frame came.
Result<> RequireAll(const FetchReport& report, const std::string& job);

}  // namespace fjord
