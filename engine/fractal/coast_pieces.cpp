#include "engine/fractal/coast_pieces.h"

#include <cmath>
#include <optional>
#include <string>

#include "engine/geometry/edges.h"
#include "engine/geometry/normals.h"

namespace fjord {
namespace {

bool IsFinite(const Vec3& v) {
  const double sum = (v.x - v.x) + (v.y - v.y) + (v.z - v.z);  // NaN for infinities too
  return sum == 0;
}

std::optional<Error> FindFault(const CoarseShape& shape) {
  const size_t count = shape.now.size();
  if (shape.curve || shape.triangles.empty()) {
    return Invalid("coast takes a mesh of triangles");
  }
  if (shape.rest.size() != count || (!shape.colors.empty() && shape.colors.size() != count)) {
    return Invalid("the mesh's points, rest points and colours differ in number");
  }
  for (size_t i = 0; i < count; ++i) {
    if (!IsFinite(shape.now[i]) || !IsFinite(shape.rest[i])) {
      return Invalid("point " + std::to_string(i + 1) + " of the mesh is not finite");
    }
  }
  for (size_t t = 0; t < shape.triangles.size(); ++t) {
    for (const uint32_t v : shape.triangles[t]) {
      if (v >= count) {
        return Invalid("triangle " + std::to_string(t + 1) + " names point " +
                       std::to_string(uint64_t{v} + 1) + " of " + std::to_string(count));
      }
    }
  }
  return std::nullopt;
}

Vec3 TriangleNormal(const Vec3& a, const Vec3& b, const Vec3& c) {
  return Unit(glm::cross(b - a, c - a), Vec3(0, 0, 1));
}

// The cut's own vertex: the mean of three, symmetric in them.
CoastVertex Centroid(std::span<const CoastVertex, 3> c) {
  const auto third = [](auto a, auto b, auto d) { return (a + b + d) / 3.0; };
  CoastVertex v;
  const Identity a = c[0].line.id;
  const Identity b = c[1].line.id;
  const Identity d = c[2].line.id;
  v.line.id = {Mix64(a.lo + b.lo + d.lo + 3), Mix64((a.hi + b.hi + d.hi) ^ 3)};
  v.line.position = third(c[0].line.position, c[1].line.position, c[2].line.position);
  v.line.stretch = static_cast<float>(third(static_cast<double>(c[0].line.stretch),
                                            static_cast<double>(c[1].line.stretch),
                                            static_cast<double>(c[2].line.stretch)));
  v.line.eye_distance2 =
      third(c[0].line.eye_distance2, c[1].line.eye_distance2, c[2].line.eye_distance2);
  v.line.place = third(c[0].line.place, c[1].line.place, c[2].line.place);
  v.normal = Unit(c[0].normal + c[1].normal + c[2].normal, c[0].normal);
  return v;
}

}  // namespace

std::vector<CoastPiece> MakePieces(std::span<const CoastVertex, 3> corners,
                                   std::span<const double, 3> border_rest2) {
  const Vec3 plane =
      TriangleNormal(corners[0].line.position, corners[1].line.position, corners[2].line.position);
  size_t borders = 0;
  size_t first = 0;  // corner where the one border edge starts
  for (size_t k = 0; k < 3; ++k) {
    if (border_rest2[k] >= 0) {
      ++borders;
      first = k;
    }
  }
  const auto piece = [&](size_t k, const CoastVertex& apex) {
    CoastPiece p{corners[k], corners[(k + 1) % 3], apex, border_rest2[k] >= 0, {}, border_rest2[k]};
    const Vec3 along = p.e.line.position - p.s.line.position;
    p.frame = {plane, RightNormal(along, plane)};
    for (CoastVertex* end : {&p.s, &p.e}) {
      // Into this triangle's plane, so that all that grows from the edge stays in it.
      const Vec3 d = end->line.direction;
      end->line.direction = Softened(d - plane * glm::dot(d, plane));
    }
    return p;
  };
  if (borders <= 1) {
    return {piece(first, corners[(first + 2) % 3])};
  }
  const CoastVertex centroid = Centroid(corners);
  return {piece(0, centroid), piece(1, centroid), piece(2, centroid)};
}

std::vector<CoastPiece> CoastMesh::Pieces(size_t triangle) const {
  const Triangle& t = triangles[triangle];
  CoastVertex corners[3] = {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
  for (int k = 0; k < 3; ++k) corners[k].line.place = Weights(k == 0, k == 1, k == 2);
  const std::span<const double> rest2(border_rest2);
  return MakePieces(corners, rest2.subspan(3 * triangle).first<3>());
}

Result<CoastMesh> MakeCoastMesh(const CoarseShape& shape, const FractalSettings& settings) {
  if (const std::optional<Error> fault = FindFault(shape)) {
    return *fault;
  }
  CoastMesh mesh;
  mesh.triangles = shape.triangles;
  mesh.colors = shape.colors;
  mesh.border_rest2.assign(3 * shape.triangles.size(), -1);
  const size_t count = shape.now.size();
  const std::vector<Vec3> normals = VertexNormals(shape.now, shape.triangles);
  std::vector<Vec3> outward(count, Vec3(0));
  std::vector<double> stretch(count, 0);
  std::vector<uint32_t> stretched(count, 0);
  std::vector<uint8_t> coast(count, 0);
  const EdgeTable table(shape.triangles);
  for (const Edge& edge : table.edges()) {  // sorted: the file's order of triangles does not matter
    const EdgeUse& use = table.Uses(edge)[0];
    const Vec3 now = shape.now[edge.b] - shape.now[edge.a];
    const Vec3 rest = shape.rest[edge.b] - shape.rest[edge.a];
    const double rest2 = glm::dot(rest, rest);
    const bool border = edge.use_count == 1;
    const Triangle& t = shape.triangles[use.face];
    const Vec3 plane = TriangleNormal(shape.now[t[0]], shape.now[t[1]], shape.now[t[2]]);
    const Vec3 right = RightNormal(use.forward ? now : now * -1.0, plane);
    for (const uint32_t v : {edge.a, edge.b}) {
      if (rest2 > 0) {
        stretch[v] += std::sqrt(glm::dot(now, now) / rest2);
        ++stretched[v];
      }
      if (border) {
        outward[v] += right;
        coast[v] = 1;
      }
    }
    if (border) {
      mesh.border_rest2[use.corner] = rest2;
    }
  }
  for (size_t i = 0; i < count; ++i) {
    CoastVertex v;
    v.line.position = shape.now[i];
    v.line.id = CoarseIdentity(settings.seed, i);
    v.line.direction = Softened(outward[i] * .5);
    v.line.stretch = StretchOf(stretch[i], stretched[i]);
    const Vec3 eye = shape.rest[i] - settings.fineness.eye;
    v.line.eye_distance2 = glm::dot(eye, eye);
    v.normal = normals[i];
    v.coast = coast[i] != 0;
    mesh.vertices.push_back(v);
  }
  return mesh;
}

}  // namespace fjord
