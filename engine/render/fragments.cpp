#include "engine/render/fragments.h"

#include <algorithm>

namespace fjord {

void SortFragments(std::vector<Fragment>* fragments) {
  std::sort(fragments->begin(), fragments->end(), [](const Fragment& a, const Fragment& b) {
    if (a.sample != b.sample) return a.sample < b.sample;
    if (a.depth != b.depth) return a.depth < b.depth;  // larger depths are nearer
    return a.owner > b.owner;
  });
}

std::span<const Fragment> FragmentsOf(std::span<const Fragment> sorted, uint32_t first,
                                      uint32_t end) {
  const auto before = [](const Fragment& fragment, uint32_t sample) {
    return fragment.sample < sample;
  };
  const auto from = std::lower_bound(sorted.begin(), sorted.end(), first, before);
  const auto to = std::lower_bound(from, sorted.end(), end, before);
  return {from, to};
}

}  // namespace fjord
