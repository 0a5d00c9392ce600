#include "engine/fractal/surface.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/check.h"
#include "engine/base/random.h"
#include "engine/fractal/patch.h"
#include "engine/fractal/surface_coarse.h"
#include "engine/fractal/surface_rules.h"

namespace fjord {
namespace {

constexpr size_t kMostPoints = size_t{1} << 27;  // 32-bit offsets into 64-byte vertices

// A triangle that waits to be expanded: a coarse one, or a child of one that was too large.
struct PatchRoot {
  StreamVertex vertex[3];
  Rgb color[3];
  double length2[3];  // as in Patch
  double current2[3];
  uint32_t site[3];  // 1..3: the side of the coarse triangle that it lies on; 0: inside
  uint32_t level;
};

struct Workspace {
  Patch patch;
  std::vector<PatchRoot> stack;
};

// A thread's tables, kept between calls. A sink may stream another object meanwhile, so there can
// be more than one.
class WorkspaceLease {
 public:
  WorkspaceLease() {
    std::vector<std::unique_ptr<Workspace>>& pool = Pool();
    if (!pool.empty()) {
      space_ = std::move(pool.back());
      pool.pop_back();
    } else {
      space_ = std::make_unique<Workspace>();
    }
    space_->stack.clear();
  }
  ~WorkspaceLease() { Pool().push_back(std::move(space_)); }
  WorkspaceLease(const WorkspaceLease&) = delete;
  WorkspaceLease& operator=(const WorkspaceLease&) = delete;
  Workspace& operator*() const { return *space_; }

 private:
  static std::vector<std::unique_ptr<Workspace>>& Pool() {
    thread_local std::vector<std::unique_ptr<Workspace>> pool;
    return pool;
  }
  std::unique_ptr<Workspace> space_;
};

class PreparedSurface final : public PreparedFractal {
 public:
  PreparedSurface(CoarseSurface coarse, const SurfaceRules& rules, uint64_t seed)
      : coarse_(std::move(coarse)), rules_(rules), inland_(rules), reach_(rules_), seed_(seed) {
    // Away from coasts, edges need not know their sites where sites say nothing else.
    inland_.coast = false;
    inland_.sites = rules.direction == Direction::kEdge || rules.direction == Direction::kFace;
    // Rounding of positions, over all levels; far above what the operations of a level can lose.
    position_slack_ = coarse_.largest * 1e-12;
    Patch patch;
    patch.Clear(nullptr, false, kMostPoints);
    for (const StreamVertex& v : coarse_.vertices) patch.AddVertex(v, Rgb(0));
    for (const CoarseEdge& e : coarse_.edges) patch.AddEdge(e.a, e.b, e.length2, e.current2, 0);
    if (patch.edge_count > 0) MeasureEdges(rules_, patch, 0, patch.edge_count);
    for (size_t i = 0; i < coarse_.edges.size(); ++i) {
      coarse_.edges[i].length2 = patch.edge_length2[i];
    }
  }

  size_t RootCount() const override { return coarse_.triangles.size(); }

  Ball Bound(size_t root) const override {
    const PatchRoot r = CoarseRoot(root);
    const EdgeSite sites[4] = {SiteOf(root, 3), SiteOf(root, 0), SiteOf(root, 1), SiteOf(root, 2)};
    Ball ball;
    ball.center = (r.vertex[0].position + r.vertex[1].position + r.vertex[2].position) * (1. / 3);
    double farthest = 0;
    for (const StreamVertex& v : r.vertex) {
      farthest = std::max(farthest, Length(v.position - ball.center));
    }
    ball.radius = (farthest + ReachOf(r, sites).Any()) * (1 + 1e-9);
    return ball;
  }

