#include "engine/fractal/measure.h"
#include "engine/geometry/normals.h"

namespace fjord {

double LineLength(const Polyline& line) {
  double length = 0;
  const size_t count = line.points.size();
  for (size_t i = 0; i + 1 < count; ++i) {
    length += Length(line.points[i + 1] - line.points[i]);
  }
  return line.closed && count > 1 ? length + Length(line.points[0] - line.points[count - 1])
                                  : length;
}

double LineArea(const Polyline& line) {
  double twice = 0;
  const size_t count = line.points.size();
  for (size_t i = 0; i < count; ++i) {
    const Vec3 a = line.points[i] - line.points[0];
    const Vec3 b = line.points[i + 1 < count ? i + 1 : 0] - line.points[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return .5 * twice;
}

double MeshArea(const Mesh& mesh) {
  double twice = 0;
  size_t corner = 0;
  const std::span<const uint32_t> corners(mesh.face_vertex);
  for (const uint32_t size : mesh.face_size) {
    twice += Length(AreaVector(mesh.points, corners.subspan(corner, size)));
    corner += size;
  }
  return .5 * twice;
}

double MeshVolume(const Mesh& mesh) {
  double six = 0;
  size_t corner = 0;
  for (const uint32_t size : mesh.face_size) {
    const Vec3 a = mesh.points[mesh.face_vertex[corner]] - mesh.points[0];
    for (uint32_t k = 1; k + 1 < size; ++k) {
      const Vec3 b = mesh.points[mesh.face_vertex[corner + k]] - mesh.points[0];
      const Vec3 c = mesh.points[mesh.face_vertex[corner + k + 1]] - mesh.points[0];
      six += glm::dot(a, glm::cross(b, c));
    }
    corner += size;
  }
  return six / 6;
}

}  // namespace fjord
