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
  uint32_t* waiting = patch.edges.waiting.data();
  size_t count = patch.edges.waiting_count;
  for (size_t i = patch.edges.run_begin; i < patch.edges.count; ++i) {
    const bool is_short = PatchIsShort(patch.edges.length2[i]);
    patch.edges.slot[i] = is_short ? PatchEdges::kShort : PatchEdges::kWaits;
    waiting[count] = static_cast<uint32_t>(i);
    count += is_short ? 0 : 1;
  }
  uint32_t stage = ~0u;
  for (size_t i = 0; i < count; ++i) {
    stage = std::min(stage, stages.StageOf(patch.edges.length2[waiting[i]]));
  }
  uint32_t n = 0;
  size_t left = 0;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t edge = waiting[i];
    const double length2 = patch.edges.length2[edge];
    if (stages.StageOf(length2) != stage) {
      waiting[left++] = edge;
      continue;
    }
    patch.edges.slot[edge] = n;
    patch.long_edges.number[n] = edge;
    patch.long_edges.a[n] = patch.edges.a[edge];
    patch.long_edges.b[n] = patch.edges.b[edge];
    patch.long_edges.length2[n] = length2;
    ++n;
  }
  for (size_t i = n; i < n + kWidest; ++i) {
    patch.long_edges.a[i] = patch.long_edges.b[i] = patch.long_edges.number[i] = 0;
    patch.long_edges.length2[i] = 1;
  }
  patch.edges.waiting_count = left;
  patch.long_edges.count = n;
  patch.level = stage - 1;
}

}  // namespace fjord
