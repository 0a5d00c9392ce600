#include "engine/fractal/surface_plan.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "engine/base/check.h"
#include "engine/base/parallel.h"
#include "engine/base/random.h"

namespace fjord {
namespace {

constexpr double kGroupLeaves = 2048;  // about so many leaves a group
constexpr size_t kAtATime = 64;        // groups counted between two looks at the limit

}  // namespace

SurfacePlan::SurfacePlan(const SurfaceRoots& roots, const CoarseSurface& coarse,
                         const SurfaceRules& rules, const WeldLimits& limits)
    : colored(!coarse.colors.empty()),
      limit(std::min<uint64_t>(limits.max_points, uint64_t{1} << 27)),
      roots_(roots),
      coarse_(coarse),
      rules_(rules),
      threads_(limits.threads) {
  const size_t count = coarse.vertices.size();
  for (size_t v = 0; v < count; ++v) {
    AddPoint(coarse.vertices[v], colored ? coarse.colors[v] : Rgb(0), coarse.identity[v], 0, false);
  }
  for (const CoarseEdge& e : coarse.edges) {
    if (e.site.coast > 0) shape.coast[e.a] = shape.coast[e.b] = 1;
  }
}

uint32_t SurfacePlan::AddPoint(const StreamVertex& v, const Rgb& color, const Identity& identity,
                               uint8_t level, bool coast) {
  shape.mesh.points.push_back(v.position);
  if (colored) shape.mesh.colors.push_back(color);
  shape.identity.push_back(identity);
  shape.level.push_back(level);
  shape.direction.push_back(v.direction);
  shape.coast.push_back(coast ? 1 : 0);
  return static_cast<uint32_t>(shape.mesh.points.size() - 1);
}

uint32_t SurfacePlan::AddBorder(uint32_t a, uint32_t b, bool coast) {
  Border border;
  border.a = a;
  border.b = b;
  border.coast = coast;
  borders.push_back(border);
  return static_cast<uint32_t>(borders.size() - 1);
}

// Borders, parts and groups, and how many points each has; false beyond the limit.
bool SurfacePlan::Make() {
  // With direction FACE every triangle has borders of its own: they gape (S18).
  const bool apart = rules_.direction == Direction::kFace;
  if (!apart) {
    for (const CoarseEdge& e : coarse_.edges) AddBorder(e.a, e.b, e.site.coast > 0);
  }
  std::vector<std::pair<Part, PatchRoot>> stack;
  for (uint32_t t = 0; t < coarse_.triangles.size(); ++t) {
    Part part;
    part.triangle = t;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t number = coarse_.triangle_edges[t][k];
      const CoarseEdge& edge = coarse_.edges[number];
      part.corner[k] = coarse_.triangles[t][k];
      part.side[k] = {apart ? AddBorder(edge.a, edge.b, edge.site.coast > 0) : number,
                      edge.a != part.corner[k]};
    }
    stack.emplace_back(part, roots_.CoarseRoot(t));
    const std::array<EdgeSite, 4> sites = roots_.SitesOf(t);
    while (!stack.empty()) {
      const auto [next, root] = std::move(stack.back());
      stack.pop_back();
      const double leaves = roots_.ExpectedLeaves(root);
      if (leaves <= kGroupLeaves) {
        AddPart(next, root, leaves);
        if (groups.size() > counted_ + kAtATime && !CountGroups(groups.size() - 1)) return false;
      } else {
        Cut(next, root, sites.data(), &stack);
        if (shape.mesh.points.size() > limit) return false;
      }
    }
  }
  return CountGroups(groups.size());
}

// Coarse triangles that become little are made together.
void SurfacePlan::AddPart(Part part, const PatchRoot& root, double leaves) {
  const bool whole = root.level == 0;
  if (!whole) {
    part.root = static_cast<uint32_t>(cut_roots_.size());
    cut_roots_.push_back(root);
  }
  leaves = std::max(leaves, 1.0);
  const auto number = static_cast<uint32_t>(parts.size());
  if (whole && open_ && open_leaves_ + leaves <= kGroupLeaves) {
    groups.back().end = number + 1;
    open_leaves_ += leaves;
  } else {
    Group group;
    group.first = number;
    group.end = number + 1;
    groups.push_back(group);
    open_ = whole;
    open_leaves_ = leaves;
  }
  parts.push_back(part);
}

