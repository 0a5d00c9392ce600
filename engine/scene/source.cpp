#include "engine/scene/source.h"

#include <algorithm>
#include <tuple>

#include "engine/scene/limits.h"

namespace fjord {

Place SceneSource::Find(const Route& route) const {
  for (auto entry = set.rbegin(); entry != set.rend(); ++entry) {
    if (entry->first.Holds(route)) return {entry->second, 0, 0};
  }
  const TextPlace found = places.Find(route);
  return {name, found.line, found.column};
}

void SceneErrors::Add(const Route& route, const std::string& message, ErrorCode code) {
  if (Refused(route)) return;
  const std::string path = PrintRoute(*scene_, route);
  AddAt({code, path.empty() ? message : path + ": " + message, source_->Find(route)});
}

void SceneErrors::Refuse(const Route& route, const std::string& message) {
  AddAt(Invalid(PrintRoute(*scene_, route) + ": " + message, source_->Find(route)));
  const auto* owner = route.steps.back().field->containing_type();
  const bool in_vector = owner == v1::Vec3::descriptor() || owner == v1::Color::descriptor();
  refused_.push_back(route);
  if (in_vector) refused_.back().steps.pop_back();
}

bool SceneErrors::Refused(const Route& route) const {
  return std::any_of(refused_.begin(), refused_.end(),
                     [&](const Route& value) { return value.Holds(route); });
}

bool SceneErrors::RefusedWithin(const Route& route) const {
  return std::any_of(refused_.begin(), refused_.end(),
                     [&](const Route& value) { return route.Holds(value); });
}

void SceneErrors::AddAt(Error error) {
  full_ = errors_.size() == limits::kErrors;
  if (!full_) errors_.push_back(std::move(error));
}

void SceneErrors::Note(const Route& route, const std::string& message) {
  if (notes_.size() >= limits::kErrors) return;
  const Place place = source_->Find(route);
  std::string at = place.file;
  if (place.line > 0) at += ':' + std::to_string(place.line);
  if (place.column > 0) at += ':' + std::to_string(place.column);
  notes_.push_back(at + ": note: " + PrintRoute(*scene_, route) + ": " + message);
}

Errors SceneErrors::Take() {
  std::stable_sort(errors_.begin(), errors_.end(), [](const Error& a, const Error& b) {
    return std::tie(a.place.file, a.place.line, a.place.column) <
           std::tie(b.place.file, b.place.line, b.place.column);
  });
  if (full_) errors_.push_back(Invalid("there are more errors", {source_->name, 0, 0}));
  return std::move(errors_);
}

}  // namespace fjord
