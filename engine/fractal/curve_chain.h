// The input of the method "curve" made ready: its vertices with identity, normal and stretch, and a
// frame for each input edge. A function of the coarse curve alone; order is the chain's.
#pragma once

#include <vector>

#include "engine/fractal/curve_rules.h"

namespace fjord {

struct CurveChain {
  std::vector<LineVertex> vertices;
  std::vector<LineFrame> frames;  // of edge i, from vertex i to the next
  std::vector<double> rest2;      // squared rest lengths of the edges
  std::vector<Rgb> colors;        // none, or one a vertex
  bool closed = false;

  size_t EdgeCount() const { return frames.size(); }
  uint32_t Next(size_t i) const {
    return static_cast<uint32_t>(i + 1 < vertices.size() ? i + 1 : 0);
  }
  LineSegment Edge(size_t i) const {
    LineSegment edge{vertices[i], vertices[Next(i)], rest2[i], 0};
    edge.a.place = Weights(1, 0, 0);
    edge.b.place = Weights(0, 1, 0);
    return edge;
  }
};

// kInvalid for fewer than two points, unequal counts, or numbers that are not finite.
Result<CurveChain> MakeCurveChain(const CoarseShape& shape, const FractalSettings& settings);

// Unit normal of the plane a curve lies in: +z where it is flat in z; otherwise of its mean plane
// (Newell), turned to +z (or +y, +x where it has no z), so that it does not flip as the curve
// moves.
Vec3 CurvePlane(const std::vector<Vec3>& points);

}  // namespace fjord
