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
#include "engine/fractal/surface_weld.h"
#include "engine/fractal/surface_workspace.h"

namespace fjord {
namespace {

constexpr size_t kMostPoints = size_t{1} << 27;  // 32-bit offsets into 64-byte vertices

class PreparedSurface final : public PreparedFractal, private SurfaceRoots {
 public:
  PreparedSurface(CoarseSurface coarse, const SurfaceRules& rules)
      : coarse_(std::move(coarse)), rules_(rules), inland_(rules), reach_(rules_) {
    // Away from coasts, edges need not know their sites where sites say nothing else.
    inland_.coast = false;
    inland_.sites = rules.direction == Direction::kEdge || rules.direction == Direction::kFace;
    // Rounding of positions, over all levels; far above what the operations of a level can lose.
    position_slack_ = coarse_.largest * 1e-12;
    Patch patch;
    patch.Clear(nullptr, false, kMostPoints);
    for (size_t v = 0; v < coarse_.vertices.size(); ++v) {
      patch.AddVertex(coarse_.vertices[v], Rgb(0), coarse_.eye_distance2[v]);
    }
    for (const CoarseEdge& e : coarse_.edges) patch.AddEdge(e.a, e.b, e.length2, e.current2, 0);
    if (patch.edges.count > 0) MeasureEdges(rules_, patch, 0, patch.edges.count);
    for (size_t i = 0; i < coarse_.edges.size(); ++i) {
      coarse_.edges[i].length2 = patch.edges.length2[i];
    }
  }

  size_t RootCount() const override { return coarse_.triangles.size(); }

  Triangle Corners(uint32_t element) const override { return coarse_.triangles[element]; }

  Ball Bound(size_t root) const override {
    const PatchRoot r = CoarseRoot(root);
    const std::array<EdgeSite, 4> sites = SitesOf(root);
    Ball ball;
    ball.center = (r.vertex[0].position + r.vertex[1].position + r.vertex[2].position) * (1. / 3);
    double farthest = 0;
    for (const StreamVertex& v : r.vertex) {
      farthest = std::max(farthest, Length(v.position - ball.center));
    }
    ball.radius = (farthest + ReachOf(r, sites.data()).Any()) * (1 + 1e-9);
    return ball;
  }

  StreamStats Stream(size_t root, StreamSink& sink, size_t patch_hint) const override {
    const SurfaceWorkspaceLease lease;
    SurfaceWorkspace& space = *lease;
    const size_t hint = std::clamp<size_t>(patch_hint, 16, 1 << 16);
    const std::array<EdgeSite, 4> sites = SitesOf(root);
    StreamStats stats;
    space.stack.push_back(CoarseRoot(root));
    while (!space.stack.empty()) {
      const PatchRoot next = space.stack.back();
      space.stack.pop_back();
      if (!sink.Wants(next.vertex[0].position, next.vertex[1].position, next.vertex[2].position,
                      ReachOf(next, sites.data()))) {
        ++stats.culled;
        continue;
      }
      const bool small = ExpectedLeaves(next) <= static_cast<double>(hint);
      if (!small || !Expand(next, root, sites.data(), hint, space.patch, sink, stats)) {
        Cut(next, sites.data(), sink.ReadsPlaces(), space, stats);
      }
    }
    return stats;
  }

  Result<WeldedShape> Weld(const WeldLimits& limits) const override {
    return WeldSurface(*this, coarse_, rules_, limits);
  }

  size_t Bytes() const override { return sizeof(*this) + coarse_.Bytes(); }

 private:
  EdgeSite SiteOf(size_t triangle, int k) const { return coarse_.SiteOf(rules_, triangle, k); }

  std::array<EdgeSite, 4> SitesOf(size_t t) const override {
    return {SiteOf(t, 3), SiteOf(t, 0), SiteOf(t, 1), SiteOf(t, 2)};
  }

  PatchRoot CoarseRoot(size_t root) const override {
    PatchRoot r{};
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t v = coarse_.triangles[root][k];
      const CoarseEdge& edge = coarse_.edges[coarse_.triangle_edges[root][k]];
      r.vertex[k] = coarse_.vertices[v];
      r.eye_distance2[k] = coarse_.eye_distance2[v];
      if (!coarse_.colors.empty()) r.color[k] = coarse_.colors[v];
      r.place[k] = Weights(k == 0, k == 1, k == 2);
      r.length2[k] = edge.length2;
      r.current2[k] = edge.current2;
      r.inside[k] = edge.a == v ? edge.left : edge.right;
      r.outside[k] = edge.a == v ? edge.right : edge.left;
      r.site[k] = static_cast<uint32_t>(k + 1);
    }
    return r;
  }

  // What its edges are split by: those of an inland triangle stay inland.
  const SurfaceRules& RulesOf(const PatchRoot& root, const EdgeSite* sites) const override {
    bool coast = sites[0].coast > 0;
    for (const uint32_t site : root.site) coast |= sites[site].coast > 0;
    return coast ? rules_ : inland_;
  }

  // The lowest level of its edges that can still be halved.
  uint32_t LevelOf(const PatchRoot& root) const {
    if (!rules_.staged()) return root.level;
    uint32_t level = rules_.max_level;
    for (const double length2 : root.length2) {
      if (!PatchIsShort(length2)) level = std::min(level, rules_.stages.StageOf(length2) - 1);
    }
    return level;
  }

