// The seam between visibility and shading: a run of visible samples of one object. Visibility fills
// it, textures change it, light turns it into colour.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/geometry/vec.h"

namespace fjord {

// Structure of arrays; every array has room for size rounded up to 64 entries. After Resize the
// padding holds zeros or old values, never garbage that could trap.
struct SurfaceHits {
  size_t size = 0;
  std::vector<uint32_t> place;                  // the sample, pixel or row it stands for (Grain)
  std::vector<uint32_t> record;                 // the triangle's record in the tile buffer
  std::vector<double> x, y, depth;              // picture coordinates (1/256 pixel) and depth
  std::array<std::vector<float>, 3> normal;     // object space, any length
  std::array<std::vector<float>, 3> to_eye;     // world, any length
  std::array<std::vector<double>, 3> position;  // world; filled where asked for
  std::vector<float> height;                    // object z above the ramp's first stop
  std::vector<std::vector<float>> arrives;      // share of each light that throws shadows, 0..1
  std::array<std::vector<float>, 3> color;      // before light; then what is seen

  void Resize(size_t count);
};

}  // namespace fjord
