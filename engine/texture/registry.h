// The list of texture stages (engine/knobs/registry.h).
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "engine/knobs/registry.h"
#include "engine/texture/stage.h"

namespace fjord {

struct StageInfo : EntryInfo {
  StageKind kind = StageKind::kColor;
  // `own`: the stage's struct, within its table's ranges and rules. Null: reads nothing beside
  // position, normal and colour.
  StageReads (*reads)(const std::any& own) = nullptr;
  std::unique_ptr<TextureStage> (*make)(const std::any& own) = nullptr;
};

Registry<StageInfo>& StageRegistry();

std::span<const StageInfo> TextureStages();
// Null where there is no such stage.
const StageInfo* FindTextureStage(std::string_view name);

// Makes the stage and adds it to the chain.
void AppendStage(const StageInfo& info, const std::any& own, TextureChain* chain);

}  // namespace fjord
