// The coarse mesh of a surface made ready: vertices with normal, identity and stretch, edges with
// rest lengths and sites. Sums over neighbours run in the order of vertex numbers, so that neither
// the order of a file's triangles nor the corner they start at changes a bit (S24). Immutable once
// made.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "engine/fractal/method.h"
#include "engine/fractal/surface_rules.h"

namespace fjord {

struct CoarseEdge {
  uint32_t a = 0;  // a < b
  uint32_t b = 0;
  double length2 = 0;   // rest pose
  double current2 = 0;  // now
  uint64_t left = 0;    // shares of the triangles that run from a to b, and back (shares.h)
  uint64_t right = 0;
  EdgeSite site;  // not FACE's directions: those are the face's
};

struct CoarseSurface {
  std::vector<StreamVertex> vertices;
  std::vector<double> eye_distance2;     // of the vertices, not rounded to floats
  std::vector<Rgb> colors;               // none, or one a vertex
  std::vector<Triangle> triangles;       // smallest number first
  std::vector<Triangle> triangle_edges;  // edge k from corner k to k + 1
  std::vector<Vec3> face_normals;
  std::vector<CoarseEdge> edges;
  std::vector<Identity> identity;  // one a vertex
  double largest = 0;              // largest absolute coordinate

  size_t Bytes() const {
    return VectorBytes(vertices) + VectorBytes(eye_distance2) + VectorBytes(colors) +
           VectorBytes(triangles) + VectorBytes(triangle_edges) + VectorBytes(face_normals) +
           VectorBytes(edges) + VectorBytes(identity);
  }

  // Site of side k of a triangle, k = 3: of its inside.
  EdgeSite SiteOf(const SurfaceRules& rules, size_t triangle, int k) const;
};

Result<CoarseSurface> MakeCoarseSurface(const CoarseShape& shape, const SurfaceRules& rules,
                                        uint64_t seed, bool stretch);

}  // namespace fjord
