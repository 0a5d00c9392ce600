#include "server/state/order.h"

#include <deque>
#include <utility>

namespace fjord::server {

std::vector<uint32_t> CoarseToFine(uint32_t count) {
  std::vector<uint32_t> order;
  order.reserve(count);
  if (count > 0) order.push_back(0);
  if (count > 1) order.push_back(count - 1);
  std::deque<std::pair<uint32_t, uint32_t>> gaps;  // ends done, inside not
  if (count > 2) gaps.emplace_back(0, count - 1);
  while (!gaps.empty()) {
    const auto [low, high] = gaps.front();
    gaps.pop_front();
    const uint32_t middle = low + (high - low) / 2;
    order.push_back(middle);
    if (middle - low > 1) gaps.emplace_back(low, middle);
    if (high - middle > 1) gaps.emplace_back(middle, high);
  }
  return order;
}

}  // namespace fjord::server
