// What an object's coarse vertices have and its fine surface shows: normals (of smooth shapes
// without a fractal), colours, and what textures read (rest position, (u,v), tangent). It is not
// carried along while the surface is made fine: a sample that is seen knows its place in its coarse
// element, and all else follows from there. So textures do not swim: a place keeps its rest
// position wherever the frame moves it.
//
// Immutable; free to share between threads.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/render/built_frame.h"
#include "engine/render/surface_hits.h"
#include "engine/render/tile_buffer.h"

namespace fjord {

// Where a hit lies in its coarse element.
struct HitPlace {
  Weights weight{0};
  uint32_t element = kNoHit;  // kNoHit: nowhere (the inside of a filled curve)
};

// Of hit i, from the record of its triangle: perspective-correct.
HitPlace FindPlace(const TileBuffer& tile, const SurfaceHits& hits, size_t i);

class CoarseAttributes {
 public:
  explicit CoarseAttributes(const BuiltObject& object);

  // Is there anything that shading reads?
  bool any() const { return colors_ || !normals_.empty() || rest_ || uv_; }

  // One place a hit; sets normals and colours.
  void Apply(std::span<const HitPlace> places, SurfaceHits* hits) const;
  // Sets what textures read.
  void Apply(std::span<const HitPlace> places, std::span<SurfaceSample> samples) const;

 private:
  std::shared_ptr<const PreparedFractal> prepared_;
  std::shared_ptr<const CoarseShape> shape_;
  std::vector<Vec3> normals_;  // none, or one a coarse vertex
  bool colors_ = false, rest_ = false, uv_ = false;
  UvMap map_;
};

}  // namespace fjord
