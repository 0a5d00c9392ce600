#include "engine/render/shadow_map.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "engine/base/clamp.h"
#include "engine/base/exact_math.h"

namespace fjord {
namespace {

constexpr float kNothing = -3e38f;  // nearness where nothing is

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

}  // namespace fjord
