// Reading .ply, ASCII and both binary forms. Elements: vertex (x y z, red green blue), face
// (vertex_indices or vertex_index), edge (vertex1 vertex2; chains become curves). Other elements
// and properties are passed over.
#include <algorithm>
#include <array>

#include "engine/base/clamp.h"
#include "engine/formats/limits.h"
#include "engine/formats/ply_body.h"
#include "engine/formats/ply_header.h"
#include "engine/formats/readers.h"
#include "engine/formats/text.h"
#include "engine/geometry/join_edges.h"

namespace fjord::formats {
namespace {

constexpr size_t kNone = SIZE_MAX;

size_t Find(const PlyElement& element, std::string_view name, bool list) {
  for (size_t i = 0; i < element.properties.size(); ++i) {
    if (element.properties[i].name == name && element.properties[i].list == list) return i;
  }
  return kNone;
}

// The value of this type that means 1. Of the wider whole numbers the files that are about hold
// bytes.
float ColorScale(PlyType type) {
  if (type == PlyType::kFloat || type == PlyType::kDouble) return 1;
  return type == PlyType::kUint16 ? 65535 : 255;
}

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& name, PlyHeader header)
      : header_(std::move(header)), body_(bytes, name, header_), name_(name) {}

  Result<ShapeFile> Read() {
    for (const PlyElement& element : header_.elements) {
      if (auto ok = ReadElement(element); !ok) return ok.error();
    }
    if (auto ok = body_.ExpectEnd(); !ok) return ok.error();
    return Finish();
  }

 private:
  Error Fail(const PlyElement& element, const std::string& message) const {
    return Invalid(message, {name_, element.line, 1});
  }

  Result<> ReadElement(const PlyElement& element) {
    if (element.properties.empty()) return Ok{};
    if (auto ok = body_.ExpectBytesFor(element); !ok) return ok.error();
    if (element.name == "vertex") return ReadVertices(element);
    if (element.name == "face") return ReadFaces(element);
    if (element.name == "edge") return ReadEdges(element);
    if (element.name == "tristrips" && element.count > 0) {
      return Fail(element, "triangle strips are not read; write the faces one by one");
    }
    for (uint64_t i = 0; i < element.count; ++i) {
      if (auto ok = body_.ReadRow(element, i); !ok) return ok.error();
    }
    return Ok{};
  }

  Result<> ReadVertices(const PlyElement& element) {
    const size_t x = Find(element, "x", false), y = Find(element, "y", false),
                 z = Find(element, "z", false);
    if (x == kNone || y == kNone || z == kNone) {
      return Fail(element, "element vertex needs the properties x, y and z");
    }
    if (element.count > limits::kVertices) return TooManyVertices({name_, element.line, 1});
    const std::array<size_t, 3> rgb = {Find(element, "red", false), Find(element, "green", false),
                                       Find(element, "blue", false)};
    const bool colored = rgb[0] != kNone && rgb[1] != kNone && rgb[2] != kNone;
    points_.reserve(element.count);
    for (uint64_t i = 0; i < element.count; ++i) {
      if (auto ok = body_.ReadRow(element, i); !ok) return ok.error();
      points_.push_back({body_.Value(x), body_.Value(y), body_.Value(z)});
      if (header_.encoding == PlyEncoding::kAscii) vertex_line_.push_back(body_.line());
      for (const size_t property : {x, y, z}) {
        const double value = body_.Value(property);
        if (!(value >= -limits::kCoordinate && value <= limits::kCoordinate)) {
          return body_.Fail(element, i,
                            "a coordinate is not finite or beyond 1e15; write a number");
        }
      }
      if (!colored) continue;
      Rgb color(0);
      for (int k = 0; k < 3; ++k) {
        const size_t property = rgb[static_cast<size_t>(k)];
        const double value = body_.Value(property);
        const float scale = ColorScale(element.properties[property].type);
        if (!(value >= 0 && value <= scale)) {
          return body_.Fail(element, i,
                            "a colour is not within 0 to " + std::to_string(ClampToInt64(scale)) +
                                ", which is what its type holds");
        }
        color[k] = static_cast<float>(value) / scale;
      }
      colors_.push_back(color);
    }
    return Ok{};
  }

  // A vertex number, checked for what can be known now; Finish checks it against the vertices.
  Result<> ReadIndex(const PlyElement& element, uint64_t row, double value, uint32_t* vertex) {
    if (!(value >= 0 && value < static_cast<double>(limits::kVertices))) {
      return body_.Fail(element, row,
                        "names vertex " + BadIndex(value) + "; vertices count from 0");
    }
    *vertex = static_cast<uint32_t>(ClampToInt64(value));
    if (static_cast<double>(*vertex) != value) {
      return body_.Fail(element, row, "a vertex number is not whole");
    }
    highest_ = std::max(highest_, *vertex);
    return Ok{};
  }

  static std::string BadIndex(double value) {
    std::string text;
    text::Append(value, &text);
    return text;
  }

