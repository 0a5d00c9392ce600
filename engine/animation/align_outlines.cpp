// AlignOutlines of correspondence.h.
//
// Every key's vertices get a parameter u in 0..1 that means the same place on every key: arc length
// on the first; on each later key anchors take their partner's u, and between two anchors the share
// of the key's length equals the share of the length of the key before. The common points are all
// u's, merged.
#include <algorithm>

#include "engine/animation/correspondence.h"
#include "engine/animation/outline.h"

namespace fjord {
namespace {

constexpr uint32_t kNone = 0xffffffffu;

// A vertex of the key being added, in the order of u.
struct Mark {
  uint32_t vertex;
  double u;
  uint32_t anchor;  // slot that it must take, or kNone
};

// One of the common points. own[k]: the vertex of key k that lies here, or kNone.
struct Slot {
  double u;
  std::vector<uint32_t> own;
};

class Aligner {
 public:
  Aligner(std::span<const Geometry> keys, std::span<const PointPairs> pairs)
      : keys_(keys), pairs_(pairs), closed_(keys[0].closed) {}

  AlignedKeys Run() {
    std::vector<double> shares = Shares(ArcLengths(keys_[0].points, closed_));
    for (uint32_t v = 0; v < keys_[0].points.size(); ++v) {
      slots_.push_back({shares[v], std::vector<uint32_t>(keys_.size(), kNone)});
      slots_.back().own[0] = v;
    }
    for (size_t k = 1; k < keys_.size(); ++k) Merge(k, MarksOf(k));
    AlignedKeys aligned;
    for (size_t k = 0; k < keys_.size(); ++k) {
      aligned.number_of.push_back(NumbersOf(k));
      aligned.points.push_back(PointsOf(k));
    }
    return aligned;
  }

 private:
  std::vector<uint32_t> NumbersOf(size_t k) const {
    std::vector<uint32_t> numbers(keys_[k].points.size(), kNone);
    for (uint32_t s = 0; s < slots_.size(); ++s) {
      if (slots_[s].own[k] != kNone) numbers[slots_[s].own[k]] = s;
    }
    return numbers;
  }

  // Anchors between keys k-1 and k as (slot, vertex), in the order of slots.
  std::vector<std::pair<uint32_t, uint32_t>> AnchorsOf(size_t k,
                                                       std::span<const uint32_t> numbers) const {
    std::vector<std::pair<uint32_t, uint32_t>> anchors;
    for (const auto& [from, to] : pairs_[k]) anchors.emplace_back(numbers[from], to);
    std::sort(anchors.begin(), anchors.end());
    const auto last_slot = numbers.back();
    const auto last = static_cast<uint32_t>(keys_[k].points.size() - 1);
    if (closed_) {
      if (anchors.empty()) anchors.emplace_back(numbers[0], 0);
      return anchors;
    }
    // an open curve's ends meet, unless a pair says otherwise about one of them
    if (anchors.empty() || (anchors.front().first != numbers[0] && anchors.front().second != 0)) {
      anchors.insert(anchors.begin(), {numbers[0], 0});
    }
    if (anchors.back().first != last_slot && anchors.back().second != last) {
      anchors.emplace_back(last_slot, last);
    }
    return anchors;
  }

  // The u of every vertex of key k that lies between two anchors, ends left out, unwrapped.
  void MarkBetween(size_t k, const std::pair<uint32_t, uint32_t>& start,
                   const std::pair<uint32_t, uint32_t>& end, std::vector<Mark>* marks) const {
    // the key before, from anchor to anchor
    const Geometry& before = keys_[k - 1];
    std::vector<double> us;
    std::vector<Vec3> way;
    const uint32_t slots = static_cast<uint32_t>(slots_.size());
    const uint32_t span =
        end.first > start.first ? end.first - start.first : end.first + slots - start.first;
    for (uint32_t i = 0; i <= span; ++i) {
      const uint32_t s = (start.first + i) % slots;
      if (slots_[s].own[k - 1] == kNone) continue;
      us.push_back(slots_[s].u + (start.first + i >= slots ? 1 : 0));
      way.push_back(before.points[slots_[s].own[k - 1]]);
    }
    const std::vector<double> shares = Shares(ArcLengths(way, false));
    // this key, likewise
    const std::vector<Vec3>& points = keys_[k].points;
    const auto count = static_cast<uint32_t>(points.size());
    const uint32_t steps =
        end.second > start.second ? end.second - start.second : end.second + count - start.second;
    std::vector<Vec3> here;
    for (uint32_t i = 0; i <= steps; ++i) here.push_back(points[(start.second + i) % count]);
    const std::vector<double> here_shares = Shares(ArcLengths(here, false));
    size_t piece = 1;
    for (uint32_t i = 1; i < steps; ++i) {
      while (piece + 1 < shares.size() && shares[piece] < here_shares[i]) ++piece;
      const double wide = shares[piece] - shares[piece - 1];
      const double t = wide > 0 ? std::min(1.0, (here_shares[i] - shares[piece - 1]) / wide) : 0;
      marks->push_back({(start.second + i) % count,
                        us[piece - 1] + (us[piece] - us[piece - 1]) * std::max(0.0, t), kNone});
    }
  }

