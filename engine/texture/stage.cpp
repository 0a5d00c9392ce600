#include "engine/texture/stage.h"

namespace fjord {

std::span<const StageInfo> TextureStages() { return {}; }

const StageInfo* FindTextureStage(std::string_view name) {
  for (const StageInfo& stage : TextureStages()) {
    if (stage.name == name) return &stage;
  }
  return nullptr;
}

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
