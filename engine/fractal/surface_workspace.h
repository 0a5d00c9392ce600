// A thread's tables for streaming surfaces, kept between calls. A sink may stream another object
// meanwhile, so there can be more than one.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "engine/fractal/patch.h"
#include "engine/fractal/surface_weld.h"

namespace fjord {

struct SurfaceWorkspace {
  Patch patch;
  std::vector<PatchRoot> stack;
};

class SurfaceWorkspaceLease {
 public:
  SurfaceWorkspaceLease() {
    std::vector<std::unique_ptr<SurfaceWorkspace>>& pool = Pool();
    if (!pool.empty()) {
      space_ = std::move(pool.back());
      pool.pop_back();
    } else {
      space_ = std::make_unique<SurfaceWorkspace>();
    }
    space_->stack.clear();
  }
  ~SurfaceWorkspaceLease() { Pool().push_back(std::move(space_)); }
  SurfaceWorkspaceLease(const SurfaceWorkspaceLease&) = delete;
  SurfaceWorkspaceLease& operator=(const SurfaceWorkspaceLease&) = delete;
  SurfaceWorkspace& operator*() const { return *space_; }

 private:
  static std::vector<std::unique_ptr<SurfaceWorkspace>>& Pool() {
    thread_local std::vector<std::unique_ptr<SurfaceWorkspace>> pool;
    return pool;
  }
  std::unique_ptr<SurfaceWorkspace> space_;
};

}  // namespace fjord
