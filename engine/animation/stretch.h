// Stretches of a shot: whole frames, one after another, over which numbers that tracks change are
// bounded by their values at the ends. What must hold in every frame of a shot is worked out
// stretch by stretch, and closer only where that is not close enough: a shot costs what its tracks
// cost, however many frames it has.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/geometry/vec.h"
#include "engine/scene/shapes.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {

struct Stretch {
  uint32_t first = 1;
  uint32_t last = 1;
};

// Frames first..last, cut where keys stand, so that within a stretch every tracked number goes one
// way only. Where that makes more than `most`, neighbours are put together.
std::vector<Stretch> CutAtKeys(std::span<const double> keys, Stretch whole, size_t most);

// Those keys that stand strictly inside the stretch.
std::span<const double> KeysInside(std::span<const double> keys, const Stretch& stretch);

// The numbers of a camera and of one object that say how fine the object is split.
struct ShotNumbers {
  Vec3 eye, look_at, up;
  Vec3 translate, rotate, scale;
  double fov = 0, view_height = 0, near = 0;
  double epsilon = 0, pixels = 0, viewing = 0;

  // `object` below 0: of the camera alone.
  ShotNumbers(const v1::Scene& now, int object);
};

// The least and the largest of each number.
struct ShotBounds {
  ShotNumbers low, high;

  explicit ShotBounds(const ShotNumbers& numbers) : low(numbers), high(numbers) {}
  void Add(const ShotNumbers& numbers);
};

}  // namespace fjord
