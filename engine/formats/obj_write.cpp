// Writing Wavefront .obj: vertices, faces, then a line for each curve.
#include "engine/formats/readers.h"
#include "engine/formats/text.h"

namespace fjord::formats {
namespace {

void AppendVertex(const Vec3& p, const Rgb* color, std::string* out) {
  *out += 'v';
  for (int k = 0; k < 3; ++k) text::Append(p[k], &(*out += ' '));
  for (int k = 0; color != nullptr && k < 3; ++k) text::Append((*color)[k], &(*out += ' '));
  *out += '\n';
}

}  // namespace

std::string WriteObj(const ShapeFile& shape, const Comment& comment) {
  std::string out;
  for (const std::string& line : comment) {
    out += "# " + text::OneLine(line);
    out += out.back() == '\\' ? " \n" : "\n";  // a backslash would join the next line
  }
  const Mesh& mesh = shape.mesh;
  // Points without faces would be read as the mesh's; a file of curves alone has none.
  const size_t mesh_points = mesh.face_size.empty() ? 0 : mesh.points.size();
  for (size_t v = 0; v < mesh_points; ++v) {
    AppendVertex(mesh.points[v], mesh.colors.empty() ? nullptr : &mesh.colors[v], &out);
  }
  for (const Polyline& curve : shape.curves) {
    for (const Vec3& p : curve.points) AppendVertex(p, nullptr, &out);
  }
  size_t corner = 0;
  for (const uint32_t size : mesh.face_size) {
    out += 'f';
    for (size_t k = 0; k < size; ++k) {
      text::Append(uint64_t{mesh.face_vertex[corner++]} + 1, &(out += ' '));
    }
    out += '\n';
  }
  uint64_t first = mesh_points + 1;
  for (const Polyline& curve : shape.curves) {
    out += 'l';
    for (size_t k = 0; k < curve.points.size(); ++k) text::Append(first + k, &(out += ' '));
    if (curve.closed) text::Append(first, &(out += ' '));
    first += curve.points.size();
    out += '\n';
  }
  return out;
}

}  // namespace fjord::formats
