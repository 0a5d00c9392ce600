// The frames of a folder in order: those of its manifest, or, without one, its pictures in name
// order.
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"

namespace fjord {

struct FrameList {
  std::vector<std::string> files;
  double rate = 0;  // of the manifest; 0: unknown
};

// `leave_out`: a file that is about to be written there. kInvalid where the folder has no frames.
Result<FrameList> FramesOf(const std::string& folder, const std::string& leave_out = {});

}  // namespace fjord
