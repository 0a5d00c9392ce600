// The input of the method "coast" made ready (S17): every triangle cut so that no piece has more
// than one border edge, each border edge with its frame. Cuts run through a triangle's centroid and
// never through an edge, so neighbours stay joined vertex to vertex.
#pragma once

#include <vector>

#include "engine/fractal/curve_rules.h"

namespace fjord {

struct CoastVertex {
  LineVertex line;  // direction: mean of the normals of the border edges that meet here
  Vec3 normal{0};   // of the surface, unit
  bool coast = false;
};

// Counter-clockwise s, e, o. With coast: s-e is a border edge, which is displaced.
struct CoastPiece {
  CoastVertex s;
  CoastVertex e;
  CoastVertex o;
  bool coast = false;
  LineFrame frame;   // plane: the triangle's normal; normal: of s-e, outward
  double rest2 = 0;  // of s-e
};

// Of one input triangle: one, or three round its centroid.
std::vector<CoastPiece> MakePieces(std::span<const CoastVertex, 3> corners,
                                   std::span<const double, 3> border_rest2);

struct CoastMesh {
  std::vector<CoastVertex> vertices;
  std::vector<Triangle> triangles;
  std::vector<Rgb> colors;  // none, or one a vertex
  // Squared rest length of the edge from corner k of triangle t to the next, entry 3 t + k; -1
  // where it is not a border edge.
  std::vector<double> border_rest2;

  std::vector<CoastPiece> Pieces(size_t triangle) const;
};

// kInvalid for no triangles, indices or counts that do not fit, or numbers that are not finite.
Result<CoastMesh> MakeCoastMesh(const CoarseShape& shape, const FractalSettings& settings);

}  // namespace fjord
