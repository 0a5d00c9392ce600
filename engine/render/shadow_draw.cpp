#include "engine/render/shadow_draw.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "engine/base/parallel.h"
#include "engine/render/places.h"
#include "engine/render/tile_draw.h"

namespace fjord {
namespace {

// Terrain moves up and down more than sideways: tall tiles, as for pictures.
constexpr int32_t kTileWidth = 256;
constexpr int32_t kTileHeight = 1024;

bool ThrowsShadow(const BuiltObject& object) { return !object.shape->curve; }

// Where a ball lies along a row of the light's projection.
void AddRange(const std::array<double, 4>& row, const Ball& ball, double* least, double* most) {
  const double at = Row(row, ball.center);
  const double spread =
      std::sqrt((row[0] * row[0] + row[1] * row[1]) + row[2] * row[2]) * ball.radius;
  *least = std::min(*least, at - spread);
  *most = std::max(*most, at + spread);
}

// Of all that throws shadows; empty where left > right. `view` has scale 1.
LightBounds BoundsOf(const BuiltFrame& frame, std::span<const ObjectPlace> places,
                     const View& view) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double x[2] = {kInfinity, -kInfinity}, y[2] = {kInfinity, -kInfinity};
  for (const ObjectPlace& place : places) {
    const BuiltObject& object = frame.objects[place.object];
    if (!ThrowsShadow(object)) continue;
    const Projection to = MakeProjection(view, place.transform);
    for (size_t root = 0; root < object.prepared->RootCount(); ++root) {
      const Ball ball = object.prepared->Bound(root);
      AddRange(to.x, ball, &x[0], &x[1]);
      AddRange(to.y, ball, &y[0], &y[1]);
    }
  }
  constexpr double kUnit = 1. / kFixedOne;
  return {x[0] * kUnit, x[1] * kUnit, -y[1] * kUnit, -y[0] * kUnit};
}

std::vector<float> DrawNearness(const BuiltFrame& frame, std::span<const ObjectPlace> places,
                                const View& view, const RenderOptions& options) {
  std::vector<ObjectSetup> objects;
  std::vector<CullObject> cull;
  for (const ObjectPlace& place : places) {
    ObjectSetup setup;
    setup.to = MakeProjection(view, place.transform);
    setup.keep = Keep::kDepth;
    setup.line_width = 0;
    objects.push_back(setup);
    cull.push_back({frame.objects[place.object].prepared.get(), setup.to});
  }
  const TileRect region{0, 0, static_cast<int32_t>(view.width), static_cast<int32_t>(view.height)};
  const TileLists lists = BinRoots(region, kTileWidth, kTileHeight, cull);
  const DrawList list{objects, cull, 1, nullptr};
  std::vector<float> nearness(size_t{view.width} * view.height,
                              -std::numeric_limits<float>::infinity());
  ParallelFor(lists.tiles.size(), options.threads, [&](size_t tile) {
    const TileRect& rect = lists.busy[tile];
    if (rect.height == 0) return;
    TileDraw draw;
    StreamStats made;
    draw.Draw(list, lists, tile, options, &made);
    for (int32_t y = rect.y; y < rect.bottom(); ++y) {
      const double* from = draw.buffer().depth() + draw.buffer().Index(rect.x, y, 0);
      float* to = &nearness[static_cast<size_t>(y) * view.width + static_cast<size_t>(rect.x)];
      for (int32_t x = 0; x < rect.width; ++x) to[x] = static_cast<float>(from[x]);
    }
  });
  return nearness;
}

Error TooLarge(size_t light, const View& view, double detail) {
  const double texels = double{1} * view.width * view.height;
  const double wanted = detail * std::sqrt(texels / ShadowMap::kMostTexels) * 1.05;
  return MakeError(ErrorCode::kLimit,
                   "light " + std::to_string(light + 1) + ": its shadows would need " +
                       std::to_string(view.width) + "x" + std::to_string(view.height) +
                       " texels or more; a shadow_detail of " + std::to_string(wanted) +
                       " instead of " + std::to_string(detail) + " would fit");
}

// How the light sees all that throws shadows; none where nothing does.
Result<std::optional<View>> LightViewOf(const BuiltFrame& frame,
                                        std::span<const ObjectPlace> places, size_t light) {
  View view = MakeLightView(Unit(frame.lights[light].place, Vec3(0, 0, 1)));
  const LightBounds bounds = BoundsOf(frame, places, view);
  if (bounds.left > bounds.right) return std::optional<View>();
  const double detail = frame.lights[light].shadow;
  if (!FitLightView(bounds, detail, &view)) return TooLarge(light, view, detail);
  return std::optional<View>(view);
}

}  // namespace

std::optional<ShadowDefect> FindShadowDefect(const BuiltFrame& frame) {
  const std::vector<ObjectPlace> places = AllPlaces(frame);
  for (size_t i = 0; i < frame.lights.size(); ++i) {
    if (!(frame.lights[i].shadow > 0)) continue;
    const auto view = LightViewOf(frame, places, i);
    if (!view) return ShadowDefect{i, view.error()};
  }
  return std::nullopt;
}

Result<> DrawShadows(FrameSetup* setup, const RenderOptions& options) {
  const BuiltFrame& frame = setup->frame;
  const std::vector<ObjectPlace> places = AllPlaces(frame);
  setup->shadows.reserve(frame.lights.size());
  for (size_t i = 0; i < frame.lights.size(); ++i) {
    if (!(frame.lights[i].shadow > 0)) continue;
    const auto view = LightViewOf(frame, places, i);
    if (!view) return view.error();
    if (!*view) continue;
    setup->lights[i].shadow = static_cast<int32_t>(setup->shadows.size());
    setup->shadows.emplace_back(**view, DrawNearness(frame, places, **view, options));
    if (options.cancel != nullptr && options.cancel->load(std::memory_order_relaxed)) {
      return MakeError(ErrorCode::kCancelled, "cancelled");
    }
  }
  return Ok{};
}

}  // namespace fjord
