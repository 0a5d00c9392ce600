#include "engine/geometry/remesh.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <string>
#include <vector>

#include "engine/geometry/paired_triangles.h"
#include "engine/geometry/primitive_parts.h"

namespace fjord {
namespace {

using primitive::kMostPoints;

constexpr double kClearlyBetter = 1e-9;  // of a sine: what is as good either way is left

constexpr double kSliverCosine = .9659258262890683;  // of 15 degrees

Error TooManyPoints(double longest, uint64_t most) {
  return MakeError(ErrorCode::kLimit, "edges no longer than " + std::to_string(longest) +
                                          " take more than " + std::to_string(most) +
                                          " points; allow longer ones");
}

// Fewer than this can't be, however well they are placed: a triangle of the largest area there is
// to each half point.
double LeastPoints(const Mesh& mesh, double longest) {
  double area = 0;
  size_t first = 0;
  for (const uint32_t size : mesh.face_size) {
    const auto at = [&](size_t k) { return mesh.points[mesh.face_vertex[first + k]]; };
    Vec3 twice(0);
    for (uint32_t k = 2; k < size; ++k) twice += glm::cross(at(k - 1) - at(0), at(k) - at(0));
    area += .5 * Length(twice);
    first += size;
  }
  return .5 * area / (.4331 * longest * longest);
}

class Remesher {
 public:
  Remesher(const Mesh& mesh, double longest)
      : mesh_(mesh),
        longest2_(longest * longest),
        shortest2_(std::numeric_limits<double>::infinity()) {
    for (uint32_t h = 0; h < mesh_.EdgeCount(); ++h) {
      to_turn_.push_back(h);
      const double length2 = mesh_.Length2(h);
      if (!mesh_.IsInner(h) && length2 > 0) shortest2_ = std::min(shortest2_, length2);
    }
  }

  // False where more points would be needed than there may be.
  bool Run(uint64_t most_points) {
    TurnEdges();
    to_refine_.clear();
    for (uint32_t t = 0; t < mesh_.TriangleCount(); ++t) to_refine_.push_back(t);
    while (!to_refine_.empty()) {
      const uint32_t t = to_refine_.front();
      to_refine_.pop_front();
      // Where the edge that was halved is not its own, the triangle is asked again.
      while (Refine(t)) {
        if (mesh_.PointCount() > most_points) return false;
      }
    }
    return true;
  }

  Mesh Take() { return mesh_.Take(); }

 private:
  // Do the angles that look at the edge from both sides add up to more than half a turn?
  bool IsBetterTurned(uint32_t h) const {
    const uint32_t t = h / 3;
    const Vec3 &c = mesh_.Apex(h), &d = mesh_.Apex(mesh_.Twin(h));
    const Vec3 ca = mesh_.From(h) - c, cb = mesh_.To(h) - c;
    const Vec3 da = mesh_.From(h) - d, db = mesh_.To(h) - d;
    const double scale = std::sqrt(glm::dot(ca, ca) * glm::dot(cb, cb)) *
                         std::sqrt(glm::dot(da, da) * glm::dot(db, db));
    const double sine = mesh_.Area(t, c, c + ca, c + cb) * glm::dot(da, db) +
                        mesh_.Area(t, d, d + db, d + da) * glm::dot(ca, cb);
    return sine < -kClearlyBetter * scale;
  }

  void TurnEdges() {
    while (!to_turn_.empty()) {
      const uint32_t h = to_turn_.front();
      to_turn_.pop_front();
      if (!mesh_.IsInner(h) || !IsBetterTurned(h) || !mesh_.CanTurn(h)) continue;
      for (const uint32_t around : mesh_.Turn(h)) {
        to_turn_.push_back(around);
        to_refine_.push_back(around / 3);
      }
    }
  }

