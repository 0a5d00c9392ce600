// What a reader takes is sound; what a writer writes reads back as the same shape; the checkers
// take any of it.
#include "engine/formats/import.h"
#include "engine/formats/shape_file.h"
#include "engine/geometry/check_mesh.h"
#include "engine/geometry/normals.h"
#include "engine/geometry/triangulate.h"
#include "tests/fuzz/harness.h"

namespace fjord::fuzz {
namespace {

bool IsSound(const Vec3& p) {
  for (int k = 0; k < 3; ++k) {
    if (!(p[k] >= -1e15 && p[k] <= 1e15)) return false;
  }
  return true;
}

void CheckSound(const ShapeFile& shape) {
  const Mesh& mesh = shape.mesh;
  FJORD_CHECK(!mesh.face_size.empty() || !shape.curves.empty());
  size_t corners = 0;
  for (const uint32_t size : mesh.face_size) {
    FJORD_CHECK(size >= 3, size);
    corners += size;
  }
  FJORD_CHECK(corners == mesh.face_vertex.size(), corners, mesh.face_vertex.size());
  for (const uint32_t v : mesh.face_vertex) FJORD_CHECK(v < mesh.points.size(), v);
  for (const Vec3& p : mesh.points) FJORD_CHECK(IsSound(p), p.x, p.y, p.z);
  FJORD_CHECK(mesh.colors.empty() || mesh.colors.size() == mesh.points.size());
  FJORD_CHECK(shape.vertex_line.empty() || shape.vertex_line.size() == mesh.points.size() ||
              mesh.face_size.empty());
  FJORD_CHECK(shape.face_line.empty() || shape.face_line.size() == mesh.face_size.size());
  for (const Polyline& curve : shape.curves) {
    FJORD_CHECK(curve.points.size() >= (curve.closed ? 3u : 2u), curve.points.size());
    for (const Vec3& p : curve.points) FJORD_CHECK(IsSound(p), p.x, p.y, p.z);
  }
}

void WriteAndReadAgain(const ShapeFile& shape, ShapeFormat format) {
  const Result<std::string> bytes = WriteShape(shape, format, {"a comment"});
  if (!bytes) {
    const bool old = format == ShapeFormat::kStd || format == ShapeFormat::kEpf;
    // Open curves; a mesh without an edge.
    FJORD_CHECK(old || format == ShapeFormat::kSvg, bytes.error().message);
    return;
  }
  const Result<ShapeFile> back = ReadShape(*bytes, "again");
  FJORD_CHECK(back.ok(), back.ok() ? "" : back.error().ToString());
  if (format == ShapeFormat::kSvg) return;
  FJORD_CHECK(back->mesh.face_size.size() >= shape.mesh.face_size.size());
  if (format == ShapeFormat::kStd || shape.mesh.face_size.empty()) return;
  FJORD_CHECK(back->mesh.points == shape.mesh.points);
  FJORD_CHECK(back->mesh.face_vertex == shape.mesh.face_vertex);
  FJORD_CHECK(back->mesh.colors == shape.mesh.colors);
  FJORD_CHECK(back->curves.size() == shape.curves.size());
}

}  // namespace

void RunShape(std::string_view bytes) {
  const Result<ShapeFile> shape = ReadShape(bytes, "fuzz");
  if (!shape) {
    FJORD_CHECK(!shape.error().message.empty());
    return;
  }
  CheckSound(*shape);
  for (ShapeFormat format :
       {ShapeFormat::kStd, ShapeFormat::kObj, ShapeFormat::kPly, ShapeFormat::kSvg}) {
    WriteAndReadAgain(*shape, format);
  }
  if (shape->mesh.points.size() > 10'000) return;
  CheckMesh(shape->mesh, 10);
  CountMesh(shape->mesh);
  VertexNormals(shape->mesh);
  size_t want = 0;
  for (const uint32_t size : shape->mesh.face_size) want += size - 2;
  FJORD_CHECK(Triangulate(shape->mesh).size() == want);
  (void)SceneTextFromShape(*shape, "fuzz", nullptr, "");
}

}  // namespace fjord::fuzz
