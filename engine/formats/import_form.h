// What a shape is, as far as a first scene depends on it. Pure.
#pragma once

#include <algorithm>
#include <vector>

#include "engine/formats/shape_file.h"

namespace fjord::import {

enum class Form { kCurve, kOutline, kFlatMesh, kRelief, kClosedMesh };

struct Bounds {
  Vec3 low{0}, high{0};
  bool empty = true;

  void Add(const Vec3& p);
  Vec3 Size() const { return high - low; }
  double Extent() const { return std::max({Size().x, Size().y, Size().z}); }
};

struct Judged {
  Form form = Form::kRelief;  // of the faces, else of the first curve
  bool closed = false;        // of a curve
  bool level_border = false;  // of a relief: all boundary vertices lie at the lowest height
  Bounds box;
  // Longest edge that the file's shape shall have, so that it has one look all over and no slivers
  // (File.spacing); 0: it is well as it is.
  double spacing = 0;
};

// Needs a face or a curve.
Judged Judge(const ShapeFile& shape);

// What becomes an object: the file's faces, or one of its curves.
struct Piece {
  Form form = Form::kCurve;
  bool closed = false;
  size_t curve = 0;  // from 1; 0: all that the file holds
};

std::vector<Piece> PiecesOf(const ShapeFile& shape, const Judged& judged);

}  // namespace fjord::import
