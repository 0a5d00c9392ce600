// The frames of a folder in order: those of its manifest, or, without one, its pictures by their
// numbers (picture_sequence.h). What is missing among them, or does not belong to them, is an error
// that names it, unless the caller does without.
#pragma once

#include <string>
#include <vector>

#include "engine/base/frame_set.h"
#include "engine/base/result.h"
#include "engine/image/picture.h"

namespace fjord {

struct ListedFrame {
  std::string file;
  std::string pixel_digest;  // of the manifest; empty: whatever the file holds
};

struct FrameList {
  std::vector<ListedFrame> frames;
  double rate = 0;  // of the manifest; 0: unknown
};

// What people ask for.
struct FrameChoice {
  FrameSet frames;  // none: all
  bool allow_missing = false;
  bool allow_mixed = false;  // frames of several sequences or scenes, of several sizes
};

// `leave_out`: a file that is about to be written there. kInvalid where the folder has no frames,
// or not those that were chosen.
Result<FrameList> FramesOf(const std::string& folder, const FrameChoice& choice,
                           const std::string& leave_out = {});

// kInvalid where the file is not the picture that the manifest names.
Result<Picture> ReadFrame(const ListedFrame& frame);

// "frame 4 of 12 is missing", "frames 4,7-9 of 12 are missing"; total 0: unknown.
std::string MissingText(const FrameSet& missing, uint32_t total);

}  // namespace fjord
