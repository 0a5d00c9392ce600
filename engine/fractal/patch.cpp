#include "engine/fractal/patch.h"

#include <utility>

namespace fjord {

void PatchVertices::Reserve(size_t size, bool staged) {
  value.Reserve(size, count);
  if (colored) color.Reserve(size, count);
  if (staged) distance2.Reserve(size, count);
  if (placed) place.Reserve(size, count);
}

size_t PatchVertices::Bytes() const {
  return value.bytes() + color.bytes() + distance2.bytes() + place.bytes();
}

void PatchEdges::Reserve(size_t size, const SurfaceRules& rules) {
  a.Reserve(size, count);
  b.Reserve(size, count);
  length2.Reserve(size, count);
  slot.Reserve(size, count);
  if (rules.sites) site.Reserve(size, count);
  if (rules.current()) current2.Reserve(size, count);
  if (rules.even) shares.Reserve(2 * size, 2 * count);
}

size_t PatchEdges::Bytes() const {
  return a.bytes() + b.bytes() + site.bytes() + length2.bytes() + current2.bytes() +
         shares.bytes() + slot.bytes() + waiting.bytes();
}

void PatchLongEdges::Reserve(size_t size) {
  for (PatchBuffer<uint32_t>* list : {&number, &a, &b}) list->Reserve(size, 0);
  length2.Reserve(size, 0);
  amount.Reserve(size, 0);
}

size_t PatchLongEdges::Bytes() const {
  return number.bytes() + a.bytes() + b.bytes() + length2.bytes() + amount.bytes();
}

void PatchTriangles::Reserve(size_t size, bool sites) {
  for (int k = 0; k < 3; ++k) {
    corner[k].Reserve(size, count);
    edge[k].Reserve(size, count);
  }
  if (sites) site.Reserve(size, count);
}

size_t PatchTriangles::Bytes() const {
  size_t bytes = site.bytes();
  for (int k = 0; k < 3; ++k) bytes += corner[k].bytes() + edge[k].bytes();
  return bytes;
}

void PatchLeaves::Reserve(size_t size) {
  for (PatchBuffer<uint32_t>& column : corner) column.Reserve(size, count);
}

size_t PatchLeaves::Bytes() const {
  size_t bytes = packed.bytes();
  for (const PatchBuffer<uint32_t>& column : corner) bytes += column.bytes();
  return bytes;
}

void Patch::Clear(const EdgeSite* edge_sites, bool with_colors, size_t most_vertices) {
  vertices.count = 0;
  vertices.limit = most_vertices;
  vertices.colored = with_colors;
  vertices.placed = false;
  edges.sites = edge_sites;
  edges.count = edges.run_begin = edges.waiting_count = 0;
  long_edges.count = 0;
  triangles.count = next.count = leaves.count = 0;
}

uint32_t Patch::AddVertex(const StreamVertex& value, const Rgb& color, double eye_distance2,
                          const Weights& place) {
  const size_t at = vertices.count;
  vertices.Reserve(at + 1, true);
  vertices.value[at] = value;
  vertices.distance2[at] = eye_distance2;
  if (vertices.colored) vertices.color[at] = color;
  if (vertices.placed) vertices.place[at] = place;
  ++vertices.count;
  return static_cast<uint32_t>(at);
}

uint32_t Patch::AddEdge(uint32_t a, uint32_t b, double length2, double current2, uint32_t site,
                        uint64_t left, uint64_t right) {
  const size_t at = edges.count;
  edges.a.Reserve(at + 1, at);
  edges.b.Reserve(at + 1, at);
  edges.site.Reserve(at + 1, at);
  edges.length2.Reserve(at + 1, at);
  edges.current2.Reserve(at + 1, at);
  edges.shares.Reserve(2 * at + 2, 2 * at);
  edges.a[at] = a;
  edges.b[at] = b;
  edges.site[at] = site;
  edges.length2[at] = length2;
  edges.current2[at] = current2;
  edges.shares[2 * at] = left;
  edges.shares[2 * at + 1] = right;
  ++edges.count;
  return static_cast<uint32_t>(at);
}

void Patch::AddTriangle(const Triangle& corners, const Triangle& edges_of, uint32_t site,
                        bool sites_kept) {
  triangles.Reserve(triangles.count + 1, sites_kept);
  for (int k = 0; k < 3; ++k) {
    triangles.corner[k][triangles.count] = corners[k];
    triangles.edge[k][triangles.count] = edges_of[k];
  }
  if (sites_kept) triangles.site[triangles.count] = site;
  ++triangles.count;
}

PatchStep Patch::Step(const SurfaceRules& rules, uint32_t edge_level) {
  if (edges.open() == 0) {
    EndTriangles();
    return PatchStep::kDone;
  }
  edges.slot.Reserve(edges.count, edges.run_begin);
  long_edges.Reserve(edges.open());
  level = edge_level;
  if (rules.staged()) {
    edges.waiting.Reserve(edges.open(), edges.waiting_count);
    CollectStage(rules, *this);
  } else {
    CollectLongEdges(*this, rules.sites || rules.even);
  }
  const size_t made = long_edges.count;
  if (made == 0 || level >= rules.max_level) {
    EndTriangles();
    return PatchStep::kDone;
  }
  if (vertices.count + made > vertices.limit) return PatchStep::kFull;
  // The second halves begin on a fixed grid, so that whole vectors can be stored.
  const size_t padded = (made + 7) / 8 * 8;
  long_edges.midpoints = vertices.count;
  long_edges.halves[0] = edges.count;
  long_edges.halves[1] = edges.count + padded;
  vertices.Reserve(vertices.count + made, rules.staged());
  edges.Reserve(long_edges.halves[1] + padded + 3 * triangles.count, rules);
  next.count = 0;
  next.Reserve(4 * triangles.count, rules.sites);
  leaves.Reserve(leaves.count + triangles.count);

  if (rules.law == Law::kAffine) MeasureAmounts(rules, *this);
  SplitEdges(rules, *this, level);
  const auto halve = [&](const auto& values, auto half) {
    for (size_t k = 0; k < made; ++k) {
      values[vertices.count + k] = (values[long_edges.a[k]] + values[long_edges.b[k]]) * half;
    }
  };
  if (vertices.colored) halve(vertices.color, .5f);
  if (vertices.placed) halve(vertices.place, .5);
  edges.run_begin = long_edges.halves[0];
  vertices.count += made;
  edges.count = long_edges.halves[1] + made;
  SplitTriangles(rules, *this);
  if (rules.current()) MeasureEdges(rules, *this, edges.run_begin, edges.count);
  std::swap(triangles, next);
  return PatchStep::kSplit;
}

void Patch::EndTriangles() {
  leaves.Reserve(leaves.count + triangles.count);
  for (int k = 0; k < 3; ++k) {
    std::memcpy(&leaves.corner[k][leaves.count], triangles.corner[k].data(),
                triangles.count * sizeof(uint32_t));
  }
  leaves.count += triangles.count;
  triangles.count = 0;
}

std::span<const Triangle> Patch::PackLeaves() {
  leaves.packed.Reserve(leaves.count, 0);
  InterleaveLeaves(*this);
  return {leaves.packed.data(), leaves.count};
}

size_t Patch::Bytes() const {
  return vertices.Bytes() + edges.Bytes() + long_edges.Bytes() + triangles.Bytes() + next.Bytes() +
         leaves.Bytes();
}

}  // namespace fjord
