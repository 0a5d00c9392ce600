// Triangles by how many long edges they have (S21), N in lock-step: sorted first, so that no lane
// waits for another case.
#include "engine/fractal/patch.h"

// The order matters.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/fractal/patch_triangles.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep

#include "hwy/highway.h"
#include "engine/fractal/patch_expand-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace fjord {
namespace HWY_NAMESPACE {

void SplitTrianglesLanes(const SurfaceRules& rules, Patch& patch) {
  CaseList lists[5];
  Expander expander(rules, patch);
  for (size_t begin = 0; begin < patch.triangles.count; begin += kBlock) {
    const size_t left = patch.triangles.count - begin;
    SortBlock(rules, patch, begin, begin + (left < kBlock ? left : kBlock), lists);
    expander.One(lists[0]);
    expander.Two(lists[1]);
    expander.Three(lists[2]);
    if (rules.staged()) expander.Keep(lists[kWaiting]);
  }
  expander.Finish();
}

}  // namespace HWY_NAMESPACE
}  // namespace fjord
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fjord {

HWY_EXPORT(SplitTrianglesLanes);

void SplitTriangles(const SurfaceRules& rules, Patch& patch) {
  HWY_DYNAMIC_DISPATCH(SplitTrianglesLanes)(rules, patch);
}

}  // namespace fjord
#endif
