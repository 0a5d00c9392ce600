#include "engine/animation/eye_bound.h"

#include <algorithm>

namespace fjord {
namespace {

// The largest |x - center| - |x - eye| over the box, from above: per cell its value at the cell's
// centre, and how much it can grow within the cell. Unit vectors to x from two places differ by at
// most 2 |apart| / (sum of distances), which bounds the slope.
double RadiusOf(const Vec3& center, std::span<const EyeBound> eyes, const BoxCells& cells) {
  double radius = 0;
  for (const EyeBound& bound : eyes) {
    const Vec3& eye = bound.center;
    const double apart = Length(eye - center);
    if (apart == 0) {
      radius = std::max(radius, bound.radius);
      continue;
    }
    double most = -apart;
    for (const Vec3& x : cells.centers) {
      const double from_center = Length(x - center), from_eye = Length(x - eye);
      const double sum = from_center + from_eye - 2 * cells.reach;
      const double slope = sum > apart ? 2 * apart / sum : 2;
      most = std::max(most, from_center - from_eye + slope * cells.reach);
    }
    radius = std::max(radius, std::min(most, apart) + bound.radius);
  }
  return radius * (1 + 1e-9);
}

}  // namespace

double DistanceTo(const Box& box, const Vec3& point) {
  Vec3 apart(0);
  for (int i = 0; i < 3; ++i) {
    apart[i] = std::max({0.0, box.low[i] - point[i], point[i] - box.high[i]});
  }
  return Length(apart);
}

BoxCells CutBox(const Box& box, int along) {
  const Vec3 size = box.Size();
  int count[3];
  Vec3 step(0);
  for (int i = 0; i < 3; ++i) {
    count[i] = size[i] > 0 ? along : 1;
    step[i] = size[i] / count[i];
  }
  BoxCells cells;
  cells.reach = .5 * Length(step) * (1 + 1e-9);
  for (int i = 0; i < count[0]; ++i) {
    for (int j = 0; j < count[1]; ++j) {
      for (int k = 0; k < count[2]; ++k) {
        cells.centers.push_back(box.low + Vec3(i + .5, j + .5, k + .5) * step);
      }
    }
  }
  return cells;
}

std::vector<EyeBound> BoundEyes(std::span<const EyeBound> eyes, const Box& box, int along) {
  Box around;
  EyeBound nearest = eyes[0];
  double least = DistanceTo(box, nearest.center) - nearest.radius;
  double widest = 0;
  for (const EyeBound& eye : eyes) {
    around.Add(eye.center);
    widest = std::max(widest, eye.radius);
    const double distance = DistanceTo(box, eye.center) - eye.radius;
    if (distance < least) {
      least = distance;
      nearest = eye;
    }
  }
  if (around.low == around.high) return {{eyes[0].center, widest}};
  const BoxCells cells = CutBox(box, along);
  return {{nearest.center, RadiusOf(nearest.center, eyes, cells)},
          {around.Center(), RadiusOf(around.Center(), eyes, cells)}};
}

}  // namespace fjord
