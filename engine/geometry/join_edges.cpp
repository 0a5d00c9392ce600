#include "engine/geometry/join_edges.h"

#include <algorithm>

namespace fjord {
namespace {

constexpr uint32_t kNone = UINT32_MAX;
using Edge = std::array<uint32_t, 2>;

class Joiner {
 public:
  Joiner(std::span<const Edge> edges, size_t vertices) : edges_(edges), taken_(edges.size(), 0) {
    DropRepeated();
    meet_.resize(vertices);
    for (uint32_t e = 0; e < edges_.size(); ++e) {
      if (taken_[e]) continue;
      for (const uint32_t vertex : edges_[e]) {
        Meeting& meeting = meet_[vertex];
        if (meeting.count < 2) meeting.edge[meeting.count] = e;
        meeting.count = std::min(meeting.count + 1, 3u);
      }
    }
  }

  std::vector<Chain> Join() {
    std::vector<Chain> chains;
    for (uint32_t e = 0; e < edges_.size(); ++e) {
      if (!taken_[e]) chains.push_back(ChainFrom(e));
    }
    return chains;
  }

 private:
  struct Meeting {
    uint32_t count = 0;  // of edges that end here; 3 stands for more
    std::array<uint32_t, 2> edge = {kNone, kNone};
  };

  // Marks what has been given before as taken.
  void DropRepeated() {
    std::vector<uint32_t> order(edges_.size());
    for (uint32_t e = 0; e < order.size(); ++e) order[e] = e;
    const auto key = [this](uint32_t e) {
      const auto [low, high] = std::minmax(edges_[e][0], edges_[e][1]);
      return std::array{low, high, e};
    };
    std::sort(order.begin(), order.end(),
              [&key](uint32_t a, uint32_t b) { return key(a) < key(b); });
    for (size_t k = 1; k < order.size(); ++k) {
      const auto before = key(order[k - 1]), now = key(order[k]);
      taken_[order[k]] = before[0] == now[0] && before[1] == now[1];
    }
  }

  // The edge that goes on from `edge` at `vertex`.
  uint32_t NextAt(uint32_t vertex, uint32_t edge, bool forwards) const {
    const uint32_t beside = edge + 1;
    if (forwards && beside < edges_.size() && !taken_[beside] && edges_[beside][0] == vertex) {
      return beside;
    }
    const Meeting& meeting = meet_[vertex];
    if (meeting.count != 2) return kNone;
    const uint32_t other = meeting.edge[meeting.edge[0] == edge ? 1 : 0];
    return taken_[other] ? kNone : other;
  }

  // Takes edges from `first` on, whose end `vertex` is; returns the vertices after that end.
  std::vector<uint32_t> Walk(uint32_t first, uint32_t vertex, bool forwards) {
    std::vector<uint32_t> walked;
    for (uint32_t edge = first; (edge = NextAt(vertex, edge, forwards)) != kNone;) {
      taken_[edge] = 1;
      vertex = edges_[edge][edges_[edge][0] == vertex ? 1 : 0];
      walked.push_back(vertex);
      if (vertex == edges_[first][0]) break;  // home
    }
    return walked;
  }

  Chain ChainFrom(uint32_t first) {
    taken_[first] = 1;
    const auto [from, to] = edges_[first];
    const std::vector<uint32_t> after = Walk(first, to, true);
    Chain chain;
    chain.first = first;
    chain.closed = !after.empty() && after.back() == from;
    if (!chain.closed) {
      chain.vertices = Walk(first, from, false);
      std::reverse(chain.vertices.begin(), chain.vertices.end());
    }
    chain.vertices.push_back(from);
    chain.vertices.push_back(to);
    chain.vertices.insert(chain.vertices.end(), after.begin(), after.end());
    if (chain.closed) chain.vertices.pop_back();
    return chain;
  }

  const std::span<const Edge> edges_;
  std::vector<uint8_t> taken_;
  std::vector<Meeting> meet_;
};

}  // namespace

std::vector<Chain> JoinEdges(std::span<const Edge> edges, size_t vertices) {
  return Joiner(edges, vertices).Join();
}

}  // namespace fjord
