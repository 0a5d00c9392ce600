#include "engine/geometry/normals.h"

#include <algorithm>
#include <cstddef>

namespace fjord {
namespace {

const Vec3 kUp(0, 0, 1);

// Faces as one list of corners, each face turned so that its smallest vertex comes first.
struct TurnedFaces {
  std::vector<uint32_t> corner;
  std::vector<size_t> begin;  // one more than there are faces

  std::span<const uint32_t> Face(size_t f) const {
    return std::span<const uint32_t>(corner).subspan(begin[f], begin[f + 1] - begin[f]);
  }
  size_t size() const { return begin.size() - 1; }
};

std::vector<Vec3> Sum(std::span<const Vec3> points, const TurnedFaces& faces) {
  // Lists of the faces of each vertex, by counting.
  std::vector<size_t> begin(points.size() + 1, 0);
  for (const uint32_t v : faces.corner) ++begin[v + 1];
  for (size_t v = 0; v < points.size(); ++v) begin[v + 1] += begin[v];
  std::vector<uint32_t> list(faces.corner.size());
  std::vector<size_t> next(begin.begin(), begin.end() - 1);
  for (size_t f = 0; f < faces.size(); ++f) {
    for (const uint32_t v : faces.Face(f)) list[next[v]++] = static_cast<uint32_t>(f);
  }
  std::vector<Vec3> area(faces.size());
  for (size_t f = 0; f < faces.size(); ++f) area[f] = AreaVector(points, faces.Face(f));

  std::vector<Vec3> normals(points.size());
  for (size_t v = 0; v < points.size(); ++v) {
    const auto first = list.begin() + static_cast<std::ptrdiff_t>(begin[v]);
    const auto last = list.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]);
    // Faces with the same vertices have the same area vector, so their order is free.
    std::sort(first, last, [&](uint32_t l, uint32_t r) {
      const auto a = faces.Face(l), b = faces.Face(r);
      return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    });
    Vec3 sum(0);
    for (auto f = first; f != last; ++f) sum += area[*f];
    normals[v] = Unit(sum, kUp);
  }
  return normals;
}

}  // namespace

Vec3 AreaVector(std::span<const Vec3> points, std::span<const uint32_t> polygon) {
  const size_t n = polygon.size();
  if (n < 3) return Vec3(0);
  const size_t s =
      static_cast<size_t>(std::min_element(polygon.begin(), polygon.end()) - polygon.begin());
  const Vec3& origin = points[polygon[s]];
  Vec3 sum(0);
  for (size_t k = 1; k + 1 < n; ++k) {
    sum += glm::cross(points[polygon[(s + k) % n]] - origin,
                      points[polygon[(s + k + 1) % n]] - origin);
  }
  return sum;
}

std::vector<Vec3> VertexNormals(std::span<const Vec3> points, std::span<const Triangle> triangles) {
  TurnedFaces faces;
  faces.corner.reserve(triangles.size() * 3);
  faces.begin.reserve(triangles.size() + 1);
  faces.begin.push_back(0);
  for (Triangle t : triangles) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    faces.corner.insert(faces.corner.end(), t.begin(), t.end());
    faces.begin.push_back(faces.corner.size());
  }
  return Sum(points, faces);
}

std::vector<Vec3> VertexNormals(const Mesh& mesh) {
  TurnedFaces faces;
  faces.corner = mesh.face_vertex;
  faces.begin.reserve(mesh.FaceCount() + 1);
  faces.begin.push_back(0);
  for (const uint32_t size : mesh.face_size) {
    const auto first = faces.corner.begin() + static_cast<std::ptrdiff_t>(faces.begin.back());
    const auto last = first + size;
    std::rotate(first, std::min_element(first, last), last);
    faces.begin.push_back(faces.begin.back() + size);
  }
  return Sum(mesh.points, faces);
}

}  // namespace fjord
