#include "engine/fractal/patch.h"

#include <utility>

namespace fjord {

void PatchTriangles::Reserve(size_t size, bool sites) {
  for (int k = 0; k < 3; ++k) {
    corner[k].Reserve(size, count);
    edge[k].Reserve(size, count);
  }
  if (sites) site.Reserve(size, count);
}

void Patch::Clear(const EdgeSite* edge_sites, bool with_colors, size_t most_vertices) {
  vertex_limit = most_vertices;
  sites = edge_sites;
  colors = with_colors;
  places = false;
  vertex_count = 0;
  edge_count = 0;
  run_begin = 0;
  long_count = 0;
  waiting_count = 0;
  triangles.count = 0;
  next.count = 0;
  leaf_count = 0;
}

uint32_t Patch::AddVertex(const StreamVertex& value, const Rgb& vertex_color, double eye_distance2,
                          const Weights& its_place) {
  vertex.Reserve(vertex_count + 1, vertex_count);
  vertex[vertex_count] = value;
  distance2.Reserve(vertex_count + 1, vertex_count);
  distance2[vertex_count] = eye_distance2;
  if (colors) {
    color.Reserve(vertex_count + 1, vertex_count);
    color[vertex_count] = vertex_color;
  }
  if (places) {
    place.Reserve(vertex_count + 1, vertex_count);
    place[vertex_count] = its_place;
  }
  return static_cast<uint32_t>(vertex_count++);
}

uint32_t Patch::AddEdge(uint32_t a, uint32_t b, double length2, double current2, uint32_t site,
                        uint64_t left, uint64_t right) {
  edge_a.Reserve(edge_count + 1, edge_count);
  edge_b.Reserve(edge_count + 1, edge_count);
  edge_site.Reserve(edge_count + 1, edge_count);
  edge_length2.Reserve(edge_count + 1, edge_count);
  edge_current2.Reserve(edge_count + 1, edge_count);
  edge_shares.Reserve(2 * edge_count + 2, 2 * edge_count);
  edge_a[edge_count] = a;
  edge_b[edge_count] = b;
  edge_site[edge_count] = site;
  edge_length2[edge_count] = length2;
  edge_current2[edge_count] = current2;
  edge_shares[2 * edge_count] = left;
  edge_shares[2 * edge_count + 1] = right;
  return static_cast<uint32_t>(edge_count++);
}

void Patch::AddTriangle(const Triangle& corners, const Triangle& edges, uint32_t site,
                        bool sites_kept) {
  triangles.Reserve(triangles.count + 1, sites_kept);
  for (int k = 0; k < 3; ++k) {
    triangles.corner[k][triangles.count] = corners[k];
    triangles.edge[k][triangles.count] = edges[k];
  }
  if (sites_kept) triangles.site[triangles.count] = site;
  ++triangles.count;
}

PatchStep Patch::Step(const SurfaceRules& rules, uint32_t edge_level) {
  if (edge_count - run_begin + waiting_count == 0) {
    EndTriangles();
    return PatchStep::kDone;
  }
  edge_slot.Reserve(edge_count, run_begin);
  const size_t most_long = edge_count - run_begin + waiting_count;
  for (PatchBuffer<uint32_t>* list : {&long_edge, &long_a, &long_b}) list->Reserve(most_long, 0);
  long_length2.Reserve(most_long, 0);
  long_amount.Reserve(most_long, 0);
  level = edge_level;
  if (rules.staged()) {
    waiting.Reserve(most_long, waiting_count);
    CollectStage(rules, *this);
  } else {
    CollectLongEdges(*this, rules.sites || rules.even);
  }
  if (long_count == 0 || level >= rules.max_level) {
    EndTriangles();
    return PatchStep::kDone;
  }
  if (vertex_count + long_count > vertex_limit) return PatchStep::kFull;
  // The second halves begin on a fixed grid, so that whole vectors can be stored.
  const size_t padded = (long_count + 7) / 8 * 8;
  midpoints = vertex_count;
  halves[0] = edge_count;
  halves[1] = edge_count + padded;
  const size_t edges = halves[1] + padded + 3 * triangles.count;
  vertex.Reserve(vertex_count + long_count, vertex_count);
  if (colors) color.Reserve(vertex_count + long_count, vertex_count);
  if (rules.staged()) distance2.Reserve(vertex_count + long_count, vertex_count);
  if (places) place.Reserve(vertex_count + long_count, vertex_count);
  edge_a.Reserve(edges, edge_count);
  edge_b.Reserve(edges, edge_count);
  edge_length2.Reserve(edges, edge_count);
  edge_slot.Reserve(edges, edge_count);
  if (rules.sites) edge_site.Reserve(edges, edge_count);
  if (rules.current()) edge_current2.Reserve(edges, edge_count);
  if (rules.even) edge_shares.Reserve(2 * edges, 2 * edge_count);
  next.count = 0;
  next.Reserve(4 * triangles.count, rules.sites);
  for (PatchBuffer<uint32_t>& column : leaf) {
    column.Reserve(leaf_count + triangles.count, leaf_count);
  }

  if (rules.law == Law::kAffine) MeasureAmounts(rules, *this);
  SplitEdges(rules, *this, level);
  if (colors) {
    for (size_t k = 0; k < long_count; ++k) {
      color[midpoints + k] = (color[long_a[k]] + color[long_b[k]]) * .5f;
    }
  }
  if (places) {
    for (size_t k = 0; k < long_count; ++k) {
      place[midpoints + k] = (place[long_a[k]] + place[long_b[k]]) * .5;
    }
  }
  run_begin = halves[0];
  vertex_count += long_count;
  edge_count = halves[1] + long_count;
  SplitTriangles(rules, *this);
  if (rules.current()) MeasureEdges(rules, *this, run_begin, edge_count);
  std::swap(triangles, next);
  return PatchStep::kSplit;
}

void Patch::EndTriangles() {
  for (int k = 0; k < 3; ++k) {
    leaf[k].Reserve(leaf_count + triangles.count, leaf_count);
    std::memcpy(&leaf[k][leaf_count], triangles.corner[k].data(),
                triangles.count * sizeof(uint32_t));
  }
  leaf_count += triangles.count;
  triangles.count = 0;
}

std::span<const Triangle> Patch::PackLeaves() {
  leaf_triangles.Reserve(leaf_count, 0);
  InterleaveLeaves(*this);
  return {leaf_triangles.data(), leaf_count};
}

size_t Patch::Bytes() const {
  size_t bytes = vertex.bytes() + color.bytes() + place.bytes() + distance2.bytes() +
                 waiting.bytes() + edge_a.bytes() + edge_b.bytes() + edge_site.bytes() +
                 edge_length2.bytes() + edge_current2.bytes() + edge_shares.bytes() +
                 edge_slot.bytes() + 3 * long_edge.bytes() + long_length2.bytes() +
                 long_amount.bytes() + leaf_triangles.bytes();
  for (const PatchTriangles* list : {&triangles, &next}) {
    for (int k = 0; k < 3; ++k) bytes += list->corner[k].bytes() + list->edge[k].bytes();
    bytes += list->site.bytes();
  }
  for (const PatchBuffer<uint32_t>& column : leaf) bytes += column.bytes();
  return bytes;
}

}  // namespace fjord
