// What a fractal method is: it takes the coarse shape of one frame and makes fine elements of it,
// in two forms that give the same vertices bit for bit:
// - streamed, root by root, for rendering: nothing is kept, memory follows depth, parts that cannot
//   touch the picture are never made;
// - welded, for files and checks: shared vertices once, each with its 128-bit identity.
//
// A prepared object is immutable and may be used by any number of threads. A method's entry is one
// file in engine/fractal/methods and one line in registry.cpp: scene reader, presets, docs, frame
// key, tests, benches and the exactness gate loop over the registry and its tables.
//
// Invariants
// M1 A new vertex depends on the edge it halves and the settings alone: no neighbour, order,
//    thread, frame number or machine (S3, S4, S24).
// M2 Everything that Stream(root) emits lies inside Bound(root).
// M3 Streamed and welded vertices have equal bits, at every SIMD level.
// M4 Stream always ends: no edge passes settings.max_level.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/base/random.h"
#include "engine/base/result.h"
#include "engine/fractal/settings.h"
#include "engine/geometry/heights.h"
#include "engine/geometry/mesh.h"
#include "engine/knobs/registry.h"

namespace fjord {

template <typename T>
size_t VectorBytes(const std::vector<T>& list) {
  return list.capacity() * sizeof(T);
}

// The coarse shape of one object in one frame: a mesh, a curve, or heights. A mesh has the form
// that its method takes (Takes): triangles, cut by the rest pose, or its faces as they are.
struct CoarseShape {
  std::vector<Vec3> now;            // object space
  std::vector<Vec3> rest;           // as many as now
  std::vector<Triangle> triangles;  // counter-clockwise from outside, smallest index first
  bool curve = false;               // now, in order, is a polyline
  bool closed = false;
  std::vector<Rgb> colors;  // none, or one a vertex
  // Takes::kFaces, as in Mesh: vertices of each face, three or more, and their numbers.
  std::vector<uint32_t> face_size;
  std::vector<uint32_t> face_vertex;
  std::optional<HeightField> heights;  // then nothing above is there
  Vec3 heights_rest{0};                // its size in the rest pose

  size_t Bytes() const {
    return VectorBytes(now) + VectorBytes(rest) + VectorBytes(triangles) + VectorBytes(colors) +
           VectorBytes(face_size) + VectorBytes(face_vertex);
  }
};

struct Ball {
  Vec3 center{0};
  double radius = 0;
};

// 64 bytes, the unit of the streaming kernels.
struct StreamVertex {
  Vec3 position;
  Vec3 direction;  // unit normal that its children's directions are made from
  uint64_t id;     // Identity::lo
  float stretch;
  float eye_distance2;  // squared distance to Fineness::eye in the rest pose
};
static_assert(sizeof(StreamVertex) == 64);

// Where a vertex lies in the coarse element that it was made from: the weights of the element's
// corners, whose sum is 1 (a segment: the third is 0). A midpoint's are the exact means of its
// ends', dyadic fractions, wherever the midpoint is moved to: so what a coarse vertex has (colour,
// rest position, ...) is known anywhere on the fine surface without being carried there.
using Weights = Vec3;

// Leaves of one patch. Spans are valid during the call only.
struct StreamBatch {
  std::span<const StreamVertex> vertices;
  std::span<const Triangle> triangles;                // index vertices
  std::span<const std::array<uint32_t, 2>> segments;  // curves: index vertices, in order
  std::span<const Weights> places;  // one a vertex where the sink reads them, all in `element`
  uint32_t element = 0;             // PreparedFractal::Corners
};

// How far from a triangle what is made of it can lie: at p + s w + r, p in the triangle, |s| <=
// along, w in the hull of `way`, |r| <= around. Terrain moves along its normals, so a tile left or
// right of it is further away than one above.
struct StreamReach {
  StreamReach(double all_around) : around(all_around) {}  // NOLINT: a number is a reach

