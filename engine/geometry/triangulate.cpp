#include "engine/geometry/triangulate.h"

#include <algorithm>
#include <cstddef>

#include "engine/geometry/normals.h"

namespace fjord {
namespace {

// A folded polygon can make every round of the ear search fail; past this many steps ears are cut
// without looking, so the work always ends soon.
constexpr size_t kStepsPerCorner = 256;
constexpr size_t kLeastSteps = 1'000'000;

void Emit(uint32_t a, uint32_t b, uint32_t c, std::vector<Triangle>* triangles) {
  Triangle t = {a, b, c};
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  triangles->push_back(t);
}

// Twice the area of a, b, c: positive when they turn left.
double Turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The polygon in the plane of its two larger extents, such that its area is positive.
std::vector<Vec2> Flatten(std::span<const Vec3> points, std::span<const uint32_t> polygon,
                          const Vec3& area) {
  const double x = area.x < 0 ? -area.x : area.x;
  const double y = area.y < 0 ? -area.y : area.y;
  const double z = area.z < 0 ? -area.z : area.z;
  std::vector<Vec2> flat;
  flat.reserve(polygon.size());
  for (const uint32_t v : polygon) {
    const Vec3& p = points[v];
    if (z >= x && z >= y) {
      flat.push_back(area.z < 0 ? Vec2(p.y, p.x) : Vec2(p.x, p.y));
    } else if (y >= x) {
      flat.push_back(area.y < 0 ? Vec2(p.x, p.z) : Vec2(p.z, p.x));
    } else {
      flat.push_back(area.x < 0 ? Vec2(p.z, p.y) : Vec2(p.y, p.z));
    }
  }
  return flat;
}

// Every corner turns left, and the outline goes round once.
bool IsStrictlyConvex(const std::vector<Vec2>& p) {
  const size_t n = p.size();
  size_t turns_back = 0;  // changes of direction along x
  bool rising = p[0].x > p[n - 1].x;
  for (size_t i = 0; i < n; ++i) {
    const Vec2& next = p[(i + 1) % n];
    if (!(Turn(p[(i + n - 1) % n], p[i], next) > 0)) return false;
    if (next.x != p[i].x && (next.x > p[i].x) != rising) {
      rising = !rising;
      ++turns_back;
    }
  }
  return turns_back <= 2;
}

class EarCutter {
 public:
  EarCutter(std::vector<Vec2> flat, std::span<const uint32_t> polygon)
      : p_(std::move(flat)), polygon_(polygon), corners_(p_.size()) {
    const auto n = static_cast<uint32_t>(p_.size());
    budget_ = std::max(kLeastSteps, kStepsPerCorner * n);
    for (uint32_t i = 0; i < n; ++i) corners_[i] = {(i + n - 1) % n, (i + 1) % n, false, false};
    for (uint32_t i = 0; i < n; ++i) {
      corners_[i].reflex = !(TurnAt(i) > 0);
      if (corners_[i].reflex) blockers_.push_back(i);
    }
    std::sort(blockers_.begin(), blockers_.end(), [this](uint32_t l, uint32_t r) {
      return p_[l].x != p_[r].x ? p_[l].x < p_[r].x : l < r;
    });
    live_blockers_ = blockers_.size();
  }

  void Run(std::vector<Triangle>* triangles) {
    uint32_t at = 0;
    size_t left = p_.size();
    size_t tried = 0;  // corners looked at since the last cut
    while (left > 3) {
      const bool blind = budget_ == 0 || tried > 2 * left;
      const bool lenient = blind || tried > left;  // a round without an ear: it is not simple
      if (blind || (TurnAt(at) > 0 && (lenient || IsEar(at)))) {
        Cut(at, triangles);
        --left;
        tried = 0;
        at = corners_[corners_[at].next].next;  // skip one: fewer slivers
      } else {
        if (budget_ > 0) --budget_;
        ++tried;
        at = corners_[at].next;
      }
    }
    Emit(polygon_[corners_[at].previous], polygon_[at], polygon_[corners_[at].next], triangles);
  }

