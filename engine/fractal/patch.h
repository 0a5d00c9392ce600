// The tables of one breadth-first patch of triangles, and the level-by-level expansion that both
// the streamed and the welded form of the surface method are made of.
//
// Layout (reference: 64-byte vertices, the rest column-wise): an edge is its two vertices, its
// squared rest length with the sign bit set when it is short, and the number of its EdgeSite; a
// triangle is three vertices and three edges, edge k from corner k to corner k + 1, the top bit set
// where the edge is stored the other way round. Edges made by one level are one run, so only the
// last run can be long; but under ADAPTIVE an edge waits for its stage (stages.h).
//
// A level: collect the long edges; make their midpoints and halves; expand triangles sorted by how
// many long edges they have; those with none become leaves. Every new value is a pure function of
// its edge (method.h M1), every lane of every SIMD level the same operations (D2).
//
// Owned by one thread at a time. Buffers keep their memory; contents beyond the counts are garbage,
// and kPatchPadding entries beyond them may be written.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>

#include "engine/fractal/method.h"
#include "engine/fractal/surface_rules.h"

namespace fjord {

inline constexpr size_t kPatchPadding = 64;

// An edge's squared rest length as it is stored.
inline bool PatchIsShort(double stored) { return std::bit_cast<uint64_t>(stored) >> 63 != 0; }
inline double PatchLength2(double stored) { return PatchIsShort(stored) ? -stored : stored; }

// Uninitialised storage on cache lines, for plain types.
template <typename T>
class PatchBuffer {
 public:
  T* data() const { return data_.get(); }
  T& operator[](size_t i) const { return data_.get()[i]; }
  size_t bytes() const { return capacity_ * sizeof(T); }

  // Room for `count` and the padding; the first `keep` entries stay.
  void Reserve(size_t count, size_t keep) {
    if (count + kPatchPadding <= capacity_) return;
    const size_t capacity = count + count / 2 + 2 * kPatchPadding;
    std::unique_ptr<T[], Free> grown(
        static_cast<T*>(::operator new (capacity * sizeof(T), std::align_val_t{64})));
    if (keep > 0) std::memcpy(static_cast<void*>(grown.get()), data_.get(), keep * sizeof(T));
    data_ = std::move(grown);
    capacity_ = capacity;
  }

 private:
  struct Free {
    void operator()(T* p) const { ::operator delete (static_cast<void*>(p), std::align_val_t{64}); }
  };
  std::unique_ptr<T[], Free> data_;
  size_t capacity_ = 0;
};

enum class PatchStep {
  kSplit,  // one level made
  kDone,   // nothing was left to split; every triangle is a leaf now
  kFull,   // the level would pass vertex_limit; nothing changed
};

struct PatchTriangles {
  PatchBuffer<uint32_t> corner[3];
  PatchBuffer<uint32_t> edge[3];
  PatchBuffer<uint32_t> site;  // of edges made inside; kept only where SurfaceRules::sites
  size_t count = 0;

  void Reserve(size_t size, bool sites);
};

struct Patch {
  static constexpr uint32_t kFlip = 0x80000000u;
  static constexpr uint32_t kShort = 0xffffffffu;
  static constexpr uint32_t kWaits = 0xfffffffeu;  // long, but another stage's turn

  PatchBuffer<StreamVertex> vertex;
  PatchBuffer<Rgb> color;
  PatchBuffer<double> distance2;  // as eye_distance2; kept only where SurfaceRules::staged()
  PatchBuffer<Weights> place;
  size_t vertex_count = 0;
  size_t vertex_limit = 0;

  PatchBuffer<uint32_t> edge_a, edge_b, edge_site;
  PatchBuffer<double> edge_length2;   // rest pose; sign bit: short
  PatchBuffer<double> edge_current2;  // now; kept only where SurfaceRules::current()
  PatchBuffer<uint64_t> edge_shares;  // left, right of each; kept only where SurfaceRules::even
  PatchBuffer<uint32_t> edge_slot;    // place among the long edges of this level, kShort, kWaits
  size_t edge_count = 0;
  size_t run_begin = 0;  // edges from here on are the last run

  // This level's long edges: number (kept only for sites and shares), ends, squared rest
  // length, and what the affine law gives them.
  PatchBuffer<uint32_t> long_edge, long_a, long_b;
  PatchBuffer<double> long_length2, long_amount;
  size_t long_count = 0;
  size_t halves[2] = {0, 0};  // first and second halves of long edge k: halves[i] + k
  size_t midpoints = 0;       // midpoint of long edge k: midpoints + k
  uint32_t level = 0;         // of the edges that were halved last; under ADAPTIVE their stage - 1
  PatchBuffer<uint32_t> waiting;  // long edges that wait for their stage
  size_t waiting_count = 0;

  PatchTriangles triangles;
  PatchTriangles next;
  PatchBuffer<uint32_t> leaf[3];
  size_t leaf_count = 0;
  PatchBuffer<Triangle> leaf_triangles;  // filled by PackLeaves

  bool colors = false;
  bool places = false;  // set after Clear, before AddVertex
  const EdgeSite* sites = nullptr;

  // Empties the tables.
  void Clear(const EdgeSite* edge_sites, bool with_colors, size_t most_vertices);
  uint32_t AddVertex(const StreamVertex& value, const Rgb& vertex_color, double eye_distance2,
                     const Weights& its_place = {});
  // `length2`: as stored. A new run begins with the first edge after Clear.
  uint32_t AddEdge(uint32_t a, uint32_t b, double length2, double current2, uint32_t site,
                   uint64_t left = 0, uint64_t right = 0);
  void AddTriangle(const Triangle& corners, const Triangle& edges, uint32_t site, bool sites_kept);

  // One level; `edge_level` is that of the edges of the last run, not read under ADAPTIVE.
  PatchStep Step(const SurfaceRules& rules, uint32_t edge_level);
  // Leaves so far, as index triples.
  std::span<const Triangle> PackLeaves();
  size_t Bytes() const;

 private:
  void EndTriangles();
};

// Per-target kernels (patch_collect.cpp, patch_midpoints.cpp, patch_triangles.cpp); Patch::Step is
// their only caller but for MeasureEdges, which sets sign and current2 of edges begin..end from
// their vertices.
void MeasureEdges(const SurfaceRules& rules, Patch& patch, size_t begin, size_t end);
void CollectLongEdges(Patch& patch, bool keep_numbers);
void CollectStage(const SurfaceRules& rules, Patch& patch);  // patch_stages.cpp
void MeasureAmounts(const SurfaceRules& rules, Patch& patch);
void SplitEdges(const SurfaceRules& rules, Patch& patch, uint32_t level);
void SplitTriangles(const SurfaceRules& rules, Patch& patch);
void InterleaveLeaves(Patch& patch);

}  // namespace fjord
