// What renders one unit: the engine in this process, a child process for suspects, or a test's.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "engine/base/result.h"
#include "worker/blobs.h"

namespace fjord::worker {

struct UnitOrder {
  std::string scene;  // digests in hex
  uint32_t frame = 0;
  std::string frame_key;
};

struct RenderedUnit {
  std::string pixel_digest;
  std::string picture;      // encoded
  std::string blob_digest;  // of `picture`
  uint64_t triangles = 0;
  uint32_t render_ms = 0;
};

// Called by one thread at a time.
class UnitRenderer {
 public:
  virtual ~UnitRenderer() = default;
  // Makes the inbetween again and must reach the same key before it renders. `progress` grows while
  // work goes on; `cancel` ends it with kCancelled. kUnavailable: scene or assets cannot be had
  // now.
  virtual Result<RenderedUnit> Render(const UnitOrder& order, std::atomic<uint64_t>& progress,
                                      const std::atomic<bool>& cancel) = 0;
};

// threads: as RenderOptions.
std::unique_ptr<UnitRenderer> MakeEngineRenderer(Blobs& blobs, int threads);

// Runs `program --server ADDRESS --threads N --render-unit ...`, so that a crash is the frame's and
// not the worker's. An error of code kInternal means that the child died.
std::unique_ptr<UnitRenderer> MakeChildRenderer(std::string program, std::string server,
                                                int threads);

// The child's side: renders with `renderer`, writes the answer to standard output. Returns the exit
// code.
int RenderForParent(UnitRenderer& renderer, const UnitOrder& order);

}  // namespace fjord::worker
