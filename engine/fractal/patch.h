// The tables of one breadth-first patch of triangles, and the level-by-level expansion that both
// the streamed and the welded form of the surface method are made of.
//
// A level: collect the long edges; make their midpoints and halves; expand triangles sorted by how
// many long edges they have; those with none become leaves. Every new value is a pure function of
// its edge (method.h M1), every lane of every SIMD level the same operations (D2).
//
// Owned by one thread at a time. Tables keep their memory.
//
// Invariants
// P1 Vertices and edges are only appended; their numbers stay.
// P2 Edges made by one level are one run, PatchEdges::run_begin to count: only the last run can be
//    long. But under ADAPTIVE a long edge waits for its stage (stages.h).
// P3 Edge k of a triangle runs from corner k to corner k + 1, or is stored the other way round and
//    named with kFlip.
#pragma once

#include <bit>
#include <cstdint>

#include "engine/fractal/method.h"
#include "engine/fractal/patch_buffer.h"
#include "engine/fractal/surface_rules.h"

namespace fjord {

// An edge's squared rest length as it is stored: the sign bit is set where it is short.
inline bool PatchIsShort(double stored) { return std::bit_cast<uint64_t>(stored) >> 63 != 0; }
inline double PatchLength2(double stored) { return PatchIsShort(stored) ? -stored : stored; }

struct PatchVertices {
  PatchBuffer<StreamVertex> value;
  PatchBuffer<Rgb> color;         // kept only where `colored`
  PatchBuffer<double> distance2;  // as eye_distance2; kept only where SurfaceRules::staged()
  PatchBuffer<Weights> place;     // kept only where `placed`
  size_t count = 0;
  size_t limit = 0;
  bool colored = false;
  bool placed = false;  // set after Clear, before AddVertex

  void Reserve(size_t size, bool staged);
  size_t Bytes() const;
};

struct PatchEdges {
  static constexpr uint32_t kShort = 0xffffffffu;
  static constexpr uint32_t kWaits = 0xfffffffeu;  // long, but another stage's turn

  PatchBuffer<uint32_t> a, b;    // ends
  PatchBuffer<uint32_t> site;    // kept only where SurfaceRules::sites
  PatchBuffer<double> length2;   // rest pose, as stored
  PatchBuffer<double> current2;  // now; kept only where SurfaceRules::current()
  PatchBuffer<uint64_t> shares;  // left, right of each; kept only where SurfaceRules::even
  PatchBuffer<uint32_t> slot;    // place among the long edges of this level, kShort, kWaits
  size_t count = 0;
  size_t run_begin = 0;
  PatchBuffer<uint32_t> waiting;  // long edges that wait for their stage
  size_t waiting_count = 0;
  const EdgeSite* sites = nullptr;

  // How many may be long.
  size_t open() const { return count - run_begin + waiting_count; }
  void Reserve(size_t size, const SurfaceRules& rules);
  size_t Bytes() const;
};

// The long edges of one level, and where what is made of them goes.
struct PatchLongEdges {
  PatchBuffer<uint32_t> number;  // kept only for sites, shares and stages
  PatchBuffer<uint32_t> a, b;
  PatchBuffer<double> length2;  // rest pose
  PatchBuffer<double> amount;   // what the affine law gives them
  size_t count = 0;
  size_t halves[2] = {0, 0};  // first and second halves of long edge k: halves[i] + k
  size_t midpoints = 0;       // midpoint of long edge k: midpoints + k

  void Reserve(size_t size);
  size_t Bytes() const;
};

struct PatchTriangles {
  PatchBuffer<uint32_t> corner[3];
  PatchBuffer<uint32_t> edge[3];
  PatchBuffer<uint32_t> site;  // of edges made inside; kept only where SurfaceRules::sites
  size_t count = 0;

  void Reserve(size_t size, bool sites);
  size_t Bytes() const;
};

struct PatchLeaves {
  PatchBuffer<uint32_t> corner[3];
  PatchBuffer<Triangle> packed;  // filled by Patch::PackLeaves
  size_t count = 0;

  void Reserve(size_t size);
  size_t Bytes() const;
};

enum class PatchStep {
  kSplit,  // one level made
  kDone,   // nothing was left to split; every triangle is a leaf now
  kFull,   // the level would pass vertices.limit; nothing changed
};

struct Patch {
  static constexpr uint32_t kFlip = 0x80000000u;

  PatchVertices vertices;
  PatchEdges edges;
  PatchLongEdges long_edges;
  PatchTriangles triangles;
  PatchTriangles next;  // the level that is being made
  PatchLeaves leaves;
  uint32_t level = 0;  // of the edges that were halved last; under ADAPTIVE their stage - 1

  // Empties the tables.
  void Clear(const EdgeSite* edge_sites, bool with_colors, size_t most_vertices);
  uint32_t AddVertex(const StreamVertex& value, const Rgb& color, double eye_distance2,
                     const Weights& place = {});
  // `length2`: as stored. A new run begins with the first edge after Clear.
  uint32_t AddEdge(uint32_t a, uint32_t b, double length2, double current2, uint32_t site,
                   uint64_t left = 0, uint64_t right = 0);
  void AddTriangle(const Triangle& corners, const Triangle& edges_of, uint32_t site,
                   bool sites_kept);

  // One level; `edge_level` is that of the edges of the last run, not read under ADAPTIVE.
  PatchStep Step(const SurfaceRules& rules, uint32_t edge_level);
  // Leaves so far, as index triples.
  std::span<const Triangle> PackLeaves();
  size_t Bytes() const;

 private:
  void EndTriangles();
};

// Per-target kernels (patch_collect.cpp, patch_amounts.cpp, patch_midpoints.cpp,
// patch_triangles.cpp); Patch::Step is their only caller but for MeasureEdges, which sets sign and
// current2 of edges begin..end from their vertices.
void MeasureEdges(const SurfaceRules& rules, Patch& patch, size_t begin, size_t end);
void CollectLongEdges(Patch& patch, bool keep_numbers);
void CollectStage(const SurfaceRules& rules, Patch& patch);  // patch_stages.cpp
void MeasureAmounts(const SurfaceRules& rules, Patch& patch);
void SplitEdges(const SurfaceRules& rules, Patch& patch, uint32_t level);
void SplitTriangles(const SurfaceRules& rules, Patch& patch);
void InterleaveLeaves(Patch& patch);

}  // namespace fjord