// One level; every child becomes a triangle of its own.
void SurfacePlan::Cut(const Part& part, const PatchRoot& root, const EdgeSite* sites,
                      std::vector<std::pair<Part, PatchRoot>>* stack) {
  const SurfaceRules& rules = roots_.RulesOf(root, sites);
  cut_.Clear(sites, colored, limit + 16);
  roots_.Load(root, 0, rules.sites, cut_);
  const PatchStep step = cut_.Step(rules, root.level);
  FJORD_CHECK(step == PatchStep::kSplit, root.level);
  std::vector<uint32_t> point(cut_.vertices.count, kNone);
  std::vector<Side> side(cut_.edges.count);
  for (uint32_t k = 0; k < 3; ++k) {
    point[k] = part.corner[k];
    side[k] = part.side[k];
    const uint32_t slot = cut_.edges.slot[k];
    if (slot >= cut_.long_edges.count) continue;
    const size_t made = cut_.long_edges.midpoints + slot;
    const uint32_t number = part.side[k].border;
    if (borders[number].middle == kNone) {
      const Border whole = borders[number];
      const uint32_t middle =
          AddPoint(cut_.vertices.value[made], colored ? cut_.vertices.color[made] : Rgb(0),
                   MidpointIdentity(shape.identity[whole.a], shape.identity[whole.b]),
                   static_cast<uint8_t>(cut_.level + 1), whole.coast);
      const uint32_t first = AddBorder(whole.a, middle, whole.coast);
      const uint32_t second = AddBorder(middle, whole.b, whole.coast);
      borders[number].middle = middle;
      borders[number].half[0] = first;
      borders[number].half[1] = second;
    }
    const Border& whole = borders[number];
    point[made] = whole.middle;
    for (int h = 0; h < 2; ++h)
      side[cut_.long_edges.halves[h] + slot] = part.side[k].Half(whole, h);
  }
  for (size_t e = cut_.long_edges.halves[1] + cut_.long_edges.count; e < cut_.edges.count; ++e) {
    side[e] = {AddBorder(point[cut_.edges.a[e]], point[cut_.edges.b[e]], false), false};
  }
  for (size_t t = cut_.triangles.count; t-- > 0;) {
    Part child;
    child.triangle = part.triangle;
    for (int k = 0; k < 3; ++k) {
      const uint32_t edge = cut_.triangles.edge[k][t];
      child.corner[k] = point[cut_.triangles.corner[k][t]];
      child.side[k] = side[edge & ~Patch::kFlip];
      child.side[k].against ^= (edge & Patch::kFlip) != 0;
    }
    stack->emplace_back(child, roots_.ChildOf(root, cut_, t, rules.sites));
  }
}

PatchRoot SurfacePlan::RootOf(const Part& part) const {
  return part.root == kNone ? roots_.CoarseRoot(part.triangle) : cut_roots_[part.root];
}

// Makes a group's patch; false where it has too many points.
bool SurfacePlan::Expand(const Group& group, bool identities, SurfaceGroup* made) const {
  const size_t count = group.end - group.first;
  made->Clear(colored, limit + 3 * count);
  for (size_t p = group.first; p < group.end; ++p) {
    made->AddSites(roots_.SitesOf(parts[p].triangle));
  }
  // All that one of them needs is right for the others.
  const SurfaceRules* rules = nullptr;
  uint32_t level = 0;
  for (size_t i = 0; i < count; ++i) {
    const PatchRoot root = RootOf(parts[group.first + i]);
    const SurfaceRules& its = roots_.RulesOf(root, made->SitesOf(i));
    if (rules == nullptr || its.coast) rules = &its;
    level = root.level;
  }
  for (size_t i = 0; i < count; ++i) {
    roots_.Load(RootOf(parts[group.first + i]), static_cast<uint32_t>(4 * i), rules->sites,
                made->patch());
  }
  if (!identities) return made->Expand(*rules, level);
  std::vector<uint64_t> upper;
  for (size_t p = group.first; p < group.end; ++p) {
    for (const uint32_t v : parts[p].corner) upper.push_back(shape.identity[v].hi);
  }
  return made->Expand(*rules, level, upper);
}

// Of groups counted_..end, which are complete.
bool SurfacePlan::CountGroups(size_t end) {
  const size_t begin = counted_;
  counted_ = end;
  std::atomic<bool> full = false;
  ParallelFor(end - begin, threads_, [&](size_t g) {
    Group& group = groups[begin + g];
    std::unique_ptr<SurfaceGroup> made = Borrow();
    if (!Expand(group, false, made.get())) full = true;
    group.leaves = static_cast<uint32_t>(made->patch().leaves.count);
    const uint32_t corners = 3 * (group.end - group.first);
    group.inner = static_cast<uint32_t>(made->patch().vertices.count) - corners;
    for (uint32_t i = 0; i < corners; ++i) {
      const uint32_t along = made->CountAlong(i);
      parts[group.first + i / 3].along[i % 3] = along;
      group.inner -= along;
    }
    Return(std::move(made));
  });
  for (size_t g = begin; g < end; ++g) inner_ += groups[g].inner;
  return !full && shape.mesh.points.size() + inner_ <= limit;
}

std::unique_ptr<SurfaceGroup> SurfacePlan::Borrow() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (idle_.empty()) return std::make_unique<SurfaceGroup>();
  std::unique_ptr<SurfaceGroup> group = std::move(idle_.back());
  idle_.pop_back();
  return group;
}
void SurfacePlan::Return(std::unique_ptr<SurfaceGroup> group) {
  const std::lock_guard<std::mutex> lock(mutex_);
  idle_.push_back(std::move(group));
}

}  // namespace fjord