  StreamStats Stream(size_t root, StreamSink& sink, size_t patch_hint) const override {
    const WorkspaceLease lease;
    Workspace& space = *lease;
    const size_t hint = std::clamp<size_t>(patch_hint, 16, 1 << 16);
    const EdgeSite sites[4] = {SiteOf(root, 3), SiteOf(root, 0), SiteOf(root, 1), SiteOf(root, 2)};
    StreamStats stats;
    space.stack.push_back(CoarseRoot(root));
    while (!space.stack.empty()) {
      const PatchRoot next = space.stack.back();
      space.stack.pop_back();
      if (!sink.Wants(next.vertex[0].position, next.vertex[1].position, next.vertex[2].position,
                      ReachOf(next, sites))) {
        ++stats.culled;
        continue;
      }
      const bool small =
          next.level >= rules_.max_level || ExpectedLeaves(next) <= static_cast<double>(hint);
      if (!small || !Expand(next, sites, hint, space.patch, sink, stats)) {
        Cut(next, sites, space, stats);
      }
    }
    return stats;
  }

  Result<WeldedShape> Weld(const WeldLimits& limits) const override;

  size_t Bytes() const override { return sizeof(*this) + coarse_.Bytes(); }

 private:
  EdgeSite SiteOf(size_t triangle, int k) const { return coarse_.SiteOf(rules_, triangle, k); }

  PatchRoot CoarseRoot(size_t root) const {
    PatchRoot r{};
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t v = coarse_.triangles[root][k];
      const CoarseEdge& edge = coarse_.edges[coarse_.triangle_edges[root][k]];
      r.vertex[k] = coarse_.vertices[v];
      if (!coarse_.colors.empty()) r.color[k] = coarse_.colors[v];
      r.length2[k] = edge.length2;
      r.current2[k] = edge.current2;
      r.site[k] = static_cast<uint32_t>(k + 1);
    }
    return r;
  }

  // What its edges are split by: those of an inland triangle stay inland.
  const SurfaceRules& RulesOf(const PatchRoot& root, const EdgeSite* sites) const {
    bool coast = sites[0].coast > 0;
    for (const uint32_t site : root.site) coast |= sites[site].coast > 0;
    return coast ? rules_ : inland_;
  }

  StreamReach ReachOf(const PatchRoot& root, const EdgeSite* sites) const {
    ReachInput input;
    input.level = root.level;
    input.stretch = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 edge = root.vertex[(k + 1) % 3].position - root.vertex[k].position;
      const double now2 = glm::dot(edge, edge);
      input.longest_rest2 = std::max(input.longest_rest2, PatchLength2(root.length2[k]));
      input.longest_now2 = std::max(input.longest_now2, now2);
      if (sites[root.site[k]].coast > 0) {
        input.longest_coast2 = std::max(input.longest_coast2, now2);
      }
      input.stretch = std::max<double>(input.stretch, root.vertex[k].stretch);
      input.farthest2 = std::max<double>(input.farthest2, root.vertex[k].eye_distance2);
    }
    const SurfaceReach::Parts parts = reach_(input);
    StreamReach reach(parts.coasts + position_slack_);
    // Directions are means of the corners' and stay in their cone: with d the least product of two,
    // a mean of them is sqrt((1 + 2 d) / 3) long at least.
    double closest = 1;
    for (int k = 0; k < 3; ++k) {
      closest =
          std::min(closest, glm::dot(root.vertex[k].direction, root.vertex[(k + 1) % 3].direction));
    }
    const bool straight =
        rules_.variant == Variant::kFixed && rules_.direction == Direction::kVertex;
    if (!straight || !(closest > -.25)) {
      reach.around += parts.offsets;
      return reach;
    }
    reach.along = parts.offsets;
    const double longest = (1 + 1e-9) / std::sqrt((1 + 2 * closest) * (1. / 3));
    for (size_t k = 0; k < 3; ++k) reach.way[k] = root.vertex[k].direction * longest;
    return reach;
  }

