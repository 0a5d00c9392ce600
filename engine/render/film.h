// From a tile's visible samples to the linear colours of its pixels: samples are shaded row by row
// and averaged in a fixed order (W39). Pixels where nothing was drawn and that are all sea or all
// background take one colour for all their samples: the same bits, for less.
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
  // rgb holds the tile's width * height * 3 floats. `drawn` holds rows of the tile, in its full
  // width; nothing was drawn in the others.
  void Develop(const FrameSetup& setup, const TileRect& tile, const TileBuffer& drawn,
               std::span<float> rgb);

  size_t Bytes() const;

 private:
  // Pixels first..end - 1 of a row.
  struct Span {
    int32_t first, end;
  };
  enum class Behind { kBackground, kSea, kBoth };

  void StartTile(const TileRect& tile);
  void DevelopRow(int32_t y, const TileBuffer* drawn, float* out);
  Behind BehindRow(int32_t y) const;
  Span DrawnPixels(const TileBuffer& drawn, int32_t y) const;
  void FillPlain(int32_t y, Span pixels, Behind behind, float* out);
  void FillSamples(int32_t y, Span pixels, const TileBuffer* drawn, float* out);
  void FindOwners(int32_t y, Span pixels, const TileBuffer* drawn);
  void CollectHits(const TileBuffer& drawn, int32_t y, Span samples, int32_t first);
  void ShadeObject(const TileBuffer& tile, uint32_t object);
  void ShadeSea();
  double SeaDepth(int32_t x, int32_t y, const SamplePlace& place) const;
  void AddSeaPixel(int32_t x, int32_t y, double depth);
  void InterpolateCorners(const TileBuffer& tile, size_t i, uint32_t hit,
                          const Attributes& attributes);
  void ApplyTexture(uint32_t object);
  Rgb Background(int32_t y) const;

  const FrameSetup* setup_ = nullptr;  // of the tile being developed
  TileRect tile_;
  std::span<const SamplePlace> places_;
  Rgb background_{0};  // of the row
  // Rows of samples, [x][sample] as the tile buffer's.
  std::vector<uint32_t> owner_;
  std::array<std::vector<float>, 3> row_;  // colours
  SurfaceHits hits_;
  std::vector<uint32_t> hit_of_;  // per entry of hits_
  SurfaceHits sea_;               // one entry a pixel; place: the pixel's column in the tile
  std::vector<SurfaceSample> texture_;
};

}  // namespace fjord
