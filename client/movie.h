// A movie from frames, by the ffmpeg program: the frames are decoded here and go to it as plain
// samples through a pipe, so that every format works and no file name is ever read as something
// else.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "client/frame_list.h"
#include "engine/base/result.h"

namespace fjord {

struct MovieReport {
  bool over_black = false;  // the frames are transparent, which a movie can not be
};

// H.264, yuv420p, crf 16. `output` appears when it is complete. kCancelled when the flag is set.
Result<MovieReport> MakeMovie(const std::vector<ListedFrame>& frames, double rate,
                              const std::string& output, const std::atomic<bool>* cancel);

}  // namespace fjord