  // About how many leaves a triangle becomes: a leaf has edges of half to once the longest short
  // length, so the square of the longest edge over that length, times 2 to 4.
  double ExpectedLeaves(const PatchRoot& root) const {
    double most = 0;
    for (int k = 0; k < 3; ++k) {
      if (PatchIsShort(root.length2[k])) continue;
      const StreamVertex& a = root.vertex[k];
      const StreamVertex& b = root.vertex[(k + 1) % 3];
      const double length2 = rules_.current() ? root.current2[k] : root.length2[k];
      double side = rules_.floor;
      if (rules_.slope > 0) {
        const double nearest2 = std::min<double>(a.eye_distance2, b.eye_distance2);
        const double distance = std::max(
            rules_.near, std::sqrt(nearest2) - std::sqrt(length2) * .5 - rules_.eye_radius);
        side = std::max(rules_.slope * (distance * distance), 1e-300);
      }
      most = std::max(most, length2 * rules_.length_scale / side);
    }
    return most * 1.25;
  }

  void Load(const PatchRoot& root, const EdgeSite* sites, bool sites_kept, size_t limit,
            Patch& patch) const {
    patch.Clear(sites, !coarse_.colors.empty(), limit);
    for (uint32_t k = 0; k < 3; ++k) patch.AddVertex(root.vertex[k], root.color[k]);
    for (uint32_t k = 0; k < 3; ++k) {
      patch.AddEdge(k, (k + 1) % 3, root.length2[k], root.current2[k], root.site[k]);
    }
    patch.AddTriangle({0, 1, 2}, {0, 1, 2}, 0, sites_kept);
  }

  // False where the tables would grow far beyond what was expected; nothing was emitted.
  bool Expand(const PatchRoot& root, const EdgeSite* sites, size_t hint, Patch& patch,
              StreamSink& sink, StreamStats& stats) const {
    const SurfaceRules& rules = RulesOf(root, sites);
    Load(root, sites, rules.sites, 3 * hint + 64, patch);
    uint32_t level = root.level;
    PatchStep step;
    while ((step = patch.Step(rules, level)) == PatchStep::kSplit) ++level;
    if (step == PatchStep::kFull) return false;
    StreamBatch batch;
    batch.vertices = {patch.vertex.data(), patch.vertex_count};
    batch.triangles = patch.PackLeaves();
    if (patch.colors) batch.colors = {patch.color.data(), patch.vertex_count};
    stats.midpoints += patch.vertex_count - 3;
    stats.triangles += patch.leaf_count;
    stats.depth = std::max(stats.depth, level);
    sink.Take(batch);
    return true;
  }

  // One level, then every triangle becomes a root of its own.
  void Cut(const PatchRoot& root, const EdgeSite* sites, Workspace& space,
           StreamStats& stats) const {
    Patch& patch = space.patch;
    const SurfaceRules& rules = RulesOf(root, sites);
    Load(root, sites, rules.sites, kMostPoints, patch);
    const PatchStep step = patch.Step(rules, root.level);
    FJORD_CHECK(step == PatchStep::kSplit, root.level);
    stats.midpoints += patch.vertex_count - 3;
    stats.depth = std::max(stats.depth, root.level + 1);
    for (size_t t = patch.triangles.count; t-- > 0;) {
      PatchRoot child{};
      child.level = root.level + 1;
      for (int k = 0; k < 3; ++k) {
        const uint32_t v = patch.triangles.corner[k][t];
        const uint32_t e = patch.triangles.edge[k][t] & ~Patch::kFlip;
        child.vertex[k] = patch.vertex[v];
        if (patch.colors) child.color[k] = patch.color[v];
        child.length2[k] = patch.edge_length2[e];
        child.current2[k] = patch.edge_current2[e];
        child.site[k] = rules.sites ? patch.edge_site[e] : 0;
      }
      space.stack.push_back(child);
    }
  }

  CoarseSurface coarse_;
  SurfaceRules rules_;
  SurfaceRules inland_;
  SurfaceReach reach_;
  uint64_t seed_;
  double position_slack_ = 0;
};

