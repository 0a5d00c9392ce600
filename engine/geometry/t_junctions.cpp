#include "engine/geometry/t_junctions.h"

#include <algorithm>
#include <cstddef>

namespace fjord {
namespace {

constexpr size_t kLeafSize = 8;

double Square(double x) { return x * x; }

// Squared distance from p to the segment a-b, and how far along it the nearest point is (0..1).
double DistanceSquared(const Vec3& p, const Vec3& a, const Vec3& b, double* along) {
  const Vec3 d = b - a;
  const double dd = glm::dot(d, d);
  const double t = dd > 0 ? glm::dot(p - a, d) / dd : 0;
  *along = t < 0 ? 0 : t > 1 ? 1 : t;
  const Vec3 off = p - (a + d * *along);
  return glm::dot(off, off);
}

// An implicit balanced tree: the middle element of a range splits it along the range's widest axis.
class VertexTree {
 public:
  VertexTree(std::span<const Vec3> points, std::span<const uint32_t> vertices)
      : points_(points), order_(vertices.begin(), vertices.end()) {
    balls_.resize(order_.empty() ? 0 : 4 * (order_.size() / kLeafSize + 1));
    if (!order_.empty()) Build(0, 0, order_.size());
  }

  // Calls visit(vertex) for every vertex of the nodes that come within `tolerance` of the segment.
  template <typename Visit>
  void Near(const Vec3& a, const Vec3& b, double tolerance, const Visit& visit) const {
    if (!order_.empty()) Near(0, 0, order_.size(), a, b, tolerance, visit);
  }

 private:
  struct Ball {
    Vec3 center{0};
    double radius = 0;
  };

  void Build(size_t node, size_t begin, size_t end) {
    Vec3 low = points_[order_[begin]], high = low;
    for (size_t i = begin; i < end; ++i) {
      const Vec3& p = points_[order_[i]];
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    }
    if (node >= balls_.size()) balls_.resize(2 * node + 2);
    const Vec3 half = (high - low) * .5;
    balls_[node] = {low + half, Length(half) * (1 + 1e-12)};
    if (end - begin <= kLeafSize) return;
    const int axis = half.x >= half.y && half.x >= half.z ? 0 : half.y >= half.z ? 1 : 2;
    const size_t middle = begin + (end - begin) / 2;
    const auto at = [this](size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](uint32_t l, uint32_t r) {
      const double x = points_[l][axis], y = points_[r][axis];
      return x != y ? x < y : l < r;
    });
    Build(2 * node + 1, begin, middle);
    Build(2 * node + 2, middle, end);
  }

  template <typename Visit>
  void Near(size_t node, size_t begin, size_t end, const Vec3& a, const Vec3& b, double tolerance,
            const Visit& visit) const {
    double along = 0;
    const Ball& ball = balls_[node];
    if (DistanceSquared(ball.center, a, b, &along) > Square(ball.radius + 2 * tolerance)) return;
    if (end - begin <= kLeafSize) {
      for (size_t i = begin; i < end; ++i) visit(order_[i]);
      return;
    }
    const size_t middle = begin + (end - begin) / 2;
    Near(2 * node + 1, begin, middle, a, b, tolerance, visit);
    Near(2 * node + 2, middle, end, a, b, tolerance, visit);
  }

  std::span<const Vec3> points_;
  std::vector<uint32_t> order_;
  std::vector<Ball> balls_;
};

}  // namespace

std::vector<TJunction> FindTJunctions(std::span<const Vec3> points,
                                      std::span<const uint32_t> vertices,
                                      std::span<const std::array<uint32_t, 2>> edges,
                                      double tolerance, size_t most) {
  const VertexTree tree(points, vertices);
  std::vector<TJunction> found;
  const auto by_vertex = [](const TJunction& l, const TJunction& r) {
    return l.vertex != r.vertex ? l.vertex < r.vertex : l.edge < r.edge;
  };
  const auto keep_first = [&] {
    std::sort(found.begin(), found.end(), by_vertex);
    if (found.size() > most) found.resize(most);
  };
  for (uint32_t e = 0; e < edges.size(); ++e) {
    const uint32_t u = edges[e][0], v = edges[e][1];
    const Vec3& a = points[u];
    const Vec3& b = points[v];
    tree.Near(a, b, tolerance, [&](uint32_t vertex) {
      if (vertex == u || vertex == v) return;
      const Vec3& p = points[vertex];
      double along = 0;
      const double limit = Square(tolerance);
      if (DistanceSquared(p, a, b, &along) > limit) return;
      if (glm::dot(p - a, p - a) <= limit || glm::dot(p - b, p - b) <= limit) return;
      found.push_back({vertex, e});
    });
    if (found.size() > 4 * most + 1024) keep_first();
  }
  keep_first();
  return found;
}

}  // namespace fjord
