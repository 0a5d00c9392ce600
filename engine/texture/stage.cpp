#include "engine/texture/stage.h"

namespace fjord {

void TextureChain::Append(std::unique_ptr<TextureStage> stage) {
  stages_.push_back(std::move(stage));
}

void TextureChain::ApplyGeometric(std::span<SurfaceSample> samples, double time) const {
  for (const auto& stage : stages_) {
    if (stage->kind() == StageKind::kGeometric) stage->Apply(samples, time);
  }
}

void TextureChain::ApplyColor(std::span<SurfaceSample> samples, double time) const {
  for (const auto& stage : stages_) {
    if (stage->kind() == StageKind::kColor) stage->Apply(samples, time);
  }
}

}  // namespace fjord
