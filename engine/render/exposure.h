// One look at a frame: where it is seen from, when, and which samples of every pixel it fills. A
// frame has a single one so far. Motion blur will take several instants, depth of field several
// views, each with samples of its own; every pass reads these and nothing else about the camera.
#pragma once

#include <cstdint>

#include "engine/render/view.h"

namespace fjord {

struct Exposure {
  View view;
  double instant = 0;  // frames; 0 where no texture stage reads the time
  // Samples first_sample..end_sample - 1 of each pixel.
  uint32_t first_sample = 0;
  uint32_t end_sample = 0;
};

}  // namespace fjord
