#include "engine/texture/value_noise.h"

#include "engine/base/clamp.h"
#include "engine/base/random.h"

namespace fjord {
namespace {

double Corner(uint64_t seed, int64_t x, int64_t y, int64_t z) {
  uint64_t bits = Mix64(seed + static_cast<uint64_t>(x) * 0x9e3779b97f4a7c15u + 1);
  bits = Mix64(bits + static_cast<uint64_t>(y) * 0xbf58476d1ce4e5b9u);
  bits = Mix64(bits + static_cast<uint64_t>(z) * 0x94d049bb133111ebu);
  return static_cast<double>(bits >> 12) * 0x1p-51 - 1;
}

// From 0 to 1 with first and second derivative 0 at both ends.
double Ease(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

double Mix(double a, double b, double t) { return a + (b - a) * t; }

}  // namespace

double ValueNoise(const Vec3& place, uint64_t seed) {
  const int64_t x = FloorToInt64(place.x), y = FloorToInt64(place.y), z = FloorToInt64(place.z);
  const double u = Ease(place.x - Floor(place.x)), v = Ease(place.y - Floor(place.y)),
               w = Ease(place.z - Floor(place.z));
  double level[2];
  for (int64_t k = 0; k < 2; ++k) {
    const double near = Mix(Corner(seed, x, y, z + k), Corner(seed, x + 1, y, z + k), u);
    const double far = Mix(Corner(seed, x, y + 1, z + k), Corner(seed, x + 1, y + 1, z + k), u);
    level[k] = Mix(near, far, v);
  }
  return Mix(level[0], level[1], w);
}

double NoiseSum(const Vec3& place, uint64_t seed, uint32_t octaves, double gain) {
  double sum = 0, heights = 0, height = 1, scale = 1;
  for (uint32_t octave = 0; octave < octaves; ++octave) {
    sum += height * ValueNoise(place * scale, Mix64(seed + octave));
    heights += height;
    height *= gain;
    scale *= 2;
  }
  return heights > 0 ? sum / heights : 0;
}

}  // namespace fjord
