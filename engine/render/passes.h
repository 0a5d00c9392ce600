// What a run of hits of one owner goes through from "this is seen" to "this colour": surface (its
// own colour and normal, then its texture chain), light, medium (haze). Film collects the hits
// before and averages the colours after.
//
// A pass is a pure function of the hits, the setup and the exposure: which hits share a run, and
// their order in it, change no bit.
//
// Holds scratch memory only. Not for sharing between threads.
#pragma once

#include <vector>

#include "engine/render/exposure.h"
#include "engine/render/frame_setup.h"
#include "engine/render/surface_hits.h"
#include "engine/render/tile_buffer.h"

namespace fjord {

struct PassInput {
  const FrameSetup& setup;
  const Exposure& exposure;
  const TileBuffer* drawn = nullptr;  // where the records of objects are; null: no object is seen
  uint32_t owner = 0;
  int32_t row = 0;  // of the picture
};

class Passes {
 public:
  // Fills hits->color. Place, x, y and depth are given; of objects, record too.
  void Run(const PassInput& input, SurfaceHits* hits);

  size_t Bytes() const {
    return texture_.capacity() * sizeof(SurfaceSample) + places_.capacity() * sizeof(HitPlace);
  }

 private:
  void RunSurface(const PassInput& input, SurfaceHits* hits);
  void RunTexture(const PassInput& input, SurfaceHits* hits);
  void RunLight(const PassInput& input, SurfaceHits* hits) const;
  void RunMedium(const PassInput& input, SurfaceHits* hits) const;

  std::vector<HitPlace> places_;
  std::vector<SurfaceSample> texture_;
};

}  // namespace fjord
