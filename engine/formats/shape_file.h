// Reading and writing shapes in the files people have: .std and .epf (S27), Wavefront .obj, binary
// .ply, and .svg for curves. Readers judge by content, not by ending; they take any bytes and answer
// with a shape or an error with its place; limits are in limits.h. Writers give the same bytes for the
// same shape; numbers are printed shortest round-trip.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/geometry/mesh.h"

namespace fjord {

// A file holds a mesh, curves, or both empty never. line[f] is the text line of face f, and
// vertex_line[v] of vertex v, for messages; empty for binary files.
struct ShapeFile {
  Mesh mesh;
  std::vector<Polyline> curves;
  std::vector<int> vertex_line;
  std::vector<int> face_line;
};

enum class ShapeFormat { kStd, kEpf, kObj, kPly, kSvg };

Result<ShapeFile> ReadShape(std::string_view bytes, const std::string& name);

// By file ending; kUsage for an unknown one, with those that are known.
Result<ShapeFormat> ShapeFormatOf(const std::string& path);

// `comment`: lines that record where the shape comes from (seed and every parameter, C47).
Result<std::string> WriteShape(const ShapeFile& shape, ShapeFormat format,
                               const std::vector<std::string>& comment);

}  // namespace fjord
