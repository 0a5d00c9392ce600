// The method "surface": triangle meshes roughened by midpoint displacement (S18-S24), for terrain,
// planets and any closed solid.
//
// Direction rules: VERTEX, the mean of the ends' normals, kept by the new vertex (S20, the method
// of choice); EDGE, the mean of the two input faces on input edges and the face's normal inside
// (S19); FACE, the input face's normal everywhere, which opens gaps along input edges (S18, kept to
// show it); UP, +z. Variants: FIXED as it is; CURRENT turned square to the edge being halved;
// PERTURBED with a small random tangent part on top. The direction that a vertex keeps is that of
// the rule, before variants and coasts, so that surfaces do not drift [T of S22 repaired].
//
// With `coast`, border edges move in their horizontal plane, square to themselves, by the similar
// law with coast_H; their midpoints keep the exact mean height of their ends (S22). An offset is at
// most .49 of the edge, so that a shore cannot fold back over its own edge; a spike whose apex lies
// nearer than that to its border can still be crossed.
//
// Welded: with FACE every input triangle has borders of its own, so that the gaps are in the mesh.
// Memory of Weld is what it returns, about 100 bytes a point with its faces, 44 where the mesh is
// enough.
//
// A root is an input triangle (those that name a vertex twice are left out). Prepared objects are
// immutable and shared freely by threads; each thread keeps its tables, under 4 MB at a patch_hint
// of 2048.
#pragma once

#include <memory>

#include "engine/fractal/method.h"

namespace fjord {

// kInvalid where the shape is no mesh, its arrays do not fit together, the settings are not the
// method's, or the fineness would never end.
Result<std::unique_ptr<PreparedFractal>> PrepareSurface(CoarseShape shape,
                                                        const FractalSettings& settings);

}  // namespace fjord
