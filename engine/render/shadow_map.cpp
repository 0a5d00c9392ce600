#include "engine/render/shadow_map.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "engine/base/clamp.h"
#include "engine/base/exact_math.h"

namespace fjord {
namespace {

constexpr double kBias = 1.25;  // texels; see shadow_map.h
// The most that a surface is taken to rise, texels of depth a texel. What rises more has less than
// 1 / kSteepest of the light.
constexpr double kSteepest = 64;
constexpr float kNothing = -3e38f;  // nearness where nothing is

// Weights of a cubic B-spline at distances t + 1, t, 1 - t, 2 - t.
struct Spline {
  float weight[4];

  explicit Spline(float t) {
    const float s = 1 - t, third = 1.f / 6;
    weight[0] = s * s * s * third;
    weight[1] = (4 - (6 - 3 * t) * t * t) * third;
    weight[2] = (4 - (6 - 3 * s) * s * s) * third;
    weight[3] = t * t * t * third;
  }
};

// Floats that are not negative have the order of their bits, and negative ones are negative as
// whole numbers too: so clamping takes no branch, which g++ makes of comparisons of floats in a
// loop.
float Positive(float a) { return std::bit_cast<float>(std::max(std::bit_cast<int32_t>(a), 0)); }
float AtMostOne(float a) {  // a >= 0
  return std::bit_cast<float>(std::min(std::bit_cast<int32_t>(a), std::bit_cast<int32_t>(1.f)));
}

// How much of the light each of 4x4 texels keeps away, by its weight. One loop, which g++ makes
// vectors of; the sum has an order and comes after it. No argument is NaN.
void WeighHidden(const float* nearest, const float* own, const float* weight, float base,
                 float scale, float* part) {
  for (int32_t i = 0; i < 16; ++i) {
    const float over = (nearest[i] - base) * scale - Positive(own[i]);
    part[i] = weight[i] * AtMostOne(Positive(over));
  }
}

}  // namespace

View MakeLightView(const Vec3& to_light) {
  Camera camera;
  camera.eye = Vec3(0);
  camera.look_at = -to_light;
  camera.up = Vec3(0, 0, 1);
  camera.orthographic = true;
  camera.near = -1e15;  // nothing is too near to a light that has no place
  View view = MakeView(camera, 1, 1);
  view.center_x = view.center_y = 0;
  return view;
}

bool FitLightView(const LightBounds& bounds, double detail, View* view) {
  constexpr double kMargin = 4;  // texels that a comparison may reach for
  const double scale = 1 / detail;
  const double left = Floor(bounds.left * scale) - kMargin;
  const double top = Floor(-bounds.top * scale) - kMargin;
  const double width = Floor(bounds.right * scale) + kMargin - left;
  const double height = Floor(-bounds.bottom * scale) + kMargin - top;
  view->focal = scale;
  view->center_x = -left;
  view->center_y = -top;
  constexpr double kMostSide = 1 << 20;
  view->width = static_cast<uint32_t>(ClampToInt32(std::min(width, kMostSide)));
  view->height = static_cast<uint32_t>(ClampToInt32(std::min(height, kMostSide)));
  return width * height <= ShadowMap::kMostTexels && width <= kMostSide && height <= kMostSide;
}

ShadowMap::ShadowMap(const View& view, std::vector<float> nearness)
    : view_(view),
      to_light_(-view.forward),
      width_(static_cast<int32_t>(view.width)),
      height_(static_cast<int32_t>(view.height)),
      nearness_(std::move(nearness)),
      blocks_x_((width_ + kBlock - 1) / kBlock),
      blocks_y_((height_ + kBlock - 1) / kBlock) {
  const auto block_count = static_cast<size_t>(blocks_x_) * static_cast<size_t>(blocks_y_);
  std::vector<float> own(block_count, kNothing);
  for (int32_t y = 0; y < height_; ++y) {
    for (int32_t x = 0; x < width_; ++x) {
      float& most = own[BlockIndex(x / kBlock, y / kBlock)];
      most =
          std::max(most, nearness_[static_cast<size_t>(y) * view.width + static_cast<size_t>(x)]);
    }
  }
  most_.assign(block_count, kNothing);
  for (int32_t y = 0; y < blocks_y_; ++y) {
    for (int32_t x = 0; x < blocks_x_; ++x) {
      float& most = most_[BlockIndex(x, y)];
      for (int32_t j = std::max(y - 1, 0); j <= std::min(y + 1, blocks_y_ - 1); ++j) {
        for (int32_t i = std::max(x - 1, 0); i <= std::min(x + 1, blocks_x_ - 1); ++i) {
          most = std::max(most, own[BlockIndex(i, j)]);
        }
      }
    }
  }
}

// Is nothing round texel (x, y) nearer to the light than `least`?
bool ShadowMap::IsFree(int32_t x, int32_t y, float least) const {
  return most_[BlockIndex(x / kBlock, y / kBlock)] <= least;
}

float ShadowMap::Share(const Vec3& point, const Vec3& normal) const {
  const double texel = 1 / view_.focal;
  // The middle of texel i lies at i + .5.
  const double u = glm::dot(point, view_.right) * view_.focal + view_.center_x - .5;
  const double v = view_.center_y - glm::dot(point, view_.up) * view_.focal - .5;
  if (!(u >= 1 && v >= 1 && u < width_ - 3 && v < height_ - 3)) return 1;
  const int32_t x = FloorToInt32(u), y = FloorToInt32(v);
  const double nearness = glm::dot(point, to_light_);
  const double least = nearness + kBias * texel;
  if (IsFree(x, y, static_cast<float>(least))) return 1;

  // How much nearer to the light its plane comes from one texel to the next.
  const double facing = std::max(glm::dot(normal, to_light_), 1e-3);
  const double per_u = -glm::dot(normal, view_.right) / facing;
  const double per_v = glm::dot(normal, view_.up) / facing;
  const auto rise_u = static_cast<float>(std::clamp(per_u, -kSteepest, kSteepest));
  const auto rise_v = static_cast<float>(std::clamp(per_v, -kSteepest, kSteepest));
  const auto du = static_cast<float>(u - x), dv = static_cast<float>(v - y);
  const Spline across(du), down(dv);
  const auto base = static_cast<float>(least);
  const auto scale = static_cast<float>(view_.focal);
  float nearest[16], own[16], weight[16];
  for (int32_t j = 0; j < 4; ++j) {
    const float* row =
        &nearness_[static_cast<size_t>(y + j - 1) * view_.width + static_cast<size_t>(x - 1)];
    const float along_v = rise_v * (static_cast<float>(j - 1) - dv);
    std::copy_n(row, 4, nearest + 4 * j);
    std::copy_n(across.weight, 4, weight + 4 * j);
    for (int32_t i = 0; i < 4; ++i) {
      own[4 * j + i] = rise_u * (static_cast<float>(i - 1) - du) + along_v;
    }
  }
  float part[16];
  WeighHidden(nearest, own, weight, base, scale, part);
  float hidden = 0;
  for (int32_t j = 0; j < 4; ++j) {
    float sum = 0;
    for (int32_t i = 0; i < 4; ++i) sum += part[4 * j + i];
    hidden += down.weight[j] * sum;
  }
  return 1 - std::min(hidden, 1.f);
}

}  // namespace fjord