  StreamReach ReachOf(const PatchRoot& root, const EdgeSite* sites) const {
    ReachInput input;
    input.level = LevelOf(root);
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
  double ExpectedLeaves(const PatchRoot& root) const override {
    if (LevelOf(root) >= rules_.max_level) return 1;
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
    // A stage's edges are longer than its own length.
    return most * (rules_.staged() ? .6 : 1.25);
  }

  void Load(const PatchRoot& root, uint32_t first_site, bool sites_kept,
            Patch& patch) const override {
    Triangle corners, edges;
    for (size_t k = 0; k < 3; ++k) {
      corners[k] =
          patch.AddVertex(root.vertex[k], root.color[k], root.eye_distance2[k], root.place[k]);
    }
    for (size_t k = 0; k < 3; ++k) {
      edges[k] = patch.AddEdge(corners[k], corners[(k + 1) % 3], root.length2[k], root.current2[k],
                               first_site + root.site[k], root.inside[k], root.outside[k]);
    }
    patch.AddTriangle(corners, edges, first_site, sites_kept);
  }

  // False where the tables would grow far beyond what was expected; nothing was emitted.
  bool Expand(const PatchRoot& root, size_t element, const EdgeSite* sites, size_t hint,
              Patch& patch, StreamSink& sink, StreamStats& stats) const {
    const SurfaceRules& rules = RulesOf(root, sites);
    patch.Clear(sites, false, 3 * hint + 64);
    patch.vertices.placed = sink.ReadsPlaces();
    Load(root, 0, rules.sites, patch);
    uint32_t level = root.level;
    PatchStep step;
    while ((step = patch.Step(rules, level)) == PatchStep::kSplit) level = patch.level + 1;
    if (step == PatchStep::kFull) return false;
    StreamBatch batch;
    batch.vertices = {patch.vertices.value.data(), patch.vertices.count};
    batch.triangles = patch.PackLeaves();
    if (patch.vertices.placed) batch.places = {patch.vertices.place.data(), patch.vertices.count};
    batch.element = static_cast<uint32_t>(element);
    stats.midpoints += patch.vertices.count - 3;
    stats.triangles += patch.leaves.count;
    stats.depth = std::max(stats.depth, level);
    sink.Take(batch);
    return true;
  }

  // One level, then every triangle becomes a root of its own.
  void Cut(const PatchRoot& root, const EdgeSite* sites, bool places, SurfaceWorkspace& space,
           StreamStats& stats) const {
    Patch& patch = space.patch;
    const SurfaceRules& rules = RulesOf(root, sites);
    patch.Clear(sites, false, kMostPoints);
    patch.vertices.placed = places;
    Load(root, 0, rules.sites, patch);
    const PatchStep step = patch.Step(rules, root.level);
    FJORD_CHECK(step == PatchStep::kSplit, root.level);
    stats.midpoints += patch.vertices.count - 3;
    stats.depth = std::max(stats.depth, patch.level + 1);
    for (size_t t = patch.triangles.count; t-- > 0;) {
      space.stack.push_back(ChildOf(root, patch, t, rules.sites));
    }
  }

  PatchRoot ChildOf(const PatchRoot& parent, const Patch& patch, size_t t,
                    bool sites_kept) const override {
    PatchRoot child{};
    child.level = parent.level + 1;
    for (int k = 0; k < 3; ++k) {
      const uint32_t v = patch.triangles.corner[k][t];
      const uint32_t used = patch.triangles.edge[k][t];
      const uint32_t e = used & ~Patch::kFlip;
      child.vertex[k] = patch.vertices.value[v];
      if (rules_.staged()) child.eye_distance2[k] = patch.vertices.distance2[v];
      if (patch.vertices.colored) child.color[k] = patch.vertices.color[v];
      if (patch.vertices.placed) child.place[k] = patch.vertices.place[v];
      child.length2[k] = patch.edges.length2[e];
      child.current2[k] = patch.edges.current2[e];
      if (rules_.even) {
        child.inside[k] = patch.edges.shares[used == e ? 2 * e : 2 * e + 1];
        child.outside[k] = patch.edges.shares[used == e ? 2 * e + 1 : 2 * e];
      }
      child.site[k] = sites_kept ? patch.edges.site[e] : 0;
    }
    return child;
  }

  CoarseSurface coarse_;
  SurfaceRules rules_;
  SurfaceRules inland_;
  SurfaceReach reach_;
  double position_slack_ = 0;
};

}  // namespace

Result<std::unique_ptr<PreparedFractal>> PrepareSurface(CoarseShape shape,
                                                        const FractalSettings& settings) {
  Result<SurfaceRules> rules = MakeSurfaceRules(settings);
  if (!rules.ok()) return rules.error();
  Result<CoarseSurface> coarse = MakeCoarseSurface(shape, *rules, settings.seed, settings.stretch);
  if (!coarse.ok()) return coarse.error();
  double longest2 = 0;
  for (const CoarseEdge& edge : coarse->edges) longest2 = std::max(longest2, edge.length2);
  rules->stages.SetUnit(longest2);
  return std::unique_ptr<PreparedFractal>(
      std::make_unique<PreparedSurface>(std::move(*coarse), *rules));
}

}  // namespace fjord
