#include "engine/texture/registry.h"

namespace fjord {

// One line an entry; each is the function of that name in engine/texture/stages. Append only.
#define FJORD_STAGES(ENTRY) \
  ENTRY(CheckerStage)       \
  ENTRY(NoiseStage)

#define FJORD_DECLARE(name) StageInfo name();
FJORD_STAGES(FJORD_DECLARE)

Registry<StageInfo>& StageRegistry() {
#define FJORD_MAKE(name) name(),
  static Registry<StageInfo> registry({FJORD_STAGES(FJORD_MAKE)});
  return registry;
}

std::span<const StageInfo> TextureStages() { return StageRegistry().entries(); }

const StageInfo* FindTextureStage(std::string_view name) { return StageRegistry().Find(name); }

void AppendStage(const StageInfo& info, const std::any& own, TextureChain* chain) {
  chain->Append(info.kind, info.reads == nullptr ? StageReads{} : info.reads(own), info.make(own));
}

}  // namespace fjord