  Result<> ReadFaces(const PlyElement& element) {
    size_t list = Find(element, "vertex_indices", true);
    if (list == kNone) list = Find(element, "vertex_index", true);
    if (list == kNone) return Fail(element, "element face needs a list property vertex_indices");
    for (uint64_t i = 0; i < element.count; ++i) {
      if (auto ok = body_.ReadRow(element, i); !ok) return ok.error();
      const auto corners = body_.List(list);
      if (corners.size() < 3) {
        return body_.Fail(
            element, i,
            "has " + std::to_string(corners.size()) + " vertices; at least 3 are needed");
      }
      if (shape_.mesh.face_vertex.size() + corners.size() > limits::kIndices) {
        return TooManyIndices({name_, body_.line(), 0});
      }
      for (const double corner : corners) {
        uint32_t vertex = 0;
        if (auto ok = ReadIndex(element, i, corner, &vertex); !ok) return ok.error();
        if (vertex >= points_.size() && header_.encoding == PlyEncoding::kAscii &&
            !points_.empty()) {
          return body_.Fail(element, i,
                            "names vertex " + std::to_string(vertex) + "; vertices are 0 to " +
                                std::to_string(points_.size() - 1));
        }
        shape_.mesh.face_vertex.push_back(vertex);
      }
      shape_.mesh.face_size.push_back(static_cast<uint32_t>(corners.size()));
      if (header_.encoding == PlyEncoding::kAscii) shape_.face_line.push_back(body_.line());
    }
    return Ok{};
  }

  Result<> ReadEdges(const PlyElement& element) {
    const size_t from = Find(element, "vertex1", false), to = Find(element, "vertex2", false);
    if (from == kNone || to == kNone) {
      return Fail(element, "element edge needs the properties vertex1 and vertex2");
    }
    for (uint64_t i = 0; i < element.count; ++i) {
      if (auto ok = body_.ReadRow(element, i); !ok) return ok.error();
      if (edges_.size() >= 2 * limits::kVertices) return TooManyVertices({name_, body_.line(), 0});
      std::array<uint32_t, 2> edge{};
      if (auto ok = ReadIndex(element, i, body_.Value(from), &edge[0]); !ok) return ok.error();
      if (auto ok = ReadIndex(element, i, body_.Value(to), &edge[1]); !ok) return ok.error();
      edges_.push_back(edge);
    }
    return Ok{};
  }

  Result<ShapeFile> Finish() {
    const Place place = {name_, 0, 0};
    if (shape_.mesh.face_size.empty() && edges_.empty()) {
      return Invalid("the file has no faces and no edges; a cloud of points is no shape", place);
    }
    if (highest_ >= points_.size()) {
      return Invalid("a face or edge names vertex " + std::to_string(highest_) + "; the file has " +
                         std::to_string(points_.size()) + ", counted from 0",
                     place);
    }
    ChainEdges();
    if (shape_.mesh.face_size.empty()) return std::move(shape_);
    std::vector<uint8_t> drop(points_.size(), 0);
    for (const auto& edge : edges_) drop[edge[0]] = drop[edge[1]] = 1;
    for (const uint32_t v : shape_.mesh.face_vertex) drop[v] = 0;
    std::vector<uint32_t> number(points_.size());
    for (size_t v = 0; v < points_.size(); ++v) {
      if (drop[v]) continue;
      number[v] = static_cast<uint32_t>(shape_.mesh.points.size());
      shape_.mesh.points.push_back(points_[v]);
      if (!colors_.empty()) shape_.mesh.colors.push_back(colors_[v]);
      if (!vertex_line_.empty()) shape_.vertex_line.push_back(vertex_line_[v]);
    }
    for (uint32_t& v : shape_.mesh.face_vertex) v = number[v];
    return std::move(shape_);
  }

  void ChainEdges() {
    for (const Chain& chain : JoinEdges(edges_, points_.size())) {
      Polyline curve;
      curve.closed = chain.closed;
      for (const uint32_t v : chain.vertices) curve.points.push_back(points_[v]);
      shape_.curves.push_back(std::move(curve));
    }
  }

  const PlyHeader header_;
  PlyBody body_;
  const std::string& name_;
  std::vector<Vec3> points_;
  std::vector<Rgb> colors_;
  std::vector<int> vertex_line_;
  std::vector<std::array<uint32_t, 2>> edges_;
  uint32_t highest_ = 0;
  ShapeFile shape_;
};

}  // namespace

// A first line `ply`, after which blanks may stand.
bool LooksLikePly(std::string_view bytes) {
  if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);
  if (bytes.substr(0, 3) != "ply") return false;
  const size_t end = bytes.find_first_not_of(" \t", 3);
  return end != bytes.npos && (bytes[end] == '\n' || bytes[end] == '\r');
}

Result<ShapeFile> ReadPly(std::string_view bytes, const std::string& name) {
  auto header = ReadPlyHeader(bytes, name);
  if (!header) return header.error();
  return PlyReader(bytes, name, std::move(*header)).Read();
}

}  // namespace fjord::formats
