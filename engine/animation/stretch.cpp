#include "engine/animation/stretch.h"

#include <algorithm>

#include "engine/base/clamp.h"

namespace fjord {
namespace {

Vec3 ToVec3(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

void Widen(const Vec3& value, Vec3* low, Vec3* high) {
  for (int i = 0; i < 3; ++i) {
    (*low)[i] = std::min((*low)[i], value[i]);
    (*high)[i] = std::max((*high)[i], value[i]);
  }
}

void Widen(double value, double* low, double* high) {
  *low = std::min(*low, value);
  *high = std::max(*high, value);
}

}  // namespace

std::vector<Stretch> CutAtKeys(std::span<const double> keys, Stretch whole, size_t most) {
  std::vector<uint32_t> starts = {whole.first};
  for (const double key : keys) {
    const int64_t frame = -FloorToInt64(-key);  // the first at or after the key
    if (frame > starts.back() && frame <= whole.last) {
      starts.push_back(static_cast<uint32_t>(frame));
    }
  }
  const size_t together = (starts.size() + most - 1) / most;
  std::vector<Stretch> stretches;
  for (size_t i = 0; i < starts.size(); i += together) {
    const size_t next = i + together;
    stretches.push_back({starts[i], next < starts.size() ? starts[next] - 1 : whole.last});
  }
  return stretches;
}

std::span<const double> KeysInside(std::span<const double> keys, const Stretch& stretch) {
  const auto begin = std::upper_bound(keys.begin(), keys.end(), stretch.first);
  const auto end = std::lower_bound(begin, keys.end(), stretch.last);
  return {begin, end};
}

ShotNumbers::ShotNumbers(const v1::Scene& now, int object)
    : eye(ToVec3(now.camera().eye())),
      look_at(ToVec3(now.camera().look_at())),
      up(ToVec3(now.camera().up())),
      translate(0),
      rotate(0),
      scale(1),
      fov(now.camera().fov()),
      view_height(now.camera().view_height()),
      near(now.camera().near()) {
  if (object < 0) return;
  const v1::Transform& transform = now.objects(object).transform();
  const v1::Vec3& size = transform.scale();
  translate = ToVec3(transform.translate());
  rotate = ToVec3(transform.rotate());
  scale = {size.has_x() ? size.x() : 1, size.has_y() ? size.y() : 1, size.has_z() ? size.z() : 1};
  const v1::Fractal& fractal = now.objects(object).fractal();
  epsilon = fractal.epsilon();
  pixels = fractal.pixels();
  viewing = fractal.viewing();
}

void ShotBounds::Add(const ShotNumbers& numbers) {
  Widen(numbers.eye, &low.eye, &high.eye);
  Widen(numbers.look_at, &low.look_at, &high.look_at);
  Widen(numbers.up, &low.up, &high.up);
  Widen(numbers.translate, &low.translate, &high.translate);
  Widen(numbers.rotate, &low.rotate, &high.rotate);
  Widen(numbers.scale, &low.scale, &high.scale);
  Widen(numbers.fov, &low.fov, &high.fov);
  Widen(numbers.view_height, &low.view_height, &high.view_height);
  Widen(numbers.near, &low.near, &high.near);
  Widen(numbers.epsilon, &low.epsilon, &high.epsilon);
  Widen(numbers.pixels, &low.pixels, &high.pixels);
  Widen(numbers.viewing, &low.viewing, &high.viewing);
}

}  // namespace fjord
