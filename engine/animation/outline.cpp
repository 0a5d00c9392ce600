#include "engine/animation/outline.h"

#include <algorithm>

#include "engine/base/clamp.h"

namespace fjord {

std::vector<double> ArcLengths(std::span<const Vec3> points, bool closed) {
  std::vector<double> lengths = {0};
  const size_t count = points.size() + (closed ? 1 : 0);
  for (size_t i = 1; i < count; ++i) {
    lengths.push_back(lengths.back() + Length(points[i % points.size()] - points[i - 1]));
  }
  return lengths;
}

std::vector<double> Shares(std::span<const double> lengths) {
  std::vector<double> shares(lengths.size(), 0);
  const double whole = lengths.back() - lengths.front();
  for (size_t i = 1; i < lengths.size(); ++i) {
    shares[i] = whole > 0 ? (lengths[i] - lengths.front()) / whole
                          : static_cast<double>(i) / static_cast<double>(lengths.size() - 1);
  }
  shares.back() = lengths.size() > 1 ? 1 : 0;
  return shares;
}

Vec3 PointAtLength(std::span<const Vec3> points, std::span<const double> lengths, double length) {
  const double whole = lengths.back();
  if (whole <= 0) return points[0];
  const double around = length / whole;
  const double wanted = (around - Floor(around)) * whole;
  const auto after = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, wanted);
  const auto end = static_cast<size_t>(after - lengths.begin());
  const double piece = lengths[end] - lengths[end - 1];
  const double t = piece > 0 ? (wanted - lengths[end - 1]) / piece : 0;
  const Vec3& a = points[end - 1];
  return a + (points[end % points.size()] - a) * t;
}

}  // namespace fjord