  // Has it a small angle that is not the shape's own?
  bool IsSliver(uint32_t t) const {
    for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      const uint32_t before = PairedTriangles::Before(h);
      if (!mesh_.IsInner(h) && !mesh_.IsInner(before)) continue;
      const Vec3 &corner = mesh_.From(h), &apex = mesh_.Apex(h);
      const double cosine = glm::dot(mesh_.To(h) - corner, apex - corner);
      const double even = kEvenAngleCosine * kEvenAngleCosine;
      if (cosine > 0 && cosine * cosine > even * mesh_.Length2(h) * mesh_.Length2(before)) {
        return true;
      }
    }
    return false;
  }

  // Halves an edge that helps triangle t: going from longest edge to longer one, the first that is
  // the longest of both its triangles. False where t needs none, or that one is to stay.
  bool Refine(uint32_t t) {
    uint32_t h = mesh_.LongestOf(t);
    if (!(mesh_.Length2(h) > longest2_) && !IsSliver(t)) return false;
    while (mesh_.Twin(h) != PairedTriangles::kNone) {
      const uint32_t other = mesh_.LongestOf(mesh_.Twin(h) / 3);
      if (!mesh_.IsLonger(other, h)) break;
      h = other;
    }
    const bool short_already = !(mesh_.Length2(h) > longest2_) && mesh_.Length2(h) < 4 * shortest2_;
    if (mesh_.Shared(h) || short_already) return false;
    for (const uint32_t around : mesh_.Halve(h)) {
      to_turn_.push_back(around);
      to_refine_.push_back(around / 3);
    }
    TurnEdges();
    return true;
  }

  PairedTriangles mesh_;
  const double longest2_;
  double shortest2_;  // of the edges of borders and creases
  std::deque<uint32_t> to_turn_;
  std::deque<uint32_t> to_refine_;
};

}  // namespace

Result<Mesh> Remesh(const Mesh& mesh, double longest, uint64_t most_points) {
  if (LeastPoints(mesh, longest) > static_cast<double>(most_points)) {
    return TooManyPoints(longest, most_points);
  }
  Remesher remesher(mesh, longest);
  if (!remesher.Run(most_points)) return TooManyPoints(longest, most_points);
  return remesher.Take();
}

Result<Polyline> DivideCurve(const Polyline& curve, double longest) {
  Polyline divided;
  divided.closed = curve.closed;
  const size_t count = curve.points.size();
  for (size_t i = 0; i < count; ++i) {
    divided.points.push_back(curve.points[i]);
    if (i + 1 == count && !curve.closed) break;
    const Vec3 from = curve.points[i], along = curve.points[i + 1 < count ? i + 1 : 0] - from;
    const double pieces = Length(along) / longest;
    if (!(pieces < static_cast<double>(kMostPoints))) return TooManyPoints(longest, kMostPoints);
    const auto whole = static_cast<uint64_t>(pieces);
    const uint64_t parts = static_cast<double>(whole) < pieces ? whole + 1 : whole;
    if (divided.points.size() + parts > kMostPoints) return TooManyPoints(longest, kMostPoints);
    for (uint64_t k = 1; k < parts; ++k) {
      divided.points.push_back(from +
                               along * (static_cast<double>(k) / static_cast<double>(parts)));
    }
  }
  return divided;
}

size_t CountSlivers(const Mesh& triangles) {
  size_t slivers = 0;
  for (size_t first = 0; first < triangles.face_vertex.size(); first += 3) {
    bool is_sliver = false;
    for (size_t k = 0; k < 3; ++k) {
      const auto at = [&](size_t i) {
        return triangles.points[triangles.face_vertex[first + (k + i) % 3]];
      };
      const Vec3 u = at(1) - at(0), v = at(2) - at(0);
      is_sliver = is_sliver || glm::dot(u, v) >= kSliverCosine * (Length(u) * Length(v));
    }
    slivers += is_sliver ? 1 : 0;
  }
  return slivers;
}

}  // namespace fjord
