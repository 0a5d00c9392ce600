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

// Little-endian values on their way to a file, gathered in a block first: appending every one of
// them to a string costs several times as much.
class LittleEndian {
 public:
  explicit LittleEndian(std::string* out) : out_(out) {}
  ~LittleEndian() { Flush(); }
  LittleEndian(const LittleEndian&) = delete;
  LittleEndian& operator=(const LittleEndian&) = delete;

  template <typename T>
  void Put(T value) {
    if (block_.size() - used_ < sizeof(T)) Flush();
    std::memcpy(&block_[used_], &value, sizeof(T));
    if constexpr (std::endian::native == std::endian::big) {
      std::reverse(&block_[used_], &block_[used_] + sizeof(T));
    }
    used_ += sizeof(T);
  }

 private:
  void Flush() {
    out_->append(block_.data(), used_);
    used_ = 0;
  }

  std::string* out_;
  std::array<char, 1 << 14> block_;
  size_t used_ = 0;
};

// The byte that reads back as exactly this colour, if there is one.
std::optional<uint8_t> AsByte(float channel) {
  if (!(channel >= 0 && channel <= 1)) return std::nullopt;
  const auto byte = static_cast<uint8_t>(RoundToUint32(channel * 255., 255));
  if (static_cast<float>(byte) / 255.f != channel) return std::nullopt;
  return byte;
}

// What the header announces.
struct Layout {
  bool colored = false;
  bool bytes = false;  // colours
  bool big = false;    // counts of face corners
  size_t mesh_points = 0;
};

void AppendBody(const ShapeFile& shape, const Layout& layout, std::string* out) {
  const Mesh& mesh = shape.mesh;
  LittleEndian to(out);
  const auto add_point = [&](const Vec3& p, const Rgb& color) {
    for (int k = 0; k < 3; ++k) to.Put(p[k]);
    for (int k = 0; layout.colored && k < 3; ++k) {
      if (layout.bytes) {
        to.Put(*AsByte(color[k]));
      } else {
        to.Put(color[k]);
      }
    }
  };
  for (size_t v = 0; v < layout.mesh_points; ++v) {
    add_point(mesh.points[v], layout.colored ? mesh.colors[v] : Rgb(1));
  }
  for (const Polyline& curve : shape.curves) {
    for (const Vec3& p : curve.points) add_point(p, Rgb(1));
  }
  const uint32_t* corner = mesh.face_vertex.data();
  for (const uint32_t size : mesh.face_size) {
    if (layout.big) {
      to.Put(size);
    } else {
      to.Put(static_cast<uint8_t>(size));
    }
    for (size_t k = 0; k < size; ++k) to.Put(*corner++);
  }
  auto first = static_cast<uint32_t>(layout.mesh_points);
  for (const Polyline& curve : shape.curves) {
    const auto n = static_cast<uint32_t>(curve.points.size());
    for (uint32_t k = 0; k + (curve.closed ? 0 : 1) < n; ++k) {
      to.Put(first + k);
      to.Put(first + (k + 1) % n);
    }
    first += n;
  }
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
  for (const std::string& line : comment)
    out.append("comment ").append(text::OneLine(line)).append("\n");
  out.append("element vertex ").append(std::to_string(points)).append("\n");
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

  const size_t color_bytes = colored ? 3 * (bytes ? sizeof(uint8_t) : sizeof(float)) : 0;
  out.reserve(out.size() + points * (3 * sizeof(double) + color_bytes) +
              mesh.FaceCount() * (big ? sizeof(uint32_t) : sizeof(uint8_t)) +
              (mesh.face_vertex.size() + 2 * edges) * sizeof(uint32_t));
  AppendBody(shape, {colored, bytes, big, mesh_points}, &out);
  return out;
}

}  // namespace fjord::formats
