// What a texture stage is: one block of an object's ordered texture chain (W32, W33). Each stage is
// a pure function of the surface sample, its own data and the time; it changes the normal
// (geometric stages, before light) or the colour (colour stages), never anything else. Stages have
// no state, so a sample may be shaded by any thread, tile or machine with the same bits.
//
// A stage's entry is one file in engine/texture/stages and one line in registry.cpp. The list is
// empty so far: an empty chain leaves every sample as it came.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/geometry/vec.h"

namespace fjord {

// One sample of a surface, object space unless said. What a stage may read and what it may change.
struct SurfaceSample {
  Vec3 position{0};
  Vec3 normal{0};   // unit
  Vec3 tangent{0};  // along u; 0 where the surface has no (u,v)
  double u = 0;
  double v = 0;
  Rgb color{1};
  float opacity = 1;
};

enum class StageKind : uint8_t { kGeometric, kColor };

class TextureStage {
 public:
  virtual ~TextureStage() = default;
  virtual StageKind kind() const = 0;
  // In place, all samples of a run; time in frames.
  virtual void Apply(std::span<SurfaceSample> samples, double time) const = 0;
};

// Stages in order. Geometric ones run before light, colour ones with it; the order within each kind
// is kept.
class TextureChain {
 public:
  void Append(std::unique_ptr<TextureStage> stage);
  bool empty() const { return stages_.empty(); }
  void ApplyGeometric(std::span<SurfaceSample> samples, double time) const;
  void ApplyColor(std::span<SurfaceSample> samples, double time) const;

 private:
  std::vector<std::unique_ptr<TextureStage>> stages_;
};

}  // namespace fjord
