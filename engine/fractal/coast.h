// The method "coast": a mesh whose border becomes a coastline (S16, S17). Border edges (of one
// triangle only) are halved and displaced within their triangle's plane; what is emitted is
// triangles only, all wound alike, whose union is the inside of the fractal outline.
//
// Normalising: a triangle with two or three border edges is first cut at its centroid, so that no
// piece has more than one. Triangle (s,e,o), border edge s-e, midpoint m, displaced p:
//   outward   keep (s,q,o) and (q,e,o); go on with (s,p) and (p,e), apex q
//   inward    go on with (s,p) and (p,e), apex o
// [N: q is m itself as printed; here it lies further in, the less p rises, so that the halves keep
// room to move inward. The draw alone says which of the two it is, so that a moving coast has the
// same triangles in every frame. p is held back so that both halves keep a sixteenth of the area;
// the similar law is solved with that in place (HeldBackH).]
//
// Interior edges stay where they are. A root is a triangle, in order. Prepared objects are
// immutable and shared freely by threads.
#pragma once

#include <memory>

#include "engine/fractal/method.h"

namespace fjord {

// kInvalid where the shape has no triangles or the settings are not the method's.
Result<std::unique_ptr<PreparedFractal>> PrepareCoast(CoarseShape shape,
                                                      const FractalSettings& settings);

}  // namespace fjord
