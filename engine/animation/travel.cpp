#include "engine/animation/travel.h"

#include <algorithm>
#include <vector>

#include "engine/base/check.h"
#include "engine/base/clamp.h"

namespace fjord {

Vec3 Bezier(std::span<const Vec3> control, double t) {
  std::vector<Vec3> points(control.begin(), control.end());
  for (size_t left = points.size() - 1; left > 0; --left) {
    for (size_t i = 0; i < left; ++i) points[i] = points[i] + (points[i + 1] - points[i]) * t;
  }
  return points[0];
}

Vec3 Through(std::span<const Vec3> knots, double t) {
  FJORD_CHECK(knots.size() >= 2, knots.size());
  const size_t pieces = knots.size() - 1;
  const double at = t * static_cast<double>(pieces);
  const auto piece = static_cast<size_t>(
      std::clamp<int64_t>(FloorToInt64(at), 0, static_cast<int64_t>(pieces) - 1));
  const double s = at - static_cast<double>(piece);
  if (s == 0) return knots[piece];
  if (s == 1) return knots[piece + 1];
  const double times[] = {-1, 0, 1, 2};
  const bool before = piece > 0, after = piece + 2 < knots.size();
  const auto weights = SplineWeights({times[0], times[1], times[2], times[3]}, before, after, s);
  Vec3 point = knots[piece] * weights[1] + knots[piece + 1] * weights[2];
  if (before) point += knots[piece - 1] * weights[0];
  if (after) point += knots[piece + 2] * weights[3];
  return point;
}

std::array<double, 4> SplineWeights(const std::array<double, 4>& times, bool has_before,
                                    bool has_after, double t) {
  const double gap = times[2] - times[1];
  // Hermite: p1 h1 + p2 h2 + m1 g1 + m2 g2, tangents m for t in 0..1
  const double h2 = t * t * (3 - 2 * t), h1 = 1 - h2;
  const double g1 = t * (1 - t) * (1 - t), g2 = t * t * (t - 1);
  // m = the slope at the key of the parabola through it and its neighbours, as weights of the four
  std::array<double, 4> m1{}, m2{};
  if (has_before) {
    const double gap0 = times[1] - times[0];
    const double back = gap / gap0 * (gap / (gap0 + gap)), ahead = gap0 / (gap0 + gap);
    m1 = {-back, back - ahead, ahead, 0};
  }
  if (has_after) {
    const double gap2 = times[3] - times[2];
    const double back = gap2 / (gap + gap2), ahead = gap / gap2 * (gap / (gap + gap2));
    m2 = {0, -back, back - ahead, ahead};
  }
  // at an end of the keys: no bend, m_end = 1.5 (p2 - p1) - m_other / 2
  const std::array<double, 4> chord = {0, -1, 1, 0};
  const std::array<double, 4> m1_given = m1;
  if (!has_before && !has_after) {
    m1 = m2 = chord;
  } else if (!has_before) {
    for (size_t i = 0; i < 4; ++i) m1[i] = 1.5 * chord[i] - .5 * m2[i];
  } else if (!has_after) {
    for (size_t i = 0; i < 4; ++i) m2[i] = 1.5 * chord[i] - .5 * m1_given[i];
  }
  std::array<double, 4> weights = {0, h1, h2, 0};
  for (size_t i = 0; i < 4; ++i) weights[i] += g1 * m1[i] + g2 * m2[i];
  return weights;
}

}  // namespace fjord