 private:
  struct Corner {
    uint32_t previous;
    uint32_t next;
    bool reflex;  // turns right or not at all
    bool cut;
  };

  double TurnAt(uint32_t i) const {
    return Turn(p_[corners_[i].previous], p_[i], p_[corners_[i].next]);
  }

  void Cut(uint32_t i, std::vector<Triangle>* triangles) {
    const Corner c = corners_[i];
    Emit(polygon_[c.previous], polygon_[i], polygon_[c.next], triangles);
    if (corners_[i].reflex) --live_blockers_;
    corners_[i].cut = true;
    corners_[c.previous].next = c.next;
    corners_[c.next].previous = c.previous;
    for (const uint32_t side : {c.previous, c.next}) {
      if (corners_[side].reflex && TurnAt(side) > 0) {
        corners_[side].reflex = false;
        --live_blockers_;
      }
    }
    if (blockers_.size() > 32 && live_blockers_ * 2 < blockers_.size()) {
      std::erase_if(blockers_,
                    [this](uint32_t b) { return corners_[b].cut || !corners_[b].reflex; });
    }
  }

  // No corner that turns right lies in the triangle or on its sides; those at its corners' places
  // do not count (an outline may touch itself in a point).
  bool IsEar(uint32_t i) {
    const Vec2& a = p_[corners_[i].previous];
    const Vec2& b = p_[i];
    const Vec2& c = p_[corners_[i].next];
    const double low_x = std::min({a.x, b.x, c.x}), high_x = std::max({a.x, b.x, c.x});
    const double low_y = std::min({a.y, b.y, c.y}), high_y = std::max({a.y, b.y, c.y});
    auto at = std::lower_bound(blockers_.begin(), blockers_.end(), low_x,
                               [this](uint32_t l, double x) { return p_[l].x < x; });
    for (; at != blockers_.end() && p_[*at].x <= high_x; ++at) {
      if (budget_ > 0) --budget_;
      const Corner& q = corners_[*at];
      const Vec2& p = p_[*at];
      if (q.cut || !q.reflex || p.y < low_y || p.y > high_y) continue;
      if (p == a || p == b || p == c) continue;
      if (Turn(a, b, p) >= 0 && Turn(b, c, p) >= 0 && Turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  std::vector<Vec2> p_;
  std::span<const uint32_t> polygon_;
  std::vector<Corner> corners_;
  std::vector<uint32_t> blockers_;  // reflex corners by x, with some that are so no more
  size_t live_blockers_ = 0;
  size_t budget_ = 0;
};

}  // namespace

void TriangulatePolygon(std::span<const Vec3> points, std::span<const uint32_t> polygon,
                        std::vector<Triangle>* triangles) {
  const size_t n = polygon.size();
  if (n < 3) return;
  if (n == 3) return Emit(polygon[0], polygon[1], polygon[2], triangles);
  std::vector<uint32_t> turned(polygon.begin(), polygon.end());
  std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end()), turned.end());
  std::vector<Vec2> flat = Flatten(points, turned, AreaVector(points, turned));
  if (IsStrictlyConvex(flat)) {
    for (size_t k = 1; k + 1 < n; ++k) Emit(turned[0], turned[k], turned[k + 1], triangles);
    return;
  }
  EarCutter(std::move(flat), turned).Run(triangles);
}

std::vector<Triangle> Triangulate(std::span<const Vec3> points, std::span<const uint32_t> face_size,
                                  std::span<const uint32_t> face_vertex) {
  std::vector<Triangle> triangles;
  triangles.reserve(face_vertex.size());
  size_t begin = 0;
  for (const uint32_t size : face_size) {
    TriangulatePolygon(points, face_vertex.subspan(begin, size), &triangles);
    begin += size;
  }
  return triangles;
}

std::vector<Triangle> Triangulate(const Mesh& mesh) {
  return Triangulate(mesh.points, mesh.face_size, mesh.face_vertex);
}

}  // namespace fjord
