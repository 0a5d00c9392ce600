// The geometry behind a Shape message: inline points, a primitive, or a file's bytes.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/geometry/heights.h"
#include "engine/geometry/mesh.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {

// Either a mesh (curve false: faces as read, polygons allowed) or a curve of points in order.
// All numbers finite, all indices in range, no face of fewer than three corners.
struct Geometry {
  std::vector<Vec3> points;
  std::vector<uint32_t> face_size;
  std::vector<uint32_t> face_vertex;
  std::vector<Rgb> colors;  // none, or one a point
  bool curve = false;
  bool closed = false;
  // Drawn from its samples. Points and faces are the corners and the ground of its box then, so
  // that bounds can be had from them.
  std::optional<HeightField> heights;
  std::string left_out;            // what else its file holds, in words; empty: nothing
  std::vector<std::string> notes;  // the reader's, of what the file shows and a shape cannot hold
};

// The same with heights made into a mesh; kLimit where they are too many for one.
Result<Geometry> WithMesh(Geometry geometry);

// `assets`: digest to bytes. Errors have no place but for those of a file's own text.
Result<Geometry> DecodeShape(const v1::Shape& shape,
                             const std::map<std::string, std::string>& assets);

struct Box {
  Vec3 low{0};
  Vec3 high{0};
  bool empty = true;

  void Add(const Vec3& point);
  Vec3 Center() const { return (low + high) * .5; }
  Vec3 Size() const { return high - low; }
};

}  // namespace fjord
