#include "engine/scene/track.h"

#include <algorithm>

namespace fjord {

double Eased(v1::Key::Ease ease, double t) {
  switch (ease) {
    case v1::Key::SMOOTH:
      return t * t * (3 - 2 * t);
    case v1::Key::IN:
      return t * t;
    case v1::Key::OUT:
      return t * (2 - t);
    case v1::Key::HOLD:
      return 0;
    default:
      return t;
  }
}

std::vector<double> TrackValues(const v1::Track& track, double frame) {
  const auto& keys = track.key();
  // the last key at or before the frame
  const auto after = std::upper_bound(keys.begin(), keys.end(), frame,
                                      [](double f, const auto& key) { return f < key.frame(); });
  const auto& from = after == keys.begin() ? *after : *(after - 1);
  std::vector<double> values(from.value().begin(), from.value().end());
  if (after == keys.begin() || after == keys.end() || from.frame() == frame) return values;
  const double t = Eased(from.ease(), (frame - from.frame()) / (after->frame() - from.frame()));
  for (size_t i = 0; i < values.size(); ++i) {
    values[i] += (after->value(static_cast<int>(i)) - values[i]) * t;
  }
  return values;
}

TrackSet::TrackSet(const v1::Scene& scene) {
  for (const v1::Track& track : scene.track()) {
    Result<FieldPath> path = ParseFieldPath(track.path());
    FJORD_CHECK(path.ok(), track.path());
    Result<Route> route = FindRoute(scene, *path);
    FJORD_CHECK(route.ok(), track.path());
    entries_.push_back({*route, track});
  }
}

void TrackSet::Apply(double frame, v1::Scene* scene) const {
  for (const Entry& entry : entries_) {
    SetNumbers(scene, entry.route, TrackValues(entry.track, frame));
  }
}

bool TrackSet::Touches(const Route& route) const {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return route.Holds(entry.route) || entry.route.Holds(route);
  });
}

std::vector<TrackSet> TrackSet::OfObjects(int count) const {
  std::vector<TrackSet> sets(static_cast<size_t>(count));
  for (const Entry& entry : entries_) {
    const RouteStep& first = entry.route.steps[0];
    if (first.field->name() != "objects" || first.index >= count) continue;
    sets[static_cast<size_t>(first.index)].entries_.push_back(entry);
  }
  return sets;
}

TrackSet TrackSet::Inside(const std::vector<Route>& routes) const {
  TrackSet set;
  for (const Entry& entry : entries_) {
    const bool inside = std::any_of(routes.begin(), routes.end(), [&](const Route& route) {
      return route.Holds(entry.route) || entry.route.Holds(route);
    });
    if (inside) set.entries_.push_back(entry);
  }
  return set;
}

std::vector<double> TrackSet::KeyFrames() const {
  std::vector<double> frames;
  for (const Entry& entry : entries_) {
    for (const auto& key : entry.track.key()) frames.push_back(key.frame());
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

double TrackSet::first_frame() const {
  double first = entries_.empty() ? 1 : entries_[0].track.key(0).frame();
  for (const Entry& entry : entries_) first = std::min(first, entry.track.key(0).frame());
  return first;
}

double TrackSet::last_frame() const {
  double last = 1;
  for (const Entry& entry : entries_) {
    last = std::max(last, entry.track.key(entry.track.key_size() - 1).frame());
  }
  return last;
}

}  // namespace fjord
