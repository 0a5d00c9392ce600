// All numbers of one shape, for `fjord measure`: what it holds, how large it is, whether it is
// closed, and how rough.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/geometry/mesh.h"

namespace fjord {

struct CurveMeasure {
  size_t points = 0;
  bool closed = false;
  double length = 0;
  double area = 0;                  // enclosed in x, y; 0 for an open curve
  std::optional<double> dimension;  // by rulers; none for fewer than 64 points
  std::optional<double> H;          // 2 - dimension
};

struct MeshMeasure {
  size_t vertices = 0, edges = 0, faces = 0, boundary_edges = 0, components = 0;
  int64_t euler = 0;
  bool closed = false;
  double area = 0;
  double volume = 0;  // closed meshes
  double shortest_edge = 0, longest_edge = 0;
  std::optional<double> H;          // of heights over x, y; open meshes
  std::optional<double> dimension;  // 3 - H
};

struct ShapeMeasure {
  std::optional<MeshMeasure> mesh;  // none for a shape without faces
  std::vector<CurveMeasure> curves;

  // Names and values, in a fixed order: "mesh.vertices" "101", "curve.1.length" "12.5".
  std::vector<std::pair<std::string, std::string>> Rows() const;
  // One row a line, values lined up.
  std::string ToText() const;
};

ShapeMeasure MeasureShape(const Mesh& mesh, std::span<const Polyline> curves);

}  // namespace fjord