  std::vector<Mark> MarksOf(size_t k) const {
    const std::vector<uint32_t> numbers = NumbersOf(k - 1);
    const auto anchors = AnchorsOf(k, numbers);
    const auto count = static_cast<uint32_t>(keys_[k].points.size());
    std::vector<Mark> marks;
    if (!closed_) {  // what lies before the first anchor has no partner and grows out of it
      for (uint32_t v = 0; v < anchors[0].second; ++v) {
        marks.push_back({v, slots_[anchors[0].first].u, kNone});
      }
    }
    for (size_t a = 0; a < anchors.size(); ++a) {
      marks.push_back({anchors[a].second, slots_[anchors[a].first].u, anchors[a].first});
      const bool last = a + 1 == anchors.size();
      if (!last || closed_) MarkBetween(k, anchors[a], anchors[last ? 0 : a + 1], &marks);
    }
    if (!closed_) {
      for (uint32_t v = anchors.back().second + 1; v < count; ++v) {
        marks.push_back({v, slots_[anchors.back().first].u, kNone});
      }
      return marks;
    }
    // What runs past the end of the outline belongs at its start: some of what follows the last
    // anchor, and never an anchor, though one may lie at u 1, where an outline ends in the point it
    // began with.
    const auto last =
        std::find_if(marks.rbegin(), marks.rend(), [](const Mark& m) { return m.anchor != kNone; });
    const auto past =
        std::find_if(last.base(), marks.end(), [](const Mark& m) { return m.u >= 1; });
    for (auto mark = past; mark != marks.end(); ++mark) mark->u -= 1;
    std::rotate(marks.begin(), past, marks.end());
    return marks;
  }

  void Merge(size_t k, const std::vector<Mark>& marks) {
    std::vector<Slot> merged;
    size_t next = 0;  // slot not yet taken over
    size_t anchor = 0;
    for (size_t m = 0; m < marks.size(); ++m) {
      if (marks[m].anchor != kNone) {
        while (next < marks[m].anchor) merged.push_back(std::move(slots_[next++]));
        slots_[next].own[k] = marks[m].vertex;
        merged.push_back(std::move(slots_[next++]));
        continue;
      }
      anchor = std::max(anchor, m);
      while (anchor < marks.size() && marks[anchor].anchor == kNone) ++anchor;
      const size_t limit = anchor < marks.size() ? marks[anchor].anchor : slots_.size();
      const double u = marks[m].u;
      while (next < limit && slots_[next].u <= u - kMergeShare) {
        merged.push_back(std::move(slots_[next++]));
      }
      if (next < limit && slots_[next].u < u + kMergeShare) {
        slots_[next].own[k] = marks[m].vertex;
        merged.push_back(std::move(slots_[next++]));
      } else {
        const double least = merged.empty() ? 0 : merged.back().u;
        merged.push_back({std::max(u, least), std::vector<uint32_t>(keys_.size(), kNone)});
        merged.back().own[k] = marks[m].vertex;
      }
    }
    while (next < slots_.size()) merged.push_back(std::move(slots_[next++]));
    slots_ = std::move(merged);
  }

  std::vector<Vec3> PointsOf(size_t k) const {
    const std::vector<Vec3>& own = keys_[k].points;
    std::vector<uint32_t> held;  // slots with a vertex of this key
    for (uint32_t s = 0; s < slots_.size(); ++s) {
      if (slots_[s].own[k] != kNone) held.push_back(s);
    }
    std::vector<Vec3> points(slots_.size());
    size_t after = 0;  // the first held slot at or after s
    for (uint32_t s = 0; s < slots_.size(); ++s) {
      while (after < held.size() && held[after] < s) ++after;
      if (after < held.size() && held[after] == s) {
        points[s] = own[slots_[s].own[k]];
        continue;
      }
      const bool wraps = after == 0 || after == held.size();
      const uint32_t low = after == 0 ? held.back() : held[after - 1];
      const uint32_t high = after == held.size() ? held.front() : held[after];
      const Vec3& a = own[slots_[low].own[k]];
      const Vec3& b = own[slots_[high].own[k]];
      if (wraps && !closed_) {
        points[s] = after == 0 ? b : a;
        continue;
      }
      const double from = slots_[low].u - (after == 0 ? 1 : 0);
      const double to = slots_[high].u + (after == held.size() ? 1 : 0);
      const double t = to > from ? (slots_[s].u - from) / (to - from) : 0;
      points[s] = a + (b - a) * t;
    }
    return points;
  }

  std::span<const Geometry> keys_;
  std::span<const PointPairs> pairs_;
  const bool closed_;
  std::vector<Slot> slots_;  // in the order of u
};

}  // namespace

AlignedKeys AlignOutlines(std::span<const Geometry> keys, std::span<const PointPairs> pairs) {
  return Aligner(keys, pairs).Run();
}

}  // namespace fjord
