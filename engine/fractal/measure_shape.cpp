#include "engine/fractal/measure_shape.h"

#include <algorithm>
#include <sstream>

#include "engine/fractal/measure.h"
#include "engine/geometry/check_mesh.h"

namespace fjord {
namespace {

std::string Text(double value) {
  std::ostringstream text;
  text.precision(9);
  text << value;
  return text.str();
}

CurveMeasure MeasureCurve(const Polyline& line) {
  CurveMeasure m;
  m.points = line.points.size();
  m.closed = line.closed;
  m.length = LineLength(line);
  m.area = line.closed ? LineArea(line) : 0;
  if (line.points.size() < 64 || !(m.length > 0)) {
    return m;
  }
  // Openings from a twelfth of the extent down to twice the mean step.
  Vec3 low = line.points[0];
  Vec3 high = low;
  for (const Vec3& p : line.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double least = 2 * m.length / static_cast<double>(line.points.size());
  std::vector<double> openings;
  for (double opening = Length(high - low) / 12; opening >= least; opening *= .75) {
    openings.push_back(opening);
  }
  if (openings.size() >= 4) {
    m.dimension = RulerDimension(line, openings);
    m.H = 2 - *m.dimension;
  }
  return m;
}

MeshMeasure MeasureMesh(const Mesh& mesh) {
  const MeshCounts counts = CountMesh(mesh);
  MeshMeasure m;
  m.vertices = counts.vertices;
  m.edges = counts.edges;
  m.faces = counts.faces;
  m.boundary_edges = counts.boundary_edges;
  m.components = counts.components;
  m.euler = counts.euler;
  m.closed = counts.closed;
  m.area = MeshArea(mesh);
  m.volume = counts.closed ? MeshVolume(mesh) : 0;
  size_t corner = 0;
  bool first = true;
  for (const uint32_t size : mesh.face_size) {
    for (uint32_t k = 0; k < size; ++k) {
      const double length = Length(mesh.points[mesh.face_vertex[corner + (k + 1) % size]] -
                                   mesh.points[mesh.face_vertex[corner + k]]);
      m.shortest_edge = first ? length : std::min(m.shortest_edge, length);
      m.longest_edge = std::max(m.longest_edge, length);
      first = false;
    }
    corner += size;
  }
  if (!counts.closed) {
    m.H = ReliefHurst(mesh);
    if (m.H.has_value()) {
      m.dimension = 3 - *m.H;
    }
  }
  return m;
}

}  // namespace

ShapeMeasure MeasureShape(const Mesh& mesh, std::span<const Polyline> curves) {
  ShapeMeasure shape;
  if (mesh.FaceCount() > 0) {
    shape.mesh = MeasureMesh(mesh);
  }
  for (const Polyline& line : curves) {
    shape.curves.push_back(MeasureCurve(line));
  }
  return shape;
}

std::vector<std::pair<std::string, std::string>> ShapeMeasure::Rows() const {
  std::vector<std::pair<std::string, std::string>> rows;
  const auto add = [&](const std::string& name, const std::string& value) {
    rows.emplace_back(name, value);
  };
  const auto add_if = [&](const std::string& name, const std::optional<double>& value) {
    if (value.has_value()) {
      add(name, Text(*value));
    }
  };
  if (mesh.has_value()) {
    add("mesh.vertices", std::to_string(mesh->vertices));
    add("mesh.edges", std::to_string(mesh->edges));
    add("mesh.faces", std::to_string(mesh->faces));
    add("mesh.boundary_edges", std::to_string(mesh->boundary_edges));
    add("mesh.components", std::to_string(mesh->components));
    add("mesh.euler", std::to_string(mesh->euler));
    add("mesh.closed", mesh->closed ? "true" : "false");
    add("mesh.area", Text(mesh->area));
    if (mesh->closed) {
      add("mesh.volume", Text(mesh->volume));
    }
    add("mesh.shortest_edge", Text(mesh->shortest_edge));
    add("mesh.longest_edge", Text(mesh->longest_edge));
    add_if("mesh.H", mesh->H);
    add_if("mesh.dimension", mesh->dimension);
  }
  for (size_t i = 0; i < curves.size(); ++i) {
    const std::string name = "curve." + std::to_string(i + 1) + ".";
    add(name + "points", std::to_string(curves[i].points));
    add(name + "closed", curves[i].closed ? "true" : "false");
    add(name + "length", Text(curves[i].length));
    if (curves[i].closed) {
      add(name + "area", Text(curves[i].area));
    }
    add_if(name + "dimension", curves[i].dimension);
    add_if(name + "H", curves[i].H);
  }
  return rows;
}

std::string ShapeMeasure::ToText() const {
  const auto rows = Rows();
  size_t width = 0;
  for (const auto& [name, value] : rows) {
    width = std::max(width, name.size());
  }
  std::string text;
  for (const auto& [name, value] : rows) {
    text += name + std::string(width + 2 - name.size(), ' ') + value + "\n";
  }
  return text;
}

}  // namespace fjord
