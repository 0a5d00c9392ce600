// From a tile's visible samples to the linear colours of its pixels: the rows of samples are shaded
// and averaged in a fixed order (W39).
//
// Not for sharing between threads.
#pragma once

#include <span>
#include <vector>

#include "engine/render/frame_setup.h"
#include "engine/render/surface_hits.h"
#include "engine/render/tile_buffer.h"

namespace fjord {

class Film {
 public:
  // setup must outlive the film.
  explicit Film(const FrameSetup& setup) : setup_(setup) {}

  // rgb holds the tile's width * height * 3 floats.
  void Develop(TileBuffer* tile, std::span<float> rgb);

  size_t Bytes() const;

 private:
  void FindOwners(TileBuffer* tile, int32_t y);
  void ShadeObject(const TileBuffer& tile, uint32_t object);
  void ShadeSea(const Rgb& background);
  void CollectHits(TileBuffer* tile, int32_t y, uint32_t owner);
  void InterpolateCorners(const TileBuffer& tile, size_t i, uint32_t hit,
                          const Attributes& attributes);
  void ApplyTexture(uint32_t object);
  Rgb Background(int32_t y) const;

  const FrameSetup& setup_;
  SurfaceHits hits_;
  std::vector<uint32_t> owner_;   // per sample of a row of pixels
  std::vector<uint32_t> hit_of_;  // per entry of hits_
  std::vector<float> row_;        // 3 floats a sample
  std::vector<SurfaceSample> texture_;
};

}  // namespace fjord
