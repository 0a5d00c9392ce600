#include "engine/geometry/border.h"

#include <algorithm>
#include <array>

namespace fjord {

std::vector<Chain> BorderOf(const Mesh& mesh) {
  struct Side {
    uint32_t low, high;
    size_t corner;
    bool SameEdge(const Side& other) const { return low == other.low && high == other.high; }
  };
  std::vector<std::array<uint32_t, 2>> sides;
  size_t begin = 0;
  for (const uint32_t size : mesh.face_size) {
    for (uint32_t i = 0; i < size; ++i) {
      sides.push_back({mesh.face_vertex[begin + i], mesh.face_vertex[begin + (i + 1) % size]});
    }
    begin += size;
  }
  std::vector<Side> order;
  order.reserve(sides.size());
  for (size_t c = 0; c < sides.size(); ++c) {
    const auto [low, high] = std::minmax(sides[c][0], sides[c][1]);
    order.push_back({low, high, c});
  }
  std::sort(order.begin(), order.end(), [](const Side& a, const Side& b) {
    return std::array{size_t{a.low}, size_t{a.high}, a.corner} <
           std::array{size_t{b.low}, size_t{b.high}, b.corner};
  });
  std::vector<uint8_t> alone(sides.size(), 0);
  for (size_t k = 0; k < order.size(); ++k) {
    const bool before = k > 0 && order[k].SameEdge(order[k - 1]);
    const bool after = k + 1 < order.size() && order[k].SameEdge(order[k + 1]);
    alone[order[k].corner] = !before && !after;
  }
  std::vector<std::array<uint32_t, 2>> border;
  for (size_t c = 0; c < sides.size(); ++c) {
    if (alone[c]) border.push_back(sides[c]);
  }
  return JoinEdges(border, mesh.points.size());
}

}  // namespace fjord
