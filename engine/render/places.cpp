#include "engine/render/places.h"

#include <algorithm>

#include "engine/render/cull.h"

namespace fjord {
namespace {

// Round all that the object can become.
Ball BoundOf(const PreparedFractal& prepared) {
  Vec3 low(0), high(0);
  for (size_t root = 0; root < prepared.RootCount(); ++root) {
    const Ball ball = prepared.Bound(root);
    for (int i = 0; i < 3; ++i) {
      const double least = ball.center[i] - ball.radius, most = ball.center[i] + ball.radius;
      low[i] = root == 0 ? least : std::min(low[i], least);
      high[i] = root == 0 ? most : std::max(high[i], most);
    }
  }
  return {(low + high) * .5, .5 * Length(high - low) * (1 + 1e-9)};
}

}  // namespace

Transform Composed(const Transform& first, const Transform& second) {
  Transform both;
  for (size_t row = 0; row < 3; ++row) {
    const double* s = &second[4 * row];
    for (size_t column = 0; column < 4; ++column) {
      const auto at = [&](size_t k) { return first[4 * k + column]; };
      const double sum = (s[0] * at(0) + s[1] * at(1)) + s[2] * at(2);
      both[4 * row + column] = column == 3 ? sum + s[3] : sum;
    }
  }
  return both;
}

std::vector<ObjectPlace> AllPlaces(const BuiltFrame& frame) {
  std::vector<ObjectPlace> places;
  for (size_t o = 0; o < frame.objects.size(); ++o) {
    const BuiltObject& object = frame.objects[o];
    const auto number = static_cast<uint32_t>(o);
    if (object.placements.empty()) places.push_back({number, object.transform});
    for (const Transform& placement : object.placements) {
      places.push_back({number, Composed(placement, object.transform)});
    }
  }
  return places;
}

std::vector<ObjectPlace> PlacesSeen(const BuiltFrame& frame, const View& view) {
  const TileRect whole{0, 0, static_cast<int32_t>(frame.width), static_cast<int32_t>(frame.height)};
  std::vector<ObjectPlace> places;
  for (size_t o = 0; o < frame.objects.size(); ++o) {
    const BuiltObject& object = frame.objects[o];
    const auto number = static_cast<uint32_t>(o);
    if (object.placements.empty()) {
      places.push_back({number, object.transform});
      continue;
    }
    const Ball bound = BoundOf(*object.prepared);
    CullObject cull;
    if (object.shape->curve) cull.spread = StrokeSpread(object.material.drawn_width());
    for (const Transform& placement : object.placements) {
      const Transform transform = Composed(placement, object.transform);
      cull.to = MakeProjection(view, transform);
      const bool fill = object.material.fill;  // counted from beyond the picture
      const TileFrustum frustum(cull, whole);
      if (fill || frustum.MayTouch(bound.center, bound.center, bound.center, bound.radius)) {
        places.push_back({number, transform});
      }
    }
  }
  return places;
}

}  // namespace fjord