Result<WeldedShape> PreparedSurface::Weld(const WeldLimits& limits) const {
  const size_t limit = std::min<uint64_t>(limits.max_points, kMostPoints);
  const size_t coarse_count = coarse_.vertices.size();
  const Error too_many =
      MakeError(ErrorCode::kLimit, "the shape has more than " + std::to_string(limit) +
                                       " points at this fineness; take a larger epsilon or a "
                                       "smaller max_level");
  if (coarse_count > limit) return too_many;
  const bool apart = rules_.direction == Direction::kFace;

  // Sites: faces first, then edges.
  std::vector<EdgeSite> sites;
  Patch patch;
  for (size_t t = 0; rules_.sites && t < coarse_.triangles.size(); ++t)
    sites.push_back(SiteOf(t, 3));
  const auto add_edge = [&](const CoarseEdge& e, const EdgeSite& site) {
    sites.push_back(site);
    return patch.AddEdge(e.a, e.b, e.length2, e.current2, static_cast<uint32_t>(sites.size() - 1));
  };
  patch.Clear(nullptr, !coarse_.colors.empty(), limit);
  for (size_t v = 0; v < coarse_count; ++v) {
    patch.AddVertex(coarse_.vertices[v], patch.colors ? coarse_.colors[v] : Rgb(0));
  }
  if (!apart) {
    for (const CoarseEdge& e : coarse_.edges) add_edge(e, e.site);
  }
  for (size_t t = 0; t < coarse_.triangles.size(); ++t) {
    const Triangle& corners = coarse_.triangles[t];
    Triangle edges = coarse_.triangle_edges[t];
    for (size_t k = 0; k < 3; ++k) {
      const CoarseEdge& edge = coarse_.edges[edges[k]];
      if (apart) edges[k] = add_edge(edge, SiteOf(t, static_cast<int>(k)));
      if (edge.a != corners[k]) edges[k] |= Patch::kFlip;
    }
    patch.AddTriangle(corners, edges, static_cast<uint32_t>(t), rules_.sites);
  }
  patch.sites = sites.data();

  WeldedShape welded;
  for (size_t v = 0; v < coarse_count; ++v) welded.identity.push_back(CoarseIdentity(seed_, v));
  welded.level.assign(coarse_count, 0);
  welded.coast.assign(coarse_count, 0);
  for (const CoarseEdge& e : coarse_.edges) {
    if (e.site.coast > 0) welded.coast[e.a] = welded.coast[e.b] = 1;
  }
  PatchStep step;
  for (uint32_t level = 0; (step = patch.Step(rules_, level)) == PatchStep::kSplit; ++level) {
    for (size_t k = 0; k < patch.long_count; ++k) {
      welded.identity.push_back(
          MidpointIdentity(welded.identity[patch.long_a[k]], welded.identity[patch.long_b[k]]));
      welded.level.push_back(static_cast<uint8_t>(level + 1));
      welded.coast.push_back(rules_.coast && sites[patch.edge_site[patch.long_edge[k]]].coast > 0);
    }
  }
  if (step == PatchStep::kFull) return too_many;

  welded.mesh.points.reserve(patch.vertex_count);
  welded.direction.reserve(patch.vertex_count);
  for (size_t v = 0; v < patch.vertex_count; ++v) {
    welded.mesh.points.push_back(patch.vertex[v].position);
    welded.direction.push_back(patch.vertex[v].direction);
  }
  if (patch.colors)
    welded.mesh.colors.assign(patch.color.data(), patch.color.data() + patch.vertex_count);
  welded.mesh.face_size.assign(patch.leaf_count, 3);
  welded.mesh.face_vertex.reserve(3 * patch.leaf_count);
  for (size_t t = 0; t < patch.leaf_count; ++t) {
    for (int k = 0; k < 3; ++k) welded.mesh.face_vertex.push_back(patch.leaf[k][t]);
  }
  return welded;
}

}  // namespace

Result<std::unique_ptr<PreparedFractal>> PrepareSurface(CoarseShape shape,
                                                        const FractalSettings& settings,
                                                        const AdaptiveView* view) {
  const Result<SurfaceRules> rules = MakeSurfaceRules(settings, view);
  if (!rules.ok()) return rules.error();
  Result<CoarseSurface> coarse = MakeCoarseSurface(shape, *rules, settings.seed, settings.stretch);
  if (!coarse.ok()) return coarse.error();
  return std::unique_ptr<PreparedFractal>(
      std::make_unique<PreparedSurface>(std::move(*coarse), *rules, settings.seed));
}

}  // namespace fjord
