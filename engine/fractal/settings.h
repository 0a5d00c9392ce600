// The settings of one fractal object as plain values, and the table that describes them. The scene
// reader, presets, docs and tests loop over the table; kernels read the struct.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "engine/geometry/vec.h"

namespace fjord {

// Enumerators have the numbers of scene.proto's Fractal.
enum class Law : uint32_t { kDefault, kAffine, kSimilar, kShih };
enum class Direction : uint32_t { kDefault, kEdge, kFace, kVertex, kUp };
enum class Variant : uint32_t { kDefault, kFixed, kCurrent, kPerturbed };
enum class Split : uint32_t { kDefault, kShot, kAdaptive, kLength };
enum class Increments : uint32_t { kMidpoint, kAdditions };

// When an edge is split (frame.proto, FrameFineness). Object space, rest pose.
struct Fineness {
  double epsilon = 0;
  double pixels = 0;
  double focal = 0;  // > 0: by pixels
  double near = 0;
  Vec3 eye{0};
  double eye_radius = 0;
};

struct FractalSettings {
  std::string method;
  uint64_t seed = 1;
  double H = .7;
  double sigma = 1;
  double amplitude = .15;
  Law law = Law::kDefault;
  Direction direction = Direction::kDefault;
  Variant variant = Variant::kDefault;
  Split split = Split::kShot;
  uint32_t max_level = 24;
  uint32_t uniforms = 4;
  double move = .4;
  double perturb = 1;
  bool stretch = true;
  Increments increments = Increments::kMidpoint;
  bool coast = false;
  double coast_H = .75;
  Fineness fineness;
};

// One number a user can turn. `name` is the field of scene.proto's Fractal.
struct Knob {
  std::string_view name;
  double FractalSettings::*value;
  double lowest;
  double highest;
  std::string_view effect;  // what one sees when it alone is turned up
};

// All numeric knobs, in the order of scene.proto.
std::span<const Knob> AllKnobs();

}  // namespace fjord
