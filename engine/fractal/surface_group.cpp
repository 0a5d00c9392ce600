#include "engine/fractal/surface_group.h"

#include <cstddef>

namespace fjord {

void SurfaceGroup::Clear(bool colored, size_t most_vertices) {
  patch_.Clear(nullptr, colored, most_vertices);
  sites_.clear();
}

void SurfaceGroup::AddSites(const std::array<EdgeSite, 4>& sites) {
  sites_.insert(sites_.end(), sites.begin(), sites.end());
}

void SurfaceGroup::Begin() {
  patch_.edges.sites = sites_.data();
  pieces_.clear();
  whole_.clear();
  for (uint32_t side = 0; side < patch_.edges.count; ++side) {
    whole_.push_back(side);
    pieces_.push_back({side, side, kNone, kNone});
  }
  along_.assign(patch_.edges.count, 0);
}

void SurfaceGroup::Follow() {
  size_t kept = 0;
  const size_t end = whole_.size();
  for (size_t i = 0; i < end; ++i) {
    const uint32_t number = whole_[i];
    const uint32_t slot = patch_.edges.slot[pieces_[number].edge];
    if (slot == PatchEdges::kShort) continue;
    if (slot >= patch_.long_edges.count) {
      whole_[kept++] = number;
      continue;
    }
    const uint32_t side = pieces_[number].side;
    ++along_[side];
    pieces_[number].middle = static_cast<uint32_t>(patch_.long_edges.midpoints) + slot;
    pieces_[number].halves = static_cast<uint32_t>(pieces_.size());
    for (const size_t half : patch_.long_edges.halves) {
      whole_.push_back(static_cast<uint32_t>(pieces_.size()));
      pieces_.push_back({static_cast<uint32_t>(half) + slot, side, kNone, kNone});
    }
  }
  whole_.erase(whole_.begin() + static_cast<std::ptrdiff_t>(kept),
               whole_.begin() + static_cast<std::ptrdiff_t>(end));
}

bool SurfaceGroup::Expand(const SurfaceRules& rules, uint32_t level) {
  Begin();
  PatchStep step;
  for (; (step = patch_.Step(rules, level)) == PatchStep::kSplit; level = patch_.level + 1) {
    Follow();
  }
  return step == PatchStep::kDone;
}

bool SurfaceGroup::Expand(const SurfaceRules& rules, uint32_t level,
                          std::span<const uint64_t> corners) {
  Begin();
  upper_.assign(corners.begin(), corners.end());
  level_.assign(corners.size(), 0);
  PatchStep step;
  for (; (step = patch_.Step(rules, level)) == PatchStep::kSplit; level = patch_.level + 1) {
    Follow();
    upper_.resize(patch_.vertices.count);
    level_.resize(patch_.vertices.count, static_cast<uint8_t>(patch_.level + 1));
    for (size_t k = 0; k < patch_.long_edges.count; ++k) {
      const Identity a{0, upper_[patch_.long_edges.a[k]]}, b{0, upper_[patch_.long_edges.b[k]]};
      upper_[patch_.long_edges.midpoints + k] = MidpointIdentity(a, b).hi;
    }
  }
  return step == PatchStep::kDone;
}

std::span<const uint32_t> SurfaceGroup::Along(size_t side) {
  chain_.clear();
  Collect(static_cast<uint32_t>(side));
  return chain_;
}

void SurfaceGroup::Collect(uint32_t piece) {
  const Piece& p = pieces_[piece];
  if (p.middle == kNone) return;
  Collect(p.halves);
  chain_.push_back(p.middle);
  Collect(p.halves + 1);
}

}  // namespace fjord
