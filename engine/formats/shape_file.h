// Reading and writing shapes in the files people have: .std and .epf (S27), Wavefront .obj, .ply,
// and .svg for curves (docs/files.md). Readers judge by content, not by ending; they take any bytes
// and answer with a shape or an error with its place; limits are in limits.h. Writers give the same
// bytes for the same shape; numbers are printed shortest round-trip. All functions are safe to call
// from any thread. What is read has in-range indices, faces of three corners or more and finite
// numbers up to 1e15; everything else that can be wrong with a mesh is for CheckMesh to say.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/geometry/mesh.h"

namespace fjord {

// What the file shows and a shape does not hold, in words, where it is met first.
struct ShapeNote {
  Place place;
  std::string message;
};

// A file holds a mesh (with faces), curves, or both. face_line[f] is the text line of face f, and
// vertex_line[v] of vertex v, for messages; empty for binary files.
struct ShapeFile {
  Mesh mesh;
  std::vector<Polyline> curves;
  std::vector<int> vertex_line;
  std::vector<int> face_line;
  // .std and .epf: digits after the point of each coordinate (3 a vertex) as they stood in the
  // file, 255 for the shortest form, so that a file made by hand comes back as it was written. Not
  // needed for writing.
  std::vector<uint8_t> decimals;
  std::vector<ShapeNote> notes;
};

enum class ShapeFormat { kStd, kEpf, kObj, kPly, kSvg };

// `name` stands for the file in errors; its ending only helps to word them.
Result<ShapeFile> ReadShape(std::string_view bytes, const std::string& name);
// Reads the file first; kNotFound, kIo or kLimit where that fails.
Result<ShapeFile> ReadShapeFile(const std::string& path);

// By file ending; kUsage for an unknown one, with those that are known.
Result<ShapeFormat> ShapeFormatOf(const std::string& path);

// `comment`: lines that record where the shape comes from (seed and every parameter, C47). kInvalid
// for a shape that breaks Mesh's invariants or that the format has no form for (open curves in
// .std); a shape without faces and curves is refused. Colours are kept by .obj and .ply, z by all
// but .svg; .std and .epf hold closed curves as faces, .svg a mesh as its edges.
Result<std::string> WriteShape(const ShapeFile& shape, ShapeFormat format,
                               const std::vector<std::string>& comment);

}  // namespace fjord
