#include "engine/render/raster.h"

#include <algorithm>
#include <cmath>

#include "engine/base/clamp.h"
#include "engine/render/clip.h"
#include "engine/render/integer.h"
#include "engine/render/raster_medium.h"
#include "engine/render/raster_source.h"
#include "engine/render/triangle_setup.h"

namespace fjord {
namespace {

// Edge p -> q of a triangle turned so that its inside is >= 0. Guarded coordinates keep every
// product below 2^62.
struct Edge {
  int64_t a, b, value;  // a x + b y + value; the top-left rule is in value

  Edge(const ScreenPoint& p, const ScreenPoint& q)
      : a(int64_t{p.y} - q.y), b(int64_t{q.x} - p.x), value(-(a * p.x + b * p.y)) {
    if (!(a > 0 || (a == 0 && b > 0))) value -= 1;
  }

  // Narrows first..last (pixels) to those whose sample at (256 x + offset, y) is inside.
  void Narrow(int64_t offset, int64_t y, int64_t* first, int64_t* last) const {
    const int64_t at_zero = a * offset + b * y + value;
    if (a > 0) {
      *first = std::max(*first, -FloorDivide(at_zero, a * kFixedOne));
    } else if (a < 0) {
      *last = std::min(*last, FloorDivide(at_zero, -a * kFixedOne));
    } else if (at_zero < 0) {
      *last = *first - 1;
    }
  }
};

// Pixels first..last.
struct PixelRange {
  int32_t first, last;
};

// Triangles of any size, row by row: where a row of samples enters and leaves is found by division.
void FillSpans(const std::array<Edge, 3>& edges, const DepthPlane& plane, PixelRange columns,
               PixelRange rows, HitSource* source, TileBuffer* tile) {
  const std::span<const SamplePlace> places = tile->places();
  for (int32_t y = rows.first; y <= rows.last; ++y) {
    for (size_t s = 0; s < places.size(); ++s) {
      const int32_t sample_y = y * kFixedOne + places[s].y;
      int64_t first = columns.first, last = columns.last;
      for (const Edge& edge : edges) edge.Narrow(places[s].x, sample_y, &first, &last);
      if (first > last) continue;
      size_t index = tile->Index(static_cast<int32_t>(first), y, static_cast<int32_t>(s));
      for (int32_t x = static_cast<int32_t>(first); x <= last; ++x, index += places.size()) {
        const double depth = plane.At(x * kFixedOne + places[s].x, sample_y);
        double& there = tile->depth()[index];
        if (!(depth >= there)) continue;
        const HitRecord& record = source->record;
        if (depth == there && !tile->WinsTie(index, record.object, record.tie)) continue;
        there = depth;
        tile->hit()[index] = source->Get(tile);
      }
    }
  }
}

ClipCorner ToClipCorner(const Projection& to, const Corner& corner) {
  return {ToClip(to, corner.position), corner.position, corner.place};
}

}  // namespace

void Raster::StartObject(uint32_t object, const Projection& to, Keep keep, double line_width) {
  object_ = object;
  to_ = to;
  keep_ = keep;
  line_width_ = line_width;
}

Corner Raster::MakeCorner(const StreamBatch& batch, uint32_t vertex) const {
  Corner corner;
  corner.screen = projected_.At(vertex);
  corner.position = batch.vertices[vertex].position;
  if (keep_ == Keep::kPlaces) corner.place = batch.places[vertex];
  return corner;
}

HitRecord Raster::MakeRecord(const StreamBatch& batch, uint32_t a, uint32_t b, uint32_t c) const {
  const StreamVertex &va = batch.vertices[a], &vb = batch.vertices[b], &vc = batch.vertices[c];
  HitRecord record;
  record.normal = FacetNormal(va.position, vb.position, vc.position);
  record.object = object_;
  record.tie = va.id + vb.id + vc.id;
  return record;
}

void Raster::Draw(const StreamBatch& batch) {
  ProjectVertices(to_, batch.vertices, &projected_);
  for (size_t first = 0; first < batch.triangles.size(); first += kCoverageBlock) {
    DrawBlock(batch, first, std::min(kCoverageBlock, batch.triangles.size() - first));
  }
  if (line_width_ > 0) {
    for (const auto& segment : batch.segments) DrawStroke(batch, segment);
  }
  tile_->CompactIfLarge();
}

size_t Raster::Bytes() const {
  return projected_.xy.capacity() * 4 + projected_.depth.capacity() * 8 + coverage_.Bytes();
}

void Raster::DrawWhole(const StreamBatch& batch, const Triangle& triangle) {
  const int lead = LeadingCorner(projected_.At(triangle[0]), projected_.At(triangle[1]),
                                 projected_.At(triangle[2]));
  const uint32_t a = triangle[lead];
  const uint32_t b = triangle[(lead + 1) % 3];
  const uint32_t c = triangle[(lead + 2) % 3];
  Fill(MakeCorner(batch, a), MakeCorner(batch, b), MakeCorner(batch, c), batch.element,
       MakeRecord(batch, a, b, c));
}

void Raster::DrawClipped(const StreamBatch& batch, const Triangle& triangle) {
  // The corner that leads must not depend on how the triangle was handed over.
  const auto before = [&](uint32_t i, uint32_t j) {
    const Vec3 &p = batch.vertices[i].position, &q = batch.vertices[j].position;
    if (p.x != q.x) return p.x < q.x;
    if (p.y != q.y) return p.y < q.y;
    return p.z < q.z;
  };
  const int lead = before(triangle[0], triangle[1]) ? (before(triangle[0], triangle[2]) ? 0 : 2)
                                                    : (before(triangle[1], triangle[2]) ? 1 : 2);
  ClipPolygon polygon;
  polygon.size = 3;
  for (int i = 0; i < 3; ++i) {
    polygon.corner[i] = ToClipCorner(to_, MakeCorner(batch, triangle[(lead + i) % 3]));
  }
  ClipToView(to_, &polygon);
  if (polygon.size < 3) return;
  const HitRecord record =
      MakeRecord(batch, triangle[lead], triangle[(lead + 1) % 3], triangle[(lead + 2) % 3]);
  std::array<Corner, 8> corners;
  for (size_t i = 0; i < polygon.size; ++i) {
    const ClipCorner& from = polygon.corner[i];
    corners[i] = {ToScreen(to_, from.clip), from.position, from.place};
  }
  for (size_t i = 2; i < polygon.size; ++i) {
    const Corner* t[3] = {&corners[0], &corners[i - 1], &corners[i]};
    const int first = LeadingCorner(t[0]->screen, t[1]->screen, t[2]->screen);
    Fill(*t[first], *t[(first + 1) % 3], *t[(first + 2) % 3], batch.element, record);
  }
}

void Raster::DrawStroke(const StreamBatch& batch, const std::array<uint32_t, 2>& segment) {
  ClipPolygon line;
  line.size = 2;
  for (int i = 0; i < 2; ++i) line.corner[i] = ToClipCorner(to_, MakeCorner(batch, segment[i]));
  ClipToView(to_, &line);
  if (line.size != 2) return;
  ScreenPoint end[2];
  double x[2], y[2];
  for (int i = 0; i < 2; ++i) {
    const ClipPoint& p = line.corner[i].clip;
    end[i] = ToScreen(to_, p);
    const double inverse = to_.orthographic ? 1 : 1 / p.z;
    x[i] = p.x * inverse;
    y[i] = p.y * inverse;
  }
  double along_x = x[1] - x[0], along_y = y[1] - y[0];
  const double length = std::sqrt(along_x * along_x + along_y * along_y);
  const double half = line_width_ * (kFixedOne * .5);
  along_x = length > 0 ? along_x / length * half : half;
  along_y = length > 0 ? along_y / length * half : 0;
  // Corners round the line, half a width past its ends.
  Corner corner[4];
  for (int i = 0; i < 4; ++i) {
    const int at = i == 0 || i == 3 ? 0 : 1;
    const double back = at == 0 ? -1 : 1;
    const double side = i < 2 ? -1 : 1;
    const double cx = x[at] + back * along_x - side * along_y;
    const double cy = y[at] + back * along_y + side * along_x;
    corner[i].screen = {
        FloorToInt32(std::min(std::max(cx, -double{kFixedGuard}), double{kFixedGuard}) + .5),
        FloorToInt32(std::min(std::max(cy, -double{kFixedGuard}), double{kFixedGuard}) + .5),
        end[at].depth};
    corner[i].position = line.corner[at].position;
    corner[i].place = line.corner[at].place;
  }
  HitRecord record;
  record.object = object_;
  record.tie = batch.vertices[segment[0]].id + batch.vertices[segment[1]].id;
  for (const auto& t : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
    const int first = LeadingCorner(corner[t[0]].screen, corner[t[1]].screen, corner[t[2]].screen);
    Fill(corner[t[first]], corner[t[(first + 1) % 3]], corner[t[(first + 2) % 3]], batch.element,
         record);
  }
}

void Raster::Fill(const Corner& a, const Corner& b, const Corner& c, uint32_t element,
                  const HitRecord& record) {
  const ScreenPoint &p = a.screen, &q = b.screen, &r = c.screen;
  const int64_t area =
      (int64_t{q.x} - p.x) * (int64_t{r.y} - p.y) - (int64_t{r.x} - p.x) * (int64_t{q.y} - p.y);
  if (area == 0) return;
  const auto [left, right] = std::minmax({p.x, q.x, r.x});
  const auto [top, bottom] = std::minmax({p.y, q.y, r.y});
  const TileRect& rect = tile_->rect();
  const PixelRange columns = {std::max(left >> 8, rect.x), std::min(right >> 8, rect.right() - 1)};
  const PixelRange rows = {std::max(top >> 8, rect.y), std::min(bottom >> 8, rect.bottom() - 1)};
  // Also: FillMedium's numbers are small only for triangles that touch the tile.
  if (columns.first > columns.last || rows.first > rows.last) return;
  const DepthPlane plane(p, q, r);
  HitSource source{record};
  if (keep_ == Keep::kDepth) source.hit = 0;
  if (keep_ == Keep::kPlaces) {
    source.has_corners = true;
    source.corners = MakeCornerPlaces(to_, element, a, b, c);
  }
  const ScreenPoint &second = area < 0 ? r : q, &third = area < 0 ? q : r;
  constexpr int32_t kMedium = kMediumPixels * kFixedOne;
  if (right - left < kMedium && bottom - top < kMedium && tile_->places().size() >= 4) {
    FillMedium(p, second, third, plane, &source, tile_);
    return;
  }
  FillSpans({Edge(p, second), Edge(second, third), Edge(third, p)}, plane, columns, rows, &source,
            tile_);
}

}  // namespace fjord
