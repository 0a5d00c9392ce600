#include "engine/geometry/paired_triangles.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/geometry/edges.h"
#include "engine/geometry/triangulate.h"

namespace fjord {
namespace {

constexpr double kSamePlane = 1e-6;  // between unit normals
constexpr double kNoArea = 1e-12;    // of a squared length

}  // namespace

PairedTriangles::PairedTriangles(const Mesh& mesh) : points_(mesh.points), colors_(mesh.colors) {
  const std::vector<Triangle> triangles = Triangulate(mesh);
  for (const Triangle& t : triangles) corners_.insert(corners_.end(), t.begin(), t.end());
  FindTwins(triangles);
  plane_.resize(triangles.size());
  FindPlanes();
}

Mesh PairedTriangles::Take() {
  Mesh mesh;
  mesh.points = std::move(points_);
  mesh.colors = std::move(colors_);
  mesh.face_size.assign(plane_.size(), 3);
  for (auto first = corners_.begin(); first != corners_.end(); first += 3) {
    std::rotate(first, std::min_element(first, first + 3), first + 3);
  }
  mesh.face_vertex = std::move(corners_);
  return mesh;
}

void PairedTriangles::FindTwins(const std::vector<Triangle>& triangles) {
  twin_.assign(corners_.size(), kNone);
  shared_.assign(corners_.size(), false);
  const EdgeTable table(triangles);
  for (const Edge& edge : table.edges()) {
    const auto uses = table.Uses(edge);
    if (uses.size() == 2 && uses[0].forward != uses[1].forward) {
      twin_[uses[0].corner] = uses[1].corner;
      twin_[uses[1].corner] = uses[0].corner;
    } else if (uses.size() > 1) {
      for (const EdgeUse& use : uses) shared_[use.corner] = true;
    }
  }
}

// Triangles that lie in one plane with a neighbour have that plane. One without an area goes with
// the neighbour at its longest edge. The largest triangle says which way a plane faces.
void PairedTriangles::FindPlanes() {
  std::iota(plane_.begin(), plane_.end(), 0u);
  const auto root = [this](uint32_t t) {
    while (plane_[t] != t) t = plane_[t] = plane_[plane_[t]];
    return t;
  };
  std::vector<Vec3> normal;
  std::vector<double> area;
  for (uint32_t t = 0; t < TriangleCount(); ++t) {
    const Vec3 cross = glm::cross(To(3 * t) - From(3 * t), Apex(3 * t) - From(3 * t));
    area.push_back(Length(cross));
    const bool sound = area[t] > kNoArea * Length2(LongestOf(t));
    normal.push_back(sound ? cross / area[t] : Vec3(0));
  }
  for (uint32_t h = 0; h < EdgeCount(); ++h) {
    if (twin_[h] == kNone) continue;
    const uint32_t t = h / 3, u = twin_[h] / 3;
    const bool flat = normal[u] != Vec3(0) && Length(normal[t] - normal[u]) < kSamePlane;
    if (normal[t] == Vec3(0) ? LongestOf(t) == h : flat) plane_[root(t)] = root(u);
  }
  normal_.assign(plane_.size(), Vec3(0));
  std::vector<double> largest(plane_.size(), -1);
  for (uint32_t t = 0; t < TriangleCount(); ++t) {
    plane_[t] = root(t);
    if (area[t] <= largest[plane_[t]]) continue;
    largest[plane_[t]] = area[t];
    normal_[plane_[t]] = normal[t];
  }
}

bool PairedTriangles::IsLonger(uint32_t g, uint32_t h) const {
  const double a = Length2(g), b = Length2(h);
  if (a != b) return a > b;
  return std::minmax(corners_[g], corners_[Next(g)]) < std::minmax(corners_[h], corners_[Next(h)]);
}

uint32_t PairedTriangles::LongestOf(uint32_t triangle) const {
  uint32_t longest = 3 * triangle;
  for (const uint32_t h : {longest + 1, longest + 2}) longest = IsLonger(h, longest) ? h : longest;
  return longest;
}

// Goes round the apex of h, one way to a border or all round, then the other way.
bool PairedTriangles::HasEdgeFromApex(uint32_t h, uint32_t vertex) const {
  const uint32_t start = Before(h);
  uint32_t leaving = start;
  do {
    if (corners_[Next(leaving)] == vertex || corners_[Before(leaving)] == vertex) return true;
    leaving = twin_[Before(leaving)];
  } while (leaving != kNone && leaving != start);
  if (leaving == start) return false;
  for (uint32_t coming = twin_[start]; coming != kNone; coming = twin_[Next(coming)]) {
    if (corners_[Before(coming)] == vertex) return true;
  }
  return false;
}

bool PairedTriangles::CanTurn(uint32_t h) const {
  const uint32_t t = h / 3;
  const Vec3 &a = From(h), &b = To(h), &c = Apex(h), &d = Apex(twin_[h]);
  const double least = kNoArea * glm::dot(c - d, c - d);
  return Area(t, a, d, c) > least && Area(t, d, b, c) > least &&
         !HasEdgeFromApex(h, corners_[Before(twin_[h])]);
}

void PairedTriangles::Join(uint32_t h, uint32_t twin) {
  twin_[h] = twin;
  if (twin != kNone) twin_[twin] = h;
}

// h: (a, b, c) becomes (a, d, c), g: (b, a, d) becomes (b, c, d).
std::array<uint32_t, 4> PairedTriangles::Turn(uint32_t h) {
  const uint32_t g = twin_[h], h_next = Next(h), g_next = Next(g);
  const uint32_t bc = twin_[h_next], ad = twin_[g_next];
  corners_[h_next] = corners_[Before(g)];
  corners_[g_next] = corners_[Before(h)];
  Join(h, ad);
  Join(g, bc);
  Join(h_next, g_next);
  shared_[h] = shared_[g_next];
  shared_[g] = shared_[h_next];
  shared_[h_next] = shared_[g_next] = false;
  return {h, Before(h), g, Before(g)};
}

// (a, b, c) becomes (a, m, c), in its place, and (m, b, c), new, whose edge m-b is returned.
uint32_t PairedTriangles::HalveSide(uint32_t h, uint32_t middle) {
  const uint32_t next = Next(h), made = EdgeCount();
  for (const uint32_t v : {middle, corners_[next], corners_[Before(h)]}) corners_.push_back(v);
  twin_.resize(corners_.size(), kNone);
  shared_.resize(corners_.size(), false);
  plane_.push_back(plane_[h / 3]);
  Join(made + 1, twin_[next]);
  shared_[made + 1] = shared_[next];
  corners_[next] = middle;
  Join(next, made + 2);
  shared_[next] = false;
  return made;
}

std::vector<uint32_t> PairedTriangles::Halve(uint32_t h) {
  const uint32_t a = corners_[h], b = corners_[Next(h)], g = twin_[h];
  const auto middle = static_cast<uint32_t>(points_.size());
  points_.push_back((points_[a] + points_[b]) * .5);
  if (!colors_.empty()) colors_.push_back((colors_[a] + colors_[b]) * .5f);
  const uint32_t beyond = HalveSide(h, middle);  // m-b
  if (g == kNone) return {Before(h), beyond + 1};
  const uint32_t back = HalveSide(g, middle);  // m-a
  Join(h, back);
  Join(g, beyond);
  return {Before(h), beyond + 1, Before(g), back + 1};
}

}  // namespace fjord
