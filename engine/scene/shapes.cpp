#include "engine/scene/shapes.h"

#include <algorithm>
#include <utility>

#include "engine/formats/shape_file.h"
#include "engine/geometry/border.h"
#include "engine/geometry/primitives.h"
#include "engine/geometry/remesh.h"
#include "engine/geometry/up_axis.h"
#include "engine/scene/heights.h"
#include "engine/scene/limits.h"

namespace fjord {
namespace {

Vec3 ToVec3(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }

Geometry FromMesh(Mesh mesh) {
  Geometry geometry;
  geometry.points = std::move(mesh.points);
  geometry.face_size = std::move(mesh.face_size);
  geometry.face_vertex = std::move(mesh.face_vertex);
  geometry.colors = std::move(mesh.colors);
  return geometry;
}

// What every shape must keep, wherever it comes from.
Result<Geometry> Checked(Geometry geometry) {
  const size_t count = geometry.points.size();
  for (size_t v = 0; v < count; ++v) {
    const Vec3& point = geometry.points[v];
    if (std::max({point.x, point.y, point.z, -point.x, -point.y, -point.z}) <= limits::kLargest)
      continue;
    return Invalid("vertex " + std::to_string(v + 1) +
                   " lies beyond 1e12, the largest number a scene may have; scale the shape down");
  }
  if (geometry.curve) {
    const size_t least = geometry.closed ? 3 : 2;
    if (count < least) {
      return Invalid((geometry.closed ? "a closed polyline" : "a polyline") +
                     std::string(" needs ") + std::to_string(least) + " points or more; this has " +
                     std::to_string(count));
    }
    return geometry;
  }
  if (geometry.face_size.empty()) return Invalid("the mesh has no faces");
  if (!geometry.colors.empty() && geometry.colors.size() != count) {
    return Invalid("the mesh has " + std::to_string(count) + " points and " +
                   std::to_string(geometry.colors.size()) + " colours; give none or one a point");
  }
  size_t corner = 0;
  for (size_t f = 0; f < geometry.face_size.size(); ++f) {
    if (geometry.face_size[f] < 3) {
      return Invalid("face " + std::to_string(f + 1) + " has " +
                     std::to_string(geometry.face_size[f]) + " corners; it needs three or more");
    }
    for (uint32_t i = 0; i < geometry.face_size[f]; ++i, ++corner) {
      if (geometry.face_vertex[corner] >= count) {
        return Invalid("face " + std::to_string(f + 1) + " names vertex " +
                       std::to_string(uint64_t{geometry.face_vertex[corner]} + 1) +
                       "; there are vertices 1 to " + std::to_string(count));
      }
    }
  }
  return geometry;
}

Result<Geometry> FromMessage(const v1::Mesh& mesh) {
  Geometry geometry;
  for (const v1::Vec3& point : mesh.point()) geometry.points.push_back(ToVec3(point));
  for (const v1::Color& color : mesh.color()) {
    geometry.colors.emplace_back(Vec3(color.r(), color.g(), color.b()));
  }
  for (int f = 0; f < mesh.face_size(); ++f) {
    geometry.face_size.push_back(static_cast<uint32_t>(mesh.face(f).v_size()));
    for (const uint32_t vertex : mesh.face(f).v()) {
      if (vertex == 0) {
        return Invalid("face " + std::to_string(f + 1) + " names vertex 0; vertices count from 1");
      }
      geometry.face_vertex.push_back(vertex - 1);
    }
  }
  return Checked(std::move(geometry));
}

Result<Geometry> FromMessage(const v1::Polyline& polyline) {
  Geometry geometry;
  geometry.curve = true;
  geometry.closed = polyline.closed();
  for (const v1::Vec3& point : polyline.point()) geometry.points.push_back(ToVec3(point));
  return Checked(std::move(geometry));
}

Geometry FromHeights(HeightField field) {
  Geometry geometry;
  const HeightSource& source = *field.source;
  const auto range = source.RangeOf(0, 0, source.columns() - 1, source.rows() - 1);
  for (const float height : {range.low, range.high}) {
    for (const uint32_t j : {0u, source.rows() - 1}) {
      for (const uint32_t i : {0u, source.columns() - 1}) {
        geometry.points.push_back(field.Place(i, j, height));
      }
    }
  }
  geometry.face_size = {4};
  geometry.face_vertex = {0, 1, 3, 2};
  geometry.heights = std::move(field);
  return geometry;
}

// A grid of more points than a mesh may have: all its heights are 0.
std::optional<HeightField> LargeGrid(const v1::Primitive& grid) {
  constexpr uint32_t kMostCells = 16384;
  const uint64_t columns = uint64_t{grid.segments()} + 1, rows = uint64_t{grid.rings()} + 1;
  if (grid.kind() != v1::Primitive::GRID || columns * rows <= limits::kFilePoints ||
      grid.segments() > kMostCells || grid.rings() > kMostCells) {
    return std::nullopt;
  }
  return HeightField{FlatHeights(static_cast<uint32_t>(columns), static_cast<uint32_t>(rows)),
                     Vec3(grid.size().x(), grid.size().y(), 1)};
}

// Needs a primitive whose defaults are filled in (defaults.h).
Result<Mesh> MakePrimitive(const v1::Primitive& primitive) {
  const uint32_t segments = primitive.segments(), rings = primitive.rings();
  if (uint64_t{segments} * rings > limits::kFilePoints) {
    return MakeError(ErrorCode::kLimit, "a primitive may have at most " +
                                            std::to_string(limits::kFilePoints) + " points");
  }
  switch (primitive.kind()) {
    case v1::Primitive::SPHERE:
    case v1::Primitive::ELLIPSOID: {
      const bool sphere = primitive.kind() == v1::Primitive::SPHERE;
      const Vec3 radii = sphere ? Vec3(primitive.radius()) : ToVec3(primitive.radii());
      return primitive.base() == v1::Primitive::EVEN
                 ? MakeEvenEllipsoid(radii, EvenSteps(uint64_t{segments} * rings))
                 : MakeEllipsoid(radii, segments, rings);
    }
    case v1::Primitive::TORUS:
      return MakeTorus(primitive.radius(), primitive.tube(), segments, rings);
    case v1::Primitive::BOX:
      return MakeBox(ToVec3(primitive.size()), segments, rings);
    case v1::Primitive::GRID:
      return MakeGrid(ToVec3(primitive.size()), segments, rings);
    default:
      return Invalid("a primitive of an unknown kind");
  }
}

std::string LeftOut(size_t count, const std::string& what, const std::string& remedy) {
  if (count == 0) return {};
  return std::to_string(count) + " " + what +
         (count == 1 ? " of the file is" : "s of the file are") + " left out" + remedy;
}

UpAxis UpOf(const v1::File& file) {
  switch (file.up()) {
    case v1::File::Y:
      return UpAxis::kY;
    case v1::File::X:
      return UpAxis::kX;
    default:
      return UpAxis::kZ;
  }
}

// Long edges divided, slivers gone (File.spacing).
Result<Geometry> Spaced(Geometry geometry, double spacing) {
  if (geometry.curve) {
    Result<Polyline> divided = DivideCurve({std::move(geometry.points), geometry.closed}, spacing);
    if (!divided) return divided.error();
    geometry.points = std::move(divided->points);
    return geometry;
  }
  Mesh mesh{std::move(geometry.points), std::move(geometry.face_size),
            std::move(geometry.face_vertex), std::move(geometry.colors)};
  Result<Mesh> even = Remesh(mesh, spacing);
  if (!even) return even.error();
  Geometry spaced = FromMesh(std::move(*even));
  spaced.left_out = std::move(geometry.left_out);
  return spaced;
}

Result<Geometry> FromFile(const v1::File& file, const std::string& bytes) {
  Result<ShapeFile> read = ReadShape(bytes, file.path().empty() ? file.digest() : file.path());
  if (!read) return read.error();
  TurnUp(UpOf(file), &read->mesh.points);
  for (Polyline& curve : read->curves) TurnUp(UpOf(file), &curve.points);
  const size_t faces = read->mesh.FaceCount(), curves = read->curves.size();
  if (file.curve() > curves) {
    return Invalid("there is no curve " + std::to_string(file.curve()) + "; the file has " +
                   std::to_string(curves));
  }
  Geometry geometry;
  if (file.outline() && file.curve() > 0) return Invalid("give outline or curve, not both");
  if (file.outline() && faces > 0) {
    const std::vector<Chain> borders = BorderOf(read->mesh);
    if (borders.empty()) return Invalid("the mesh is closed and so has no outline");
    if (!borders[0].closed) return Invalid("the border of the mesh meets itself; mend the mesh");
    geometry.curve = geometry.closed = true;
    for (const uint32_t v : borders[0].vertices) geometry.points.push_back(read->mesh.points[v]);
    geometry.left_out = LeftOut(borders.size() - 1, "more border", "");
  } else if (file.curve() == 0 && faces > 0) {
    geometry = FromMesh(std::move(read->mesh));
    geometry.left_out = LeftOut(curves, "curve", "; `curve: 1` takes the first of them");
  } else if (curves > 0) {
    Polyline& taken = read->curves[file.curve() == 0 ? 0 : file.curve() - 1];
    geometry.curve = true;
    geometry.closed = taken.closed;
    geometry.points = std::move(taken.points);
    // Who names a curve knows that there are others.
    if (file.curve() == 0) {
      geometry.left_out =
          LeftOut(curves - 1, "more curve",
                  "; `curve: 2` takes the second, and fjord import makes an object of each");
    }
  } else {
    return Invalid(file.path() + " has no faces and no curves");
  }
  for (const ShapeNote& note : read->notes) {
    geometry.notes.push_back(note.place.ToString() + ": " + note.message);
  }
  Result<Geometry> checked = Checked(std::move(geometry));
  if (!checked || !file.has_spacing()) return checked;
  return Spaced(std::move(*checked), file.spacing());
}

}  // namespace

Result<Geometry> DecodeShape(const v1::Shape& shape,
                             const std::map<std::string, std::string>& assets) {
  switch (shape.kind_case()) {
    case v1::Shape::kMesh:
      return FromMessage(shape.mesh());
    case v1::Shape::kPolyline:
      return FromMessage(shape.polyline());
    case v1::Shape::kHeights: {
      Result<HeightField> field = DecodeHeights(shape.heights(), assets);
      if (!field) return field.error();
      return Checked(FromHeights(std::move(*field)));
    }
    case v1::Shape::kPrimitive: {
      if (auto grid = LargeGrid(shape.primitive())) return Checked(FromHeights(std::move(*grid)));
      Result<Mesh> mesh = MakePrimitive(shape.primitive());
      if (!mesh) return mesh.error();
      return Checked(FromMesh(std::move(*mesh)));
    }
    case v1::Shape::kFile: {
      const auto found = assets.find(shape.file().digest());
      if (found == assets.end()) return Invalid("file " + shape.file().path() + " was not read");
      return FromFile(shape.file(), found->second);
    }
    default:
      return Invalid("the shape is empty; give it mesh, polyline, primitive, file or heights");
  }
}

Result<Geometry> WithMesh(Geometry geometry) {
  if (!geometry.heights) return geometry;
  const HeightSource& source = *geometry.heights->source;
  const uint64_t points = uint64_t{source.columns()} * source.rows();
  if (points > limits::kFilePoints) {
    return MakeError(ErrorCode::kLimit,
                     std::to_string(source.columns()) + " x " + std::to_string(source.rows()) +
                         " points are more than the " + std::to_string(limits::kFilePoints) +
                         " that a fractal or a key picture can have; without them heights and "
                         "grids are drawn at any size");
  }
  return FromMesh(MeshOf(*geometry.heights));
}

void Box::Add(const Vec3& point) {
  if (empty) {
    low = high = point;
    empty = false;
    return;
  }
  for (int i = 0; i < 3; ++i) {
    low[i] = std::min(low[i], point[i]);
    high[i] = std::max(high[i], point[i]);
  }
}

}  // namespace fjord
