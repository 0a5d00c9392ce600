// Writing .svg: one path a curve, with z left out and y turned down; a mesh as its edges.
#include <algorithm>
#include <array>

#include "engine/formats/readers.h"
#include "engine/formats/text.h"
#include "engine/geometry/edges.h"

namespace fjord::formats {
namespace {

void AppendPoint(char command, const Vec3& p, std::string* out) {
  *out += command;
  text::Append(p.x, out);
  *out += ' ';
  text::Append(0 - p.y, out);
}

struct Box {
  Vec2 low{0}, high{0};
  bool empty = true;

  void Add(const Vec3& p) {
    const Vec2 q(p.x, 0 - p.y);
    for (int k = 0; k < 2; ++k) {
      low[k] = empty ? q[k] : std::min(low[k], q[k]);
      high[k] = empty ? q[k] : std::max(high[k], q[k]);
    }
    empty = false;
  }
};

std::string Escaped(std::string_view text) {
  std::string out;
  for (const char c : text::OneLine(text)) {
    // Two hyphens would end the comment.
    if (c == '-' && !out.empty() && out.back() == '-') out += ' ';
    out += c;
  }
  return out;
}

}  // namespace

std::string WriteSvg(const ShapeFile& shape, const Comment& comment) {
  Box box;
  if (!shape.mesh.face_size.empty()) {
    for (const uint32_t v : shape.mesh.face_vertex) box.Add(shape.mesh.points[v]);
  }
  for (const Polyline& curve : shape.curves) {
    for (const Vec3& p : curve.points) box.Add(p);
  }
  const Vec2 size = box.high - box.low;
  const double extent = std::max(size.x, size.y) > 0 ? std::max(size.x, size.y) : 1;
  const double margin = extent / 50;

  std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"";
  const std::array<double, 4> view = {box.low.x - margin, box.low.y - margin, size.x + 2 * margin,
                                      size.y + 2 * margin};
  for (size_t i = 0; i < view.size(); ++i) text::Append(view[i], &(i ? out += ' ' : out));
  out += "\">\n";
  for (const std::string& line : comment) out += "<!-- " + Escaped(line) + " -->\n";
  out += "<g fill=\"none\" stroke=\"black\" stroke-width=\"";
  text::Append(extent / 1000, &out);
  out += "\">\n";
  if (!shape.mesh.face_size.empty()) {
    out += "<path d=\"";
    const EdgeTable table(shape.mesh);
    for (const Edge& edge : table.edges()) {
      AppendPoint('M', shape.mesh.points[edge.a], &out);
      AppendPoint('L', shape.mesh.points[edge.b], &out);
      out += '\n';
    }
    out += "\"/>\n";
  }
  for (const Polyline& curve : shape.curves) {
    out += "<path d=\"";
    for (size_t k = 0; k < curve.points.size(); ++k) {
      AppendPoint(k == 0 ? 'M' : 'L', curve.points[k], &out);
      if (k % 8 == 7) out += '\n';
    }
    out += curve.closed ? "Z\"/>\n" : "\"/>\n";
  }
  return out + "</g>\n</svg>\n";
}

}  // namespace fjord::formats
