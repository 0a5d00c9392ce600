#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/clamp.h"
#include "engine/base/exact_math.h"
#include "engine/base/random.h"
#include "engine/fractal/measure.h"

namespace fjord {
namespace {

// Vertices by the cell of a square grid they lie in, for finding one near a place.
class PlaneGrid {
 public:
  PlaneGrid(const std::vector<Vec3>& points, double cell) : points_(points), cell_(cell) {
    for (size_t i = 0; i < points.size(); ++i) {
      const std::array<int64_t, 2> key = Key(points[i]);
      entries_.push_back({key[0], key[1], static_cast<int64_t>(i)});
    }
    std::sort(entries_.begin(), entries_.end());
  }

  // A vertex in the cell of p, or null.
  const Vec3* Near(const Vec3& p) const {
    const std::array<int64_t, 2> key = Key(p);
    const std::array<int64_t, 3> low = {key[0], key[1], 0};
    const auto found = std::lower_bound(entries_.begin(), entries_.end(), low);
    const bool here = found != entries_.end() && (*found)[0] == key[0] && (*found)[1] == key[1];
    return here ? &points_[static_cast<size_t>((*found)[2])] : nullptr;
  }

 private:
  std::array<int64_t, 2> Key(const Vec3& p) const {
    return {FloorToInt64(p.x / cell_), FloorToInt64(p.y / cell_)};
  }

  const std::vector<Vec3>& points_;
  double cell_;
  std::vector<std::array<int64_t, 3>> entries_;
};

// Mean squared height step and mean squared distance of pairs about `lag` apart, over at most 20000
// vertices and eight headings. 0 pairs: nullopt.
struct PairMeans {
  double distance2 = 0;
  double step2 = 0;
  double count = 0;
};

PairMeans MeasurePairs(const std::vector<Vec3>& points, const PlaneGrid& grid, double lag) {
  constexpr double kHeadings[8][2] = {{1, 0},  {.7071, .7071},   {0, 1},  {-.7071, .7071},
                                      {-1, 0}, {-.7071, -.7071}, {0, -1}, {.7071, -.7071}};
  constexpr size_t kMost = 20000;
  const size_t samples = std::min(points.size(), kMost);
  PairMeans means;
  for (size_t i = 0; i < samples; ++i) {
    const Vec3& p = points[samples < kMost ? i : Mix64(i) % points.size()];
    for (const auto& heading : kHeadings) {
      const Vec3* q = grid.Near(p + Vec3(heading[0] * lag, heading[1] * lag, 0));
      if (q != nullptr) {
        const Vec3 d = *q - p;
        means.distance2 += d.x * d.x + d.y * d.y;
        means.step2 += d.z * d.z;
        means.count += 1;
      }
    }
  }
  return means;
}

}  // namespace

std::optional<double> ReliefHurst(const Mesh& mesh) {
  const std::vector<Vec3>& points = mesh.points;
  if (points.size() < 1000) {
    return std::nullopt;
  }
  Vec3 low = points[0];
  Vec3 high = points[0];
  for (const Vec3& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), 0};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), 0};
  }
  const double extent = std::max(high.x - low.x, high.y - low.y);
  const double area = (high.x - low.x) * (high.y - low.y);
  if (!(area > 0)) {
    return std::nullopt;
  }
  const double spacing = std::sqrt(area / static_cast<double>(points.size()));
  const PlaneGrid grid(points, spacing);
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> weight;
  for (double lag = extent / 8; lag >= 3 * spacing; lag *= .5) {
    const PairMeans means = MeasurePairs(points, grid, lag);
    if (means.count >= 100 && means.step2 > 0) {
      x.push_back(.5 * exact::Log2(means.distance2 / means.count));
      y.push_back(.5 * exact::Log2(means.step2 / means.count));
      weight.push_back(1);
    }
  }
  return x.size() >= 2 ? std::optional<double>(Slope(x, y, weight)) : std::nullopt;
}

}  // namespace fjord
