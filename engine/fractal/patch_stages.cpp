// Which edges are halved next under ADAPTIVE: of all that are long and wait, the earliest stage's.
#include <algorithm>

#include "engine/fractal/patch.h"

namespace fjord {
namespace {

// Vectors of this many entries may be read beyond a list.
constexpr size_t kWidest = 16;

}  // namespace

void CollectStage(const SurfaceRules& rules, Patch& patch) {
  const Stages& stages = rules.stages;
  uint32_t* waiting = patch.waiting.data();
  size_t count = patch.waiting_count;
  for (size_t i = patch.run_begin; i < patch.edge_count; ++i) {
    const bool is_short = PatchIsShort(patch.edge_length2[i]);
    patch.edge_slot[i] = is_short ? Patch::kShort : Patch::kWaits;
    waiting[count] = static_cast<uint32_t>(i);
    count += is_short ? 0 : 1;
  }
  uint32_t stage = ~0u;
  for (size_t i = 0; i < count; ++i) {
    stage = std::min(stage, stages.StageOf(patch.edge_length2[waiting[i]]));
  }
  uint32_t n = 0;
  size_t left = 0;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t edge = waiting[i];
    const double length2 = patch.edge_length2[edge];
    if (stages.StageOf(length2) != stage) {
      waiting[left++] = edge;
      continue;
    }
    patch.edge_slot[edge] = n;
    patch.long_edge[n] = edge;
    patch.long_a[n] = patch.edge_a[edge];
    patch.long_b[n] = patch.edge_b[edge];
    patch.long_length2[n] = length2;
    ++n;
  }
  for (size_t i = n; i < n + kWidest; ++i) {
    patch.long_a[i] = patch.long_b[i] = patch.long_edge[i] = 0;
    patch.long_length2[i] = 1;
  }
  patch.waiting_count = left;
  patch.long_count = n;
  patch.level = stage - 1;
}

}  // namespace fjord
