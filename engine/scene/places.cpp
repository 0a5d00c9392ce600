#include "engine/scene/places.h"

namespace fjord {

int PlaceTree::KeyOf(const RouteStep& step) const {
  if (step.knob == nullptr) return step.field->number();
  if (step.index >= 0) return step.index + 1;  // a number of a vector
  const auto found = knobs_.find(step.knob->name);
  return found == knobs_.end() ? 0 : found->second;
}

int PlaceTree::Add(int parent, const RouteStep& step, TextPlace place) {
  if (step.knob != nullptr && step.index < 0)
    knobs_.try_emplace(std::string(step.knob->name), -1 - static_cast<int>(knobs_.size()));
  const int made = static_cast<int>(nodes_.size());
  nodes_.push_back({KeyOf(step), step.index, place});
  Node& owner = nodes_[static_cast<size_t>(parent)];
  if (owner.last_child >= 0) {
    nodes_[static_cast<size_t>(owner.last_child)].next = made;
  } else {
    owner.first_child = made;
  }
  owner.last_child = made;
  return made;
}

TextPlace PlaceTree::Find(const Route& route) const {
  TextPlace place;
  int at = kRoot;
  for (const RouteStep& step : route.steps) {
    const int key = KeyOf(step);
    int child = nodes_[static_cast<size_t>(at)].first_child;
    const auto is_it = [&](const Node& node) {
      return node.key == key && node.index == step.index;
    };
    while (child >= 0 && !is_it(nodes_[static_cast<size_t>(child)]))
      child = nodes_[static_cast<size_t>(child)].next;
    if (child < 0) break;
    at = child;
    place = nodes_[static_cast<size_t>(at)].place;
  }
  return place;
}

}  // namespace fjord
