// Heights over a rectangle: samples by index, and how low and high they get anywhere, so that what
// lies outside a picture is never looked at.
//
// Ownership: sources are immutable and shared. Threads: any number may read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/geometry/mesh.h"
#include "engine/geometry/vec.h"

namespace fjord {

class HeightSource {
 public:
  virtual ~HeightSource() = default;
  // Samples along x and along y, two or more each; row 0 has the least y.
  virtual uint32_t columns() const = 0;
  virtual uint32_t rows() const = 0;
  virtual float At(uint32_t i, uint32_t j) const = 0;

  struct Range {
    float low = 0;
    float high = 0;
  };
  // Holds all samples i0..i1, j0..j1 (ends included), and little else.
  virtual Range RangeOf(uint32_t i0, uint32_t j0, uint32_t i1, uint32_t j1) const = 0;
  virtual size_t Bytes() const = 0;
};

// All samples 0, none stored.
std::shared_ptr<const HeightSource> FlatHeights(uint32_t columns, uint32_t rows);
// Finite samples, row after row; columns * rows of them.
std::shared_ptr<const HeightSource> SampledHeights(uint32_t columns, uint32_t rows,
                                                   std::vector<float> samples);

// Where the samples of a source stand: centred on the origin, size.x by size.y wide, a sample times
// size.z high.
struct HeightField {
  std::shared_ptr<const HeightSource> source;
  Vec3 size{1};

  // i and j may lie beyond the last sample; height: of a sample.
  Vec3 Place(uint32_t i, uint32_t j, float height) const {
    const double columns = source->columns() - 1, rows = source->rows() - 1;
    return {size.x * (i / columns - .5), size.y * (j / rows - .5), size.z * double{height}};
  }
  Vec3 At(uint32_t i, uint32_t j) const { return Place(i, j, source->At(i, j)); }
};

// As triangles, the diagonals alternating.
Mesh MeshOf(const HeightField& field);

}  // namespace fjord
