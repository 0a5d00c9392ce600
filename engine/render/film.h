// From a tile's visible samples to the linear colours of its pixels, row by row: who owns each
// sample, runs of hits owner by owner, the passes (passes.h), what is translucent over that
// (fragments.h), and the average of a pixel's samples in a fixed order (W39). With alpha a fourth
// channel says how much of a pixel is covered: 0 of a sample that sees the sky, which has no colour
// then, 1 of any other.
//
// Invariants
// F1 Every sample of a pixel has one opaque owner: an object, the sea or the sky.
// F2 Where one hit stands for many samples (Grain), the samples get its colour; their sum and share
//    are what each alone would have given.
//
// Use: Start, AddFragments for each translucent object, Develop.
//
// Not for sharing between threads.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/render/fragments.h"
#include "engine/render/frame_setup.h"
#include "engine/render/passes.h"
#include "engine/render/surface_hits.h"
#include "engine/render/tile_buffer.h"

namespace fjord {

class Film {
 public:
  // `setup` must outlive the tile.
  void Start(const FrameSetup& setup, const TileRect& tile);

  // All hits of `drawn`, which are of one translucent owner. Buffers hold rows of the tile, in its
  // full width.
  void AddFragments(uint32_t owner, const TileBuffer& drawn);

  // `pixels` holds the tile's width * height * setup.channels() floats. Nothing opaque was drawn in
  // rows that `drawn` does not hold.
  void Develop(const TileBuffer& drawn, std::span<float> pixels);

  // Sorted by Develop.
  std::span<const Fragment> fragments() const { return fragments_; }

  size_t Bytes() const;

 private:
  // Pixels first..end - 1 of a row.
  struct Span {
    int32_t first, end;
  };

  void DevelopRow(int32_t y, const TileBuffer* drawn, float* out);
  std::optional<uint32_t> BehindRow(int32_t y) const;
  Span DrawnPixels(const TileBuffer& drawn, int32_t y) const;
  std::span<const Fragment> FragmentsOfRow(int32_t y) const;
  void FillPlain(int32_t y, Span pixels, uint32_t owner, float* out);
  void FillSamples(int32_t y, Span pixels, const TileBuffer* drawn, float* out);
  void LayFragments(int32_t y);
  void FindOwners(int32_t y, Span pixels, const TileBuffer* drawn);
  void Collect(int32_t y, Span pixels, uint32_t owner, const TileBuffer* drawn);
  void CollectSamples(int32_t y, Span pixels, uint32_t owner, const TileBuffer& drawn);
  void AddSample(const TileBuffer& drawn, int32_t y, size_t at);
  void AddPixel(int32_t x, int32_t y, uint32_t owner, size_t sample);
  void Scatter(Span pixels, uint32_t owner);
  double SeaDepth(int32_t x, int32_t y, const SamplePlace& place) const;

  const FrameSetup* setup_ = nullptr;  // of the tile being developed
  TileRect tile_;
  std::span<const SamplePlace> places_;
  // Rows of samples, [x][sample] as the tile buffer's.
  std::vector<uint32_t> owner_;
  std::array<std::vector<float>, 4> row_;  // colours, and alpha where it is asked for
  std::vector<uint32_t> present_;          // owners of the row's samples, each once
  std::vector<uint8_t> is_present_;        // by owner
  std::vector<Fragment> fragments_;
  SurfaceHits hits_;
  Passes passes_;
};

}  // namespace fjord
