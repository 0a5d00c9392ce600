#include "engine/fractal/measure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/check.h"
#include "engine/base/clamp.h"
#include "engine/base/exact_math.h"

namespace fjord {
namespace {

constexpr double kMostSteps = 1e8;

std::vector<Vec3> ClosedPoints(const Polyline& line) {
  std::vector<Vec3> points = line.points;
  if (line.closed && !points.empty()) {
    points.push_back(points.front());
  }
  return points;
}

// -slope of log2 count over log2 size, all sizes alike.
template <typename Count>
double Dimension(std::span<const double> sizes, const Count& count) {
  std::vector<double> x;
  std::vector<double> y;
  for (const double size : sizes) {
    const double n = count(size);
    if (size > 0 && n > 0) {
      x.push_back(exact::Log2(size));
      y.push_back(exact::Log2(n));
    }
  }
  const std::vector<double> weight(x.size(), 1);
  return -Slope(x, y, weight);
}

}  // namespace

std::optional<double> SimilarityDimension(std::span<const double> ratios) {
  if (ratios.size() < 2) {
    return std::nullopt;
  }
  for (const double r : ratios) {
    if (!(r > 0 && r < 1)) {
      return std::nullopt;
    }
  }
  const auto sum = [&](double D) {
    double total = 0;
    for (const double r : ratios) {
      total += exact::Exp2(D * exact::Log2(r));
    }
    return total;
  };
  double low = 0;
  double high = 16;
  if (sum(high) > 1) {
    return std::nullopt;
  }
  for (int step = 0; step < 60; ++step) {
    const double D = .5 * (low + high);
    (sum(D) > 1 ? low : high) = D;
  }
  return .5 * (low + high);
}

double Slope(std::span<const double> x, std::span<const double> y, std::span<const double> weight) {
  FJORD_CHECK(x.size() == y.size() && x.size() == weight.size(), x.size(), y.size());
  double w = 0;
  double wx = 0;
  double wy = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    w += weight[i];
    wx += weight[i] * x[i];
    wy += weight[i] * y[i];
  }
  double xx = 0;
  double xy = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    const double dx = x[i] - wx / w;
    xx += weight[i] * dx * dx;
    xy += weight[i] * dx * (y[i] - wy / w);
  }
  return xx > 0 ? xy / xx : 0;
}

double Variogram(std::span<const double> values, size_t lag, bool aligned) {
  FJORD_CHECK(lag > 0 && values.size() > lag, lag, values.size());
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i + lag < values.size(); i += aligned ? lag : 1) {
    const double step = values[i + lag] - values[i];
    sum += step * step;
    ++count;
  }
  return sum / static_cast<double>(count);
}

std::optional<double> HurstExponent(std::span<const double> values, bool aligned) {
  if (values.size() < 33) {
    return std::nullopt;
  }
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> weight;
  for (size_t lag = 1; lag <= 16; lag *= 2) {
    const double mean = Variogram(values, lag, aligned);
    if (!(mean > 0)) {
      return std::nullopt;
    }
    x.push_back(exact::Log2(static_cast<double>(lag)));
    y.push_back(exact::Log2(mean));
    weight.push_back(1 / static_cast<double>(lag));
  }
  return .5 * Slope(x, y, weight);
}

double CountSteps(const Polyline& line, double opening) {
  const std::vector<Vec3> points = ClosedPoints(line);
  if (points.size() < 2 || !(opening > 0)) {
    return 0;
  }
  // A hair's breadth of rounding must not cost a step where a vertex lies exactly on the circle.
  const double reach2 = opening * opening * (1 - 1e-9);
  Vec3 at = points[0];
  double steps = 0;
  for (size_t i = 0; i + 1 < points.size();) {
    const Vec3& a = points[i];
    const Vec3& b = points[i + 1];
    const Vec3 to_b = b - at;
    if (glm::dot(to_b, to_b) < reach2) {
      ++i;
      continue;
    }
    // Leaves the circle round `at` on a-b, behind `at` where that lies on a-b itself.
    const Vec3 d = b - a;
    const Vec3 f = a - at;
    const double dd = glm::dot(d, d);
    const double fd = glm::dot(f, d);
    const double root = fd * fd - dd * (glm::dot(f, f) - opening * opening);
    double t = (-fd + std::sqrt(root > 0 ? root : 0)) / dd;
    t = t < 1 ? t : 1;
    at = a + d * t;
    steps += 1;
    if (steps >= kMostSteps) {
      return steps;
    }
    if (t >= 1) {
      ++i;
    }
  }
  return steps + Length(points.back() - at) / opening;
}

double RulerDimension(const Polyline& line, std::span<const double> openings) {
  return Dimension(openings, [&](double opening) { return CountSteps(line, opening); });
}

size_t CountBoxes(std::span<const Vec3> points, double size, const Vec3& origin) {
  std::vector<std::array<int64_t, 3>> boxes;
  boxes.reserve(points.size());
  for (const Vec3& p : points) {
    const Vec3 q = (p - origin) / size;
    boxes.push_back({FloorToInt64(q.x), FloorToInt64(q.y), FloorToInt64(q.z)});
  }
  std::sort(boxes.begin(), boxes.end());
  return static_cast<size_t>(std::unique(boxes.begin(), boxes.end()) - boxes.begin());
}

double BoxDimension(std::span<const Vec3> points, std::span<const double> sizes) {
  if (points.empty()) {
    return 0;
  }
  Vec3 low = points[0];
  for (const Vec3& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  }
  return Dimension(sizes,
                   [&](double size) { return static_cast<double>(CountBoxes(points, size, low)); });
}

std::vector<Vec3> Resample(const Polyline& line, double step) {
  const std::vector<Vec3> points = ClosedPoints(line);
  std::vector<Vec3> out;
  for (size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3 along = points[i + 1] - points[i];
    const double parts = std::min(Floor(Length(along) / step) + 1, kMostSteps);
    for (double k = 0; k < parts && static_cast<double>(out.size()) < kMostSteps; k += 1) {
      out.push_back(points[i] + along * (k / parts));
    }
  }
  if (!points.empty()) {
    out.push_back(points.back());
  }
  return out;
}

}  // namespace fjord
