#include "engine/render/cull.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/clamp.h"

namespace fjord {
namespace {

// Pixels round a tile that still count as touching it: sample places and rounding to the fixed
// grid. Strokes' spread comes on top.
constexpr double kMargin = 1;

// Pixel range low..high along one axis that a ball may touch; everything where it comes near the
// eye.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

double RowLength(const std::array<double, 4>& row) {
  return std::sqrt((row[0] * row[0] + row[1] * row[1]) + row[2] * row[2]);
}

// |x/z - xc/zc| <= r (|nx| zc + |xc| |nz|) / (zc (zc - r |nz|)) for all points of the ball.
Range BallRange(const Projection& to, const std::array<double, 4>& row, const Ball& ball,
                double margin) {
  const double at = Row(row, ball.center);
  const double spread = RowLength(row) * ball.radius;
  if (to.orthographic) {
    return {(at - spread) / kFixedOne - margin, (at + spread) / kFixedOne + margin};
  }
  const double z = Row(to.z, ball.center);
  const double z_spread = RowLength(to.z) * ball.radius;
  const double least_z = z - z_spread;
  if (!(least_z > .5 * to.near) || !(least_z > 1e-3 * z)) return {};
  const double middle = at / z;
  const double width = (spread * z + (at < 0 ? -at : at) * z_spread) / (z * least_z);
  return {(middle - width) / kFixedOne - margin, (middle + width) / kFixedOne + margin};
}

// First and last tile of a row of `count` that low..high touches; first > last: none.
struct Span {
  int32_t first, last;
};
Span TilesOf(const Range& range, const std::vector<int32_t>& edges) {
  const auto begin = edges.begin();
  // tile i covers edges[i]..edges[i + 1]
  const auto first = std::upper_bound(begin, edges.end(), range.low) - begin - 1;
  const auto last = std::lower_bound(begin, edges.end(), range.high) - begin - 1;
  const auto count = static_cast<int32_t>(edges.size()) - 1;
  return {std::max(static_cast<int32_t>(first), 0),
          std::min(static_cast<int32_t>(last), count - 1)};
}

// Lets the rows of low..high into `busy`.
void Occupy(const Range& range, const TileRect& tile, TileRect* busy) {
  const double top = std::max(range.low, double{1} * tile.y);
  const double bottom = std::min(range.high, double{1} * tile.bottom());
  const int32_t first = std::clamp(FloorToInt32(top), tile.y, tile.bottom() - 1);
  const int32_t last = std::clamp(FloorToInt32(bottom), first, tile.bottom() - 1);
  if (busy->height == 0) {
    *busy = {tile.x, first, tile.width, last - first + 1};
    return;
  }
  const int32_t end = std::max(busy->bottom(), last + 1);
  busy->y = std::min(busy->y, first);
  busy->height = end - busy->y;
}

std::vector<int32_t> Edges(int32_t from, int32_t to, int32_t step) {
  std::vector<int32_t> edges = {from};
  for (int32_t next = (from / step + 1) * step; next < to; next += step) edges.push_back(next);
  edges.push_back(to);
  return edges;
}

}  // namespace

double StrokeSpread(double line_width) { return .75 * line_width; }

TileFrustum::TileFrustum(const CullObject& object, const TileRect& rect) {
  const Projection& to = object.to;
  const double margin = kMargin + object.spread;
  const std::array<double, 4> one = {0, 0, 0, 1};
  const std::array<double, 4>& w = to.orthographic ? one : to.z;
  const auto side = [&](const std::array<double, 4>& row, double at, double sign) {
    std::array<double, 4> plane;
    for (int i = 0; i < 4; ++i) plane[i] = sign * (row[i] - at * kFixedOne * w[i]);
    Add(plane);
  };
  if (object.open != OpenSide::kLeft) side(to.x, rect.x - margin, 1);
  if (object.open != OpenSide::kRight) side(to.x, rect.right() + margin, -1);
  side(to.y, rect.y - margin, 1);
  side(to.y, rect.bottom() + margin, -1);
  if (object.before_near) return;
  std::array<double, 4> near = to.z;
  near[3] -= to.near;
  Add(near);
}

void TileFrustum::Add(const std::array<double, 4>& row) {
  const double length = RowLength(row);
  if (!(length > 0)) return;  // a flattened object: this side says nothing
  const double scale = 1 / length;
  planes_[count_++] = {Vec3(row[0], row[1], row[2]) * scale, row[3] * scale};
}

bool TileFrustum::MayTouch(const Vec3& a, const Vec3& b, const Vec3& c,
                           const StreamReach& reach) const {
  for (int i = 0; i < count_; ++i) {
    const Vec3& n = planes_[i].normal;
    const double nearest = std::max(std::max(glm::dot(n, a), glm::dot(n, b)), glm::dot(n, c));
    if (nearest + planes_[i].distance < -reach.Towards(n)) return false;
  }
  return true;
}

TileLists BinRoots(const TileRect& region, int32_t tile_width, int32_t tile_height,
                   std::span<const CullObject> objects) {
  const std::vector<int32_t> columns = Edges(region.x, region.right(), tile_width);
  const std::vector<int32_t> rows = Edges(region.y, region.bottom(), tile_height);
  TileLists lists;
  for (size_t r = 0; r + 1 < rows.size(); ++r) {
    for (size_t c = 0; c + 1 < columns.size(); ++c) {
      lists.tiles.push_back(
          {columns[c], rows[r], columns[c + 1] - columns[c], rows[r + 1] - rows[r]});
    }
  }
  lists.busy.assign(lists.tiles.size(), TileRect{});
  struct Touch {
    RootRef ref;
    Span across, down;
    double distance;
  };
  std::vector<Touch> touches;
  std::vector<uint32_t> count(lists.tiles.size() + 1, 0);
  const auto width = static_cast<int32_t>(columns.size()) - 1;
  for (size_t o = 0; o < objects.size(); ++o) {
    const CullObject& object = objects[o];
    const double near_length = RowLength(object.to.z);
    const size_t first_of_object = touches.size();
    for (size_t root = 0; root < object.prepared->RootCount(); ++root) {
      const Ball ball = object.prepared->Bound(root);
      const double distance = Row(object.to.z, ball.center);
      const bool before = distance + near_length * ball.radius < object.to.near;
      if (before && !object.before_near) continue;
      const double margin = kMargin + object.spread;
      Range range = BallRange(object.to, object.to.x, ball, margin);
      // What lies left of a tile lies in one further left.
      if (object.open == OpenSide::kLeft) range.high = std::numeric_limits<double>::infinity();
      if (object.open == OpenSide::kRight) range.low = -std::numeric_limits<double>::infinity();
      const Range down_range = BallRange(object.to, object.to.y, ball, margin);
      const Span across = TilesOf(range, columns);
      const Span down = TilesOf(down_range, rows);
      if (across.first > across.last || down.first > down.last) continue;
      touches.push_back(
          {{static_cast<uint32_t>(o), static_cast<uint32_t>(root)}, across, down, distance});
      for (int32_t r = down.first; r <= down.last; ++r) {
        for (int32_t c = across.first; c <= across.last; ++c) {
          const int32_t tile = r * width + c;
          ++count[tile + 1];
          Occupy(down_range, lists.tiles[tile], &lists.busy[tile]);
        }
      }
    }
    std::sort(touches.begin() + static_cast<std::ptrdiff_t>(first_of_object), touches.end(),
              [](const Touch& a, const Touch& b) {
                return a.distance != b.distance ? a.distance < b.distance : a.ref.root < b.ref.root;
              });
  }
  for (size_t i = 1; i < count.size(); ++i) count[i] += count[i - 1];
  lists.start = count;
  lists.refs.resize(count.back());
  for (const Touch& touch : touches) {
    for (int32_t r = touch.down.first; r <= touch.down.last; ++r) {
      for (int32_t c = touch.across.first; c <= touch.across.last; ++c) {
        lists.refs[count[r * width + c]++] = touch.ref;
      }
    }
  }
  return lists;
}

}  // namespace fjord
