#include "engine/render/clip.h"

#include <utility>

namespace fjord {
namespace {

// Signed distance of a kind: >= 0 is kept.
double Inside(const Projection& to, const ClipPoint& p, int plane) {
  // a whole pixel short of the guard, so that rounding stays within it
  constexpr double kLimit = kFixedGuard - kFixedOne;
  const double w = to.orthographic ? 1 : p.z;
  switch (plane) {
    case 0:
      return p.z - to.near;
    case 1:
      return p.x + kLimit * w;
    case 2:
      return kLimit * w - p.x;
    case 3:
      return p.y + kLimit * w;
    default:
      return kLimit * w - p.y;
  }
}

bool Before(const ClipPoint& a, const ClipPoint& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

ClipCorner Cut(const Projection& to, const ClipCorner& a, const ClipCorner& b, double inside_a,
               double inside_b, int plane) {
  if (Before(b.clip, a.clip)) return Cut(to, b, a, inside_b, inside_a, plane);
  const double t = inside_a / (inside_a - inside_b);
  ClipCorner cut;
  cut.clip.x = a.clip.x + (b.clip.x - a.clip.x) * t;
  cut.clip.y = a.clip.y + (b.clip.y - a.clip.y) * t;
  cut.clip.z = plane == 0 ? to.near : a.clip.z + (b.clip.z - a.clip.z) * t;
  cut.position = a.position + (b.position - a.position) * t;
  cut.place = a.place + (b.place - a.place) * t;
  return cut;
}

}  // namespace

void ClipToView(const Projection& to, ClipPolygon* polygon) {
  for (int plane = 0; plane < 5; ++plane) {
    const ClipPolygon whole = *polygon;
    const bool segment = whole.size == 2;
    polygon->size = 0;
    for (size_t i = 0; i < whole.size; ++i) {
      const ClipCorner& here = whole.corner[i];
      const ClipCorner& next = whole.corner[(i + 1) % whole.size];
      const double inside_here = Inside(to, here.clip, plane);
      const double inside_next = Inside(to, next.clip, plane);
      if (inside_here >= 0 && polygon->size < polygon->corner.size()) {
        polygon->corner[polygon->size++] = here;
      }
      const bool crosses = (inside_here >= 0) != (inside_next >= 0);
      if (segment && i == 1) continue;  // its one edge was walked already
      if (crosses && polygon->size < polygon->corner.size()) {
        polygon->corner[polygon->size++] = Cut(to, here, next, inside_here, inside_next, plane);
      }
    }
  }
}

}  // namespace fjord
