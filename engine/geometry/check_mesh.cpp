#include "engine/geometry/check_mesh.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <tuple>
#include <utility>

#include "engine/geometry/edges.h"
#include "engine/geometry/normals.h"
#include "engine/geometry/orientation.h"
#include "engine/geometry/t_junctions.h"

namespace fjord {
namespace {

using Kind = MeshDefect::Kind;

std::string Number(size_t index) { return std::to_string(index + 1); }

bool IsFinite(const Vec3& p) {
  const double sum = p.x * 0 + p.y * 0 + p.z * 0;  // NaN where a coordinate is NaN or infinite
  return sum == 0;
}

std::string Coordinates(const Vec3& p) {
  const auto text = [](double x) {
    std::array<char, 32> buffer{};
    return std::string(buffer.data(),
                       std::to_chars(buffer.data(), buffer.data() + buffer.size(), x).ptr);
  };
  return "(" + text(p.x) + ", " + text(p.y) + ", " + text(p.z) + ")";
}

// Collects at most `most` defects of each kind; Finish puts them in order and cuts.
class Checker {
 public:
  Checker(const Mesh& mesh, size_t most) : mesh_(mesh), most_(most) {}

  std::vector<MeshDefect> Run() {
    CheckFaces();
    CheckPoints();
    const EdgeTable table(good_);
    CheckEdges(table);
    CheckTJunctions(table);
    CheckOrientation(table);
    return Finish();
  }

 private:
  void Add(Kind kind, size_t vertex, size_t face, std::string message) {
    size_t& count = count_[static_cast<size_t>(kind)];
    if (count >= most_) return;
    ++count;
    defects_.push_back(
        {kind, static_cast<uint32_t>(vertex), static_cast<uint32_t>(face), std::move(message)});
  }

  // Faces with usable indices go on to the other checks as good_; face_number_ keeps their numbers.
  void CheckFaces() {
    good_.points = mesh_.points;
    used_.assign(mesh_.points.size(), false);
    size_t begin = 0;
    for (size_t f = 0; f < mesh_.FaceCount(); ++f) {
      const size_t size = mesh_.face_size[f];
      if (size > mesh_.face_vertex.size() - begin) {
        Add(Kind::kBadIndex, 0, f + 1,
            "face " + Number(f) + " runs past the end of the list of corners");
        return;
      }
      const auto face = std::span<const uint32_t>(mesh_.face_vertex).subspan(begin, size);
      begin += size;
      if (IsGood(f, face)) {
        good_.AddFace(face);
        face_number_.push_back(static_cast<uint32_t>(f + 1));
      }
    }
  }

  bool IsGood(size_t f, std::span<const uint32_t> face) {
    const std::string name = "face " + Number(f);
    if (face.size() < 3) {
      Add(Kind::kBadIndex, 0, f + 1,
          name + " has " + std::to_string(face.size()) + " vertices; at least 3 are needed");
      return false;
    }
    bool finite = true;
    for (const uint32_t v : face) {
      if (v >= mesh_.points.size()) {
        Add(Kind::kBadIndex, 0, f + 1,
            name + " names vertex " + Number(v) + ", but there are " +
                std::to_string(mesh_.points.size()));
        return false;
      }
      used_[v] = true;
      finite = finite && IsFinite(mesh_.points[v]);
    }
    std::vector<uint32_t> sorted(face.begin(), face.end());
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end()) {
      Add(Kind::kRepeatedVertex, 0, f + 1, name + " names vertex " + Number(*twice) + " twice");
      return false;
    }
    if (!finite) return false;  // reported with the vertex
    double longest = 0;
    for (size_t k = 0; k < face.size(); ++k) {
      longest = std::max(longest,
                         Length(mesh_.points[face[(k + 1) % face.size()]] - mesh_.points[face[k]]));
    }
    if (Length(AreaVector(mesh_.points, face)) <= 1e-12 * longest * longest) {
      Add(Kind::kZeroArea, 0, f + 1, name + " has no area: its vertices lie on one line");
    }
    return true;
  }

  void CheckPoints() {
    std::vector<uint32_t> finite;
    for (uint32_t v = 0; v < mesh_.points.size(); ++v) {
      if (!IsFinite(mesh_.points[v])) {
        Add(Kind::kNotFinite, v + 1, 0,
            "vertex " + Number(v) + " has a coordinate that is no number");
        continue;
      }
      finite.push_back(v);
      if (!used_[v]) {
        Add(Kind::kUnusedVertex, v + 1, 0, "vertex " + Number(v) + " belongs to no face");
      }
    }
    const auto place = [this](uint32_t v) {
      const Vec3& p = mesh_.points[v];
      return std::tuple(p.x, p.y, p.z);
    };
    std::sort(finite.begin(), finite.end(), [&](uint32_t l, uint32_t r) {
      return place(l) != place(r) ? place(l) < place(r) : l < r;
    });
    std::vector<std::pair<uint32_t, uint32_t>> twins;  // later vertex, first one at its place
    for (size_t i = 1, first = 0; i < finite.size(); ++i) {
      if (place(finite[i]) == place(finite[first])) {
        twins.emplace_back(finite[i], finite[first]);
      } else {
        first = i;
      }
    }
    std::sort(twins.begin(), twins.end());
    for (const auto& [later, first] : twins) {
      Add(Kind::kDuplicateVertex, later + 1, 0,
          "vertices " + Number(first) + " and " + Number(later) + " are at one place " +
              Coordinates(mesh_.points[first]));
    }
  }

