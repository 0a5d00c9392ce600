// From a tile's visible samples to the linear colours of its pixels, row by row: who owns each
// sample, runs of hits owner by owner, the passes (passes.h), and the average of a pixel's samples
// in a fixed order (W39).
//
// Invariants
// F1 Every sample of a pixel has one owner: an object, the sea or the sky.
// F2 Where one hit stands for many samples (Grain), the samples get its colour; their sum and share
//    are what each alone would have given.
//
// Not for sharing between threads.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/render/exposure.h"
#include "engine/render/frame_setup.h"
#include "engine/render/passes.h"
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

  void StartTile(const FrameSetup& setup, const TileRect& tile);
  void DevelopRow(int32_t y, const TileBuffer* drawn, float* out);
  std::optional<uint32_t> BehindRow(int32_t y) const;
  Span DrawnPixels(const TileBuffer& drawn, int32_t y) const;
  void FillPlain(int32_t y, Span pixels, uint32_t owner, float* out);
  void FillSamples(int32_t y, Span pixels, const TileBuffer* drawn, float* out);
  void FindOwners(int32_t y, Span pixels, const TileBuffer* drawn);
  void Collect(int32_t y, Span pixels, uint32_t owner, const TileBuffer* drawn);
  void CollectSamples(int32_t y, Span pixels, uint32_t owner, const TileBuffer& drawn);
  void AddPixel(int32_t x, int32_t y, uint32_t owner, size_t sample);
  void Scatter(Span pixels, uint32_t owner);
  double SeaDepth(int32_t x, int32_t y, const SamplePlace& place) const;

  const FrameSetup* setup_ = nullptr;  // of the tile being developed
  TileRect tile_;
  std::span<const SamplePlace> places_;
  // Rows of samples, [x][sample] as the tile buffer's.
  std::vector<uint32_t> owner_;
  std::array<std::vector<float>, 3> row_;  // colours
  std::vector<uint32_t> present_;          // owners of the row's samples, each once
  std::vector<uint8_t> is_present_;        // by owner
  SurfaceHits hits_;
  Passes passes_;
};

}  // namespace fjord
