// From a tile's visible samples to the linear colours of its pixels: the rows of samples are shaded
// and averaged in a fixed order (W39).
//
// Not for sharing between threads.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/render/frame_setup.h"
#include "engine/render/surface_hits.h"
#include "engine/render/tile_buffer.h"

namespace fjord {

class Film {
 public:
  // rgb holds the tile's width * height * 3 floats.
  void Develop(const FrameSetup& setup, TileBuffer* tile, std::span<float> rgb);

  size_t Bytes() const;

 private:
  // What a row of pixels shows, beside objects.
  struct RowContent {
    bool background = false;
    bool sea = false;
    bool objects = false;
  };

  void StartTile(const TileBuffer& tile);
  RowContent FindOwners(TileBuffer* tile, int32_t y);
  void CollectHits(TileBuffer* tile, int32_t y, size_t first);
  void ShadeObject(const TileBuffer& tile, uint32_t object);
  void ShadeSea(TileBuffer* tile, int32_t y, const Rgb& background);
  void InterpolateCorners(const TileBuffer& tile, size_t i, uint32_t hit,
                          const Attributes& attributes);
  void ApplyTexture(uint32_t object);
  Rgb Background(int32_t y) const;

  const FrameSetup* setup_ = nullptr;  // of the tile being developed
  // Rows of samples, [x][sample] as the tile's.
  std::vector<uint32_t> owner_;
  std::vector<double> sample_x_, sample_y_;  // places; y within the row of pixels
  std::array<std::vector<float>, 3> row_;    // colours
  SurfaceHits hits_;
  std::vector<uint32_t> hit_of_;  // per entry of hits_
  SurfaceHits sea_;               // one entry a pixel
  std::vector<SurfaceSample> texture_;
};

}  // namespace fjord
