// The settings of one fractal object as plain values. FractalCommon is what every method gets;
// beside it a method keeps values of its own in a struct of its own, described by the table of its
// registry entry (method.h).
#pragma once

#include <cstdint>
#include <string>

#include "engine/geometry/vec.h"

namespace fjord {

// Numbers of enumerators never change.
enum class Law : uint32_t { kDefault, kAffine, kSimilar, kShih };
enum class Direction : uint32_t { kDefault, kEdge, kFace, kVertex, kUp };
enum class Variant : uint32_t { kDefault, kFixed, kCurrent, kPerturbed };
enum class Split : uint32_t { kDefault, kShot, kAdaptive, kLength };  // as in scene.proto
enum class Increments : uint32_t { kMidpoint, kAdditions, kEven };

// When an edge is split (frame.proto, FrameFineness). Object space, rest pose.
struct Fineness {
  double epsilon = 0;
  double pixels = 0;
  double focal = 0;  // > 0: by pixels
  double near = 0;
  Vec3 eye{0};
  double eye_radius = 0;
};

struct FractalCommon {
  std::string method;  // its name; empty: no fractal
  uint64_t seed = 1;
  Split split = Split::kShot;
  uint32_t max_level = 24;
  Fineness fineness;
};

// The struct of the methods that displace midpoints: surface, coast and curve. Each offers the
// fields that it reads (midpoint_knobs.h).
struct FractalSettings : FractalCommon {
  double H = .7;
  double sigma = 1;
  double amplitude = .15;
  Law law = Law::kDefault;
  Direction direction = Direction::kDefault;
  Variant variant = Variant::kDefault;
  uint32_t uniforms = 4;
  double move = .4;
  double perturb = 1;
  bool stretch = true;
  Increments increments = Increments::kMidpoint;
  bool coast = false;
  double coast_H = .75;
  bool by_place = false;
};

}  // namespace fjord