  std::string EdgeName(const Edge& edge) const {
    return "edge " + Number(edge.a) + "-" + Number(edge.b);
  }

  void CheckEdges(const EdgeTable& table) {
    for (const Edge& edge : table.edges()) {
      if (edge.use_count <= 2) continue;
      std::vector<uint32_t> faces;
      for (const EdgeUse& use : table.Uses(edge)) faces.push_back(face_number_[use.face]);
      std::sort(faces.begin(), faces.end());
      std::string list;
      for (size_t i = 0; i < faces.size() && i < 8; ++i) {
        list += (i ? ", " : "") + std::to_string(faces[i]);
      }
      if (faces.size() > 8) list += " ...";
      Add(Kind::kTripleEdge, 0, faces[2],
          EdgeName(edge) + " has " + std::to_string(faces.size()) + " faces: " + list);
    }
    for (const FlippedFace& flipped : FindFlippedFaces(good_, table)) {
      const uint32_t face = face_number_[flipped.face];
      std::string message = "face " + std::to_string(face) + " is turned against ";
      if (flipped.edge == EdgeTable::kNone) {
        message += "most faces of its part of the mesh";
      } else {
        message += "face " + std::to_string(face_number_[flipped.neighbour]) + ": both run along " +
                   EdgeName(table.edges()[flipped.edge]) + " in the same direction";
      }
      Add(Kind::kFlippedFace, 0, face, std::move(message));
    }
  }

  void CheckTJunctions(const EdgeTable& table) {
    std::vector<std::array<uint32_t, 2>> edges;
    std::vector<uint32_t> owner;
    std::vector<bool> in_good(mesh_.points.size(), false);
    for (const uint32_t v : good_.face_vertex) in_good[v] = true;
    std::vector<uint32_t> vertices;
    Vec3 low(0), high(0);
    for (uint32_t v = 0; v < mesh_.points.size(); ++v) {
      if (!in_good[v]) continue;
      const Vec3& p = mesh_.points[v];
      if (vertices.empty()) low = high = p;
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
      vertices.push_back(v);
    }
    for (const Edge& edge : table.edges()) {
      if (edge.use_count != 1) continue;
      edges.push_back({edge.a, edge.b});
      owner.push_back(face_number_[table.Uses(edge)[0].face]);
    }
    const double tolerance = 1e-9 * Length(high - low);
    for (const TJunction& t : FindTJunctions(mesh_.points, vertices, edges, tolerance, most_)) {
      Add(Kind::kTJunction, t.vertex + 1, owner[t.edge],
          "vertex " + Number(t.vertex) + " lies inside edge " + Number(edges[t.edge][0]) + "-" +
              Number(edges[t.edge][1]) + " of face " + std::to_string(owner[t.edge]));
    }
  }

  void CheckOrientation(const EdgeTable& table) {
    switch (FacingOf(good_, table)) {
      case Facing::kDown:
        Add(Kind::kClockwise, 0, 0,
            "the mesh is clockwise: every face faces down (-z); list the vertices of each face the "
            "other way round");
        break;
      case Facing::kInward:
        Add(Kind::kClockwise, 0, 0,
            "the closed mesh is inside out: its faces face inwards; list the vertices of each face "
            "the other way round");
        break;
      case Facing::kRight:
        break;
    }
  }

  std::vector<MeshDefect> Finish() {
    const auto order = [](const MeshDefect& d) {
      constexpr uint32_t kLast = 0xffffffffu;
      return std::tuple(d.vertex == 0 ? kLast : d.vertex, d.face == 0 ? kLast : d.face, d.kind);
    };
    std::stable_sort(defects_.begin(), defects_.end(),
                     [&](const MeshDefect& l, const MeshDefect& r) { return order(l) < order(r); });
    if (defects_.size() > most_) defects_.resize(most_);
    return std::move(defects_);
  }

  const Mesh& mesh_;
  const size_t most_;
  Mesh good_;
  std::vector<uint32_t> face_number_;  // of the faces of good_, from 1
  std::vector<bool> used_;
  std::array<size_t, 16> count_{};
  std::vector<MeshDefect> defects_;
};

}  // namespace

std::vector<MeshDefect> CheckMesh(const Mesh& mesh, size_t most) {
  return Checker(mesh, most).Run();
}

}  // namespace fjord
