#include "engine/texture/stage.h"

#include <utility>

namespace fjord {

void TextureChain::Append(StageKind kind, const StageReads& reads,
                          std::unique_ptr<TextureStage> stage) {
  reads_.rest |= reads.rest;
  reads_.uv |= reads.uv;
  reads_.time |= reads.time;
  (kind == StageKind::kGeometric ? geometric_ : color_).push_back(std::move(stage));
}

void TextureChain::ApplyGeometric(std::span<SurfaceSample> samples, double time) const {
  for (const auto& stage : geometric_) stage->Apply(samples, time);
}

void TextureChain::ApplyColor(std::span<SurfaceSample> samples, double time) const {
  for (const auto& stage : color_) stage->Apply(samples, time);
}

}  // namespace fjord
