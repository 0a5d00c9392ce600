#include "engine/formats/import_form.h"

#include "engine/base/clamp.h"
#include "engine/geometry/edges.h"
#include "engine/geometry/remesh.h"
#include "engine/geometry/triangulate.h"

namespace fjord::import {
namespace {

// Edges longer than so many times the middle one look like another shape's.
constexpr double kMostUneven = 3;
constexpr double kMostPieces = 100'000;  // that a shape's outline is divided into

// The next number of three digits, or whole number, that is not less.
double RoundedUp(double value) {
  double scale = 1;
  while (value * scale < 100) scale *= 10;
  const auto whole = static_cast<double>(RoundToInt64(value * scale));
  return std::max(value, (whole < value * scale ? whole + 1 : whole) / scale);
}

double MedianOf(std::vector<double> lengths) {
  const auto middle = lengths.begin() + static_cast<long>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

// Of edges along curves or borders; 0 where none is much longer than the others.
double EvenLength(const std::vector<double>& lengths) {
  if (lengths.empty()) return 0;
  double sum = 0, longest = 0;
  for (const double length : lengths) {
    sum += length;
    longest = std::max(longest, length);
  }
  const double even = RoundedUp(std::max(kMostUneven * MedianOf(lengths), sum / kMostPieces));
  return longest > even ? even : 0;
}

// Is a good part of the mesh slivers, as in fans, and does Remesh take most of them away? A few
// here and there are not seen.
bool HasSlivers(const Mesh& triangles, double spacing) {
  constexpr size_t kFew = 4;  // one in so many
  const size_t before = CountSlivers(triangles);
  if (before * kFew < triangles.FaceCount()) return false;
  // What takes many more points than it has is no coarse shape of slivers, and not waited for.
  const uint64_t most_points = 16 * uint64_t{triangles.points.size()} + 10'000;
  const Result<Mesh> even = Remesh(triangles, spacing, most_points);
  return even.ok() && CountSlivers(*even) * 2 < before;
}

double SpacingOf(const Mesh& mesh, const std::vector<double>& border, bool flat) {
  Mesh triangles;
  triangles.points = mesh.points;
  double longest = 0;
  for (const Triangle& t : Triangulate(mesh)) {
    triangles.AddFace(t);
    for (int k = 0; k < 3; ++k) {
      longest = std::max(longest, Length(mesh.points[t[k]] - mesh.points[t[(k + 1) % 3]]));
    }
  }
  const double even = flat ? EvenLength(border) : 0;
  if (even > 0) return even;
  const double spacing = RoundedUp(longest);
  return HasSlivers(triangles, spacing) ? spacing : 0;
}

void AddLength(const Vec3& a, const Vec3& b, std::vector<double>* lengths) {
  const double length = Length(b - a);
  if (length > 0) lengths->push_back(length);
}

}  // namespace

void Bounds::Add(const Vec3& p) {
  for (int k = 0; k < 3; ++k) {
    low[k] = empty ? p[k] : std::min(low[k], p[k]);
    high[k] = empty ? p[k] : std::max(high[k], p[k]);
  }
  empty = false;
}

Judged Judge(const ShapeFile& shape) {
  Judged judged;
  const Mesh& mesh = shape.mesh;
  std::vector<double> lengths;  // of the curves, or of the mesh's outline
  for (const Polyline& curve : shape.curves) {
    for (size_t k = 0; k < curve.points.size(); ++k) {
      judged.box.Add(curve.points[k]);
      if (k == 0 && !curve.closed) continue;
      AddLength(k > 0 ? curve.points[k - 1] : curve.points.back(), curve.points[k], &lengths);
    }
  }
  if (mesh.face_size.empty()) {
    judged.form = Form::kCurve;
    judged.closed = shape.curves[0].closed;
    judged.spacing = EvenLength(lengths);
  } else {
    for (const uint32_t v : mesh.face_vertex) judged.box.Add(mesh.points[v]);
    lengths.clear();
    const EdgeTable table(mesh);
    judged.level_border = true;
    for (const Edge& edge : table.edges()) {
      if (edge.use_count != 1) continue;
      AddLength(mesh.points[edge.a], mesh.points[edge.b], &lengths);
      judged.level_border = judged.level_border && mesh.points[edge.a].z == judged.box.low.z &&
                            mesh.points[edge.b].z == judged.box.low.z;
    }
    if (mesh.FaceCount() == 1 && mesh.face_size[0] > 4) {
      judged.form = Form::kOutline;
      judged.closed = true;
      judged.spacing = EvenLength(lengths);
    } else {
      const bool flat = judged.box.low.z == judged.box.high.z;
      judged.form = lengths.empty() ? Form::kClosedMesh : flat ? Form::kFlatMesh : Form::kRelief;
      judged.spacing = SpacingOf(mesh, lengths, judged.form == Form::kFlatMesh);
    }
  }
  return judged;
}

std::vector<Piece> PiecesOf(const ShapeFile& shape, const Judged& judged) {
  std::vector<Piece> pieces;
  const bool faces = !shape.mesh.face_size.empty();
  if (faces || shape.curves.size() == 1) pieces.push_back({judged.form, judged.closed, 0});
  if (!faces && shape.curves.size() == 1) return pieces;
  for (size_t k = 0; k < shape.curves.size(); ++k) {
    pieces.push_back({Form::kCurve, shape.curves[k].closed, k + 1});
  }
  return pieces;
}

}  // namespace fjord::import
