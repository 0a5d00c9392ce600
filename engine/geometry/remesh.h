// A mesh whose coarse triangles are no slivers, for methods that show what they start from: faces
// of many corners and fans become even triangles, long edges are divided. The shape stays what it
// was.
//
// R1 Every point stays where it is, under its number; new ones follow. Borders and creases keep
//    their course: their edges are at most divided.
// R2 Between faces of one plane (within 1e-6 radian) diagonals are turned until they are Delaunay,
//    and triangles with an angle below kEvenAngle are refined through their longest edges (Rivara),
//    unless borders or creases themselves meet at such an angle or are too short to be halved.
// R3 Only + - * / and sqrt, in an order that follows from the numbers of points and faces: the same
//    bits everywhere.
//
// Pure; near-linear in the triangles that come out.
#pragma once

#include "engine/base/result.h"
#include "engine/geometry/mesh.h"

namespace fjord {

inline constexpr double kEvenAngleCosine = .9396926207859084;  // of 20 degrees

// Triangles only, none with an edge longer than `longest` (> 0). Colours of new points are the mean
// of their edge's ends. kLimit where that takes more than `most_points`. Needs in-range indices.
// Edges of three faces and more, or of two that turn against each other, are left as they are.
inline constexpr uint64_t kMostRemeshed = 16'000'000;
Result<Mesh> Remesh(const Mesh& mesh, double longest, uint64_t most_points = kMostRemeshed);

// Each piece longer than `longest` divided into equal ones; points stay. kLimit above kMostRemeshed
// points.
Result<Polyline> DivideCurve(const Polyline& curve, double longest);

// Triangles with an angle below 15 degrees.
size_t CountSlivers(const Mesh& triangles);

}  // namespace fjord
