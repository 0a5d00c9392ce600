#include "engine/geometry/orientation.h"

#include <algorithm>
#include <cstddef>

#include "engine/geometry/normals.h"

namespace fjord {
namespace {

struct Link {
  uint32_t face;
  uint32_t edge;
  bool agrees;
};

// Neighbours over edges with two faces, as lists by counting.
struct Links {
  std::vector<size_t> begin;
  std::vector<Link> link;

  Links(const Mesh& mesh, const EdgeTable& table) : begin(mesh.FaceCount() + 1, 0) {
    for (const Edge& edge : table.edges()) {
      if (edge.use_count != 2) continue;
      for (const EdgeUse& use : table.Uses(edge)) ++begin[use.face + 1];
    }
    for (size_t f = 0; f + 1 < begin.size(); ++f) begin[f + 1] += begin[f];
    link.resize(begin.back());
    std::vector<size_t> next(begin.begin(), begin.end() - 1);
    for (uint32_t e = 0; e < table.edges().size(); ++e) {
      const Edge& edge = table.edges()[e];
      if (edge.use_count != 2) continue;
      const auto uses = table.Uses(edge);
      const bool agrees = uses[0].forward != uses[1].forward;
      link[next[uses[0].face]++] = {uses[1].face, e, agrees};
      link[next[uses[1].face]++] = {uses[0].face, e, agrees};
    }
  }
};

}  // namespace

std::vector<FlippedFace> FindFlippedFaces(const Mesh& mesh, const EdgeTable& table) {
  const Links links(mesh, table);
  constexpr uint8_t kUnseen = 2;
  std::vector<uint8_t> side(mesh.FaceCount(), kUnseen);
  std::vector<FlippedFace> flipped;
  std::vector<uint32_t> part;
  for (uint32_t start = 0; start < mesh.FaceCount(); ++start) {
    if (side[start] != kUnseen) continue;
    part.assign(1, start);
    side[start] = 0;
    size_t ones = 0;
    for (size_t i = 0; i < part.size(); ++i) {
      const uint32_t f = part[i];
      ones += side[f];
      for (size_t k = links.begin[f]; k < links.begin[f + 1]; ++k) {
        const Link& link = links.link[k];
        if (side[link.face] != kUnseen) continue;
        side[link.face] = static_cast<uint8_t>(side[f] ^ (link.agrees ? 0 : 1));
        part.push_back(link.face);
      }
    }
    const uint8_t wrong = ones * 2 > part.size() ? 0 : 1;
    for (const uint32_t f : part) {
      size_t best = SIZE_MAX;
      for (size_t k = links.begin[f]; k < links.begin[f + 1]; ++k) {
        const Link& link = links.link[k];
        if (link.agrees) continue;
        const bool between = side[f] == wrong && side[link.face] != wrong;
        const bool beyond_help = side[f] == side[link.face] && f > link.face;
        if ((between || beyond_help) && (best == SIZE_MAX || link.edge < links.link[best].edge)) {
          best = k;
        }
      }
      if (best != SIZE_MAX) {
        flipped.push_back({f, links.link[best].face, links.link[best].edge});
      } else if (side[f] == wrong) {
        flipped.push_back({f, f, EdgeTable::kNone});
      }
    }
  }
  std::sort(flipped.begin(), flipped.end(),
            [](const FlippedFace& l, const FlippedFace& r) { return l.face < r.face; });
  return flipped;
}

Facing FacingOf(const Mesh& mesh, const EdgeTable& table) {
  if (mesh.face_size.empty()) return Facing::kRight;
  bool closed = true;
  for (const Edge& edge : table.edges()) closed = closed && edge.use_count == 2;
  const Vec3 origin = mesh.points[mesh.face_vertex[0]];
  double volume = 0;  // six times
  bool up = false, down = false;
  size_t begin = 0;
  for (const uint32_t size : mesh.face_size) {
    const auto face = std::span<const uint32_t>(mesh.face_vertex).subspan(begin, size);
    begin += size;
    const Vec3 area = AreaVector(mesh.points, face);
    volume += glm::dot(area, mesh.points[face[0]] - origin);
    up = up || area.z > 0;
    down = down || area.z < 0;
  }
  if (closed) return volume < 0 ? Facing::kInward : Facing::kRight;
  return down && !up ? Facing::kDown : Facing::kRight;
}

void FlipMesh(Mesh* mesh) {
  size_t begin = 0;
  for (const uint32_t size : mesh->face_size) {
    const auto first = mesh->face_vertex.begin() + static_cast<std::ptrdiff_t>(begin);
    if (size > 1) std::reverse(first + 1, first + size);  // keeps the first corner
    begin += size;
  }
}

}  // namespace fjord