  double around = 0;
  double along = 0;
  std::array<Vec3, 3> way{Vec3(0), Vec3(0), Vec3(0)};

  // How far towards either side along the unit vector `direction`.
  double Towards(const Vec3& direction) const {
    double most = 0;
    for (const Vec3& w : way) {
      const double d = w.x * direction.x + w.y * direction.y + w.z * direction.z;
      most = std::max(most, d < 0 ? -d : d);
    }
    return around + along * most;
  }
  // How far at all.
  double Any() const {
    return around + along * std::max(std::max(Length(way[0]), Length(way[1])), Length(way[2]));
  }
};

// What the consumer of a stream says. Called from the thread that streams.
class StreamSink {
 public:
  virtual ~StreamSink() = default;
  // May anything within `reach` of the triangle (or, for curves, of the segment a-b, with c = b)
  // be wanted? Object space, now. Must never say no wrongly; yes costs time only.
  virtual bool Wants(const Vec3& a, const Vec3& b, const Vec3& c, const StreamReach& reach) = 0;
  virtual void Take(const StreamBatch& batch) = 0;
  // Are batches to say where their vertices lie?
  virtual bool ReadsPlaces() const { return false; }
};

struct StreamStats {
  uint64_t midpoints = 0;
  uint64_t triangles = 0;  // leaves emitted
  uint64_t culled = 0;     // subtrees not made
  uint32_t depth = 0;
};

// Welded vertices: coarse ones first, the others in an order that depends on shape and settings
// alone. Those of a curve: in the order of the chain.
struct WeldedShape {
  Mesh mesh;  // triangles; empty faces for a curve
  bool curve = false;
  bool closed = false;             // curve
  std::vector<Identity> identity;  // one a point
  std::vector<uint8_t> level;      // one a point
  std::vector<Vec3> direction;     // one a point
  std::vector<uint8_t> coast;      // one a point: lies on a coast
};

struct WeldLimits {
  uint64_t max_points = 50'000'000;
  int threads = 1;      // at most; 0: one a core
  bool details = true;  // false: the mesh is enough, the rest may be left empty
};

class PreparedFractal {
 public:
  virtual ~PreparedFractal() = default;
  virtual size_t RootCount() const = 0;
  // The coarse vertices that the weights of a place in that element belong to.
  virtual Triangle Corners(uint32_t element) const = 0;
  // Object space; all that the root can become, rounding included (S7).
  virtual Ball Bound(size_t root) const = 0;
  // patch_hint: about how many leaves to make at a time (256..4096); never changes a bit.
  virtual StreamStats Stream(size_t root, StreamSink& sink, size_t patch_hint) const = 0;
  virtual Result<WeldedShape> Weld(const WeldLimits& limits) const = 0;
  // About what it holds in memory, so that a cache can keep its bound.
  virtual size_t Bytes() const = 0;
};

// What a method reads of a shape: triangles, a curve, or a mesh of faces of any size.
enum class Takes : uint8_t { kTriangles = 1, kCurve = 2, kFaces = 3 };

// All settings of one object.
struct MethodSettings : FractalCommon {
  std::any own;  // the method's struct; empty where there is no method
};

// An entry of the registry (registry.h): a name, a version, a summary and the table of the method's
// own knobs, then what is particular to methods.
struct MethodInfo : EntryInfo {
  Takes takes = Takes::kTriangles;
  // `own`: the method's struct, within its table's ranges and rules (PrepareMethod sees to it).
  Result<std::unique_ptr<PreparedFractal>> (*prepare)(CoarseShape shape,
                                                      const FractalCommon& common,
                                                      const std::any& own) = nullptr;
  // Splits the borders of a mesh alone: what it makes follows their length and not the area.
  bool borders_only = false;
  // What moves vertices, of methods that displace midpoints, so that the cost of a scene can be
  // estimated. Null: a shape is taken to keep its size.
  FractalSettings (*midpoint)(const FractalCommon& common, const std::any& own) = nullptr;
};

}  // namespace fjord
