// Writing .ply: binary, little-endian, doubles; colours as bytes where bytes hold them exactly.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>

#include "engine/base/clamp.h"
#include "engine/formats/readers.h"
#include "engine/formats/text.h"

namespace fjord::formats {
namespace {

template <typename T>
void AppendLittle(T value, std::string* out) {
  std::array<char, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), &value, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
  out->append(bytes.data(), bytes.size());
}

// The byte that reads back as exactly this colour, if there is one.
std::optional<uint8_t> AsByte(float channel) {
  if (!(channel >= 0 && channel <= 1)) return std::nullopt;
  const auto byte = static_cast<uint8_t>(RoundToUint32(channel * 255., 255));
  if (static_cast<float>(byte) / 255.f != channel) return std::nullopt;
  return byte;
}

}  // namespace

std::string WritePly(const ShapeFile& shape, const Comment& comment) {
  const Mesh& mesh = shape.mesh;
  const bool faces = !mesh.face_size.empty();
  const bool colored = faces && !mesh.colors.empty();
  const bool bytes =
      colored && std::all_of(mesh.colors.begin(), mesh.colors.end(), [](const Rgb& c) {
        return AsByte(c.r) && AsByte(c.g) && AsByte(c.b);
      });
  const size_t mesh_points = faces ? mesh.points.size() : 0;
  size_t points = mesh_points, edges = 0;
  for (const Polyline& curve : shape.curves) {
    points += curve.points.size();
    edges += curve.points.size() - (curve.closed ? 0 : 1);
  }
  const bool big = !mesh.face_size.empty() &&
                   *std::max_element(mesh.face_size.begin(), mesh.face_size.end()) > 255;

  std::string out = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& line : comment) out += "comment " + text::OneLine(line) + '\n';
  out += "element vertex " + std::to_string(points) + '\n';
  for (const char* axis : {"x", "y", "z"}) out += std::string("property double ") + axis + '\n';
  for (const char* channel : {"red", "green", "blue"}) {
    if (colored) out += std::string("property ") + (bytes ? "uchar " : "float ") + channel + '\n';
  }
  if (faces) {
    out += "element face " + std::to_string(mesh.FaceCount()) + "\nproperty list " +
           (big ? "uint" : "uchar") + " uint vertex_indices\n";
  }
  if (edges > 0) {
    out += "element edge " + std::to_string(edges) +
           "\nproperty uint vertex1\nproperty uint vertex2\n";
  }
  out += "end_header\n";

  const auto add_point = [&](const Vec3& p, const Rgb& color) {
    for (int k = 0; k < 3; ++k) AppendLittle(p[k], &out);
    for (int k = 0; colored && k < 3; ++k) {
      if (bytes) {
        AppendLittle(*AsByte(color[k]), &out);
      } else {
        AppendLittle(color[k], &out);
      }
    }
  };
  for (size_t v = 0; v < mesh_points; ++v) {
    add_point(mesh.points[v], colored ? mesh.colors[v] : Rgb(1));
  }
  for (const Polyline& curve : shape.curves) {
    for (const Vec3& p : curve.points) add_point(p, Rgb(1));
  }
  size_t corner = 0;
  for (const uint32_t size : mesh.face_size) {
    if (big) {
      AppendLittle(size, &out);
    } else {
      AppendLittle(static_cast<uint8_t>(size), &out);
    }
    for (size_t k = 0; k < size; ++k) AppendLittle(mesh.face_vertex[corner++], &out);
  }
  auto first = static_cast<uint32_t>(mesh_points);
  for (const Polyline& curve : shape.curves) {
    const auto n = static_cast<uint32_t>(curve.points.size());
    for (uint32_t k = 0; k + (curve.closed ? 0 : 1) < n; ++k) {
      AppendLittle(first + k, &out);
      AppendLittle(first + (k + 1) % n, &out);
    }
    first += n;
  }
  return out;
}

}  // namespace fjord::formats
