// What a texture stage is: one block of an object's ordered texture chain (W32, W33). Each stage is
// a pure function of the surface sample, its own settings and, where it says that it reads it, the
// time. It changes the normal (geometric stages, before light) or the colour (colour stages), never
// anything else. Stages have no state, so a sample may be shaded by any thread, tile or machine
// with the same bits.
//
// A stage's entry is one file in engine/texture/stages and one line in registry.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/geometry/vec.h"

namespace fjord {

// One sample of a surface, object space. What a stage may read and what it may change.
struct SurfaceSample {
  Vec3 position{0};  // now
  Vec3 rest{0};      // in the rest pose: a texture that reads it stays on a surface that moves
  Vec3 normal{0};    // unit
  Vec3 tangent{0};   // unit, now, along u; 0 where the surface has no (u,v)
  double u = 0;      // 0..1 over the whole surface
  double v = 0;
  Rgb color{1};
};

enum class StageKind : uint8_t { kGeometric, kColor };

// What a stage reads beside position, normal and colour: what is not read is not worked out.
struct StageReads {
  bool rest = false;
  bool uv = false;  // u, v and tangent
  bool time = false;
};

class TextureStage {
 public:
  virtual ~TextureStage() = default;
  // In place, all samples of a run; time in frames.
  virtual void Apply(std::span<SurfaceSample> samples, double time) const = 0;
};

// Stages in order. Geometric ones run before light, colour ones with it; the order within each kind
// is kept.
class TextureChain {
 public:
  // `reads`: what StageInfo::reads says of the stage.
  void Append(StageKind kind, const StageReads& reads, std::unique_ptr<TextureStage> stage);
  bool empty() const { return geometric_.empty() && color_.empty(); }
  // What any of its stages reads.
  const StageReads& reads() const { return reads_; }
  void ApplyGeometric(std::span<SurfaceSample> samples, double time) const;
  void ApplyColor(std::span<SurfaceSample> samples, double time) const;

 private:
  std::vector<std::unique_ptr<TextureStage>> geometric_, color_;
  StageReads reads_;
};

}  // namespace fjord
