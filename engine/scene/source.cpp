#include "engine/scene/source.h"

#include "engine/scene/limits.h"

namespace fjord {

Place SceneSource::Find(const Route& route) const {
  for (auto entry = set.rbegin(); entry != set.rend(); ++entry) {
    if (entry->first.Holds(route)) return {entry->second, 0, 0};
  }
  Place place{name, 0, 0};
  if (form != Form::kText) return place;
  const google::protobuf::TextFormat::ParseInfoTree* node = &tree;
  for (const RouteStep& step : route.steps) {
    if (step.index < 0 && step.field->is_repeated()) break;
    const auto location = node->GetLocation(step.field, step.index);
    if (location.line < 0) break;
    place.line = location.line + 1;
    place.column = location.column + 1;
    if (step.field->message_type() == nullptr) break;
    node = node->GetTreeForNested(step.field, step.index);
    if (node == nullptr) break;
  }
  return place;
}

void SceneErrors::Add(const Route& route, const std::string& message, ErrorCode code) {
  const std::string path = PrintRoute(*scene_, route);
  AddAt({code, path.empty() ? message : path + ": " + message, source_->Find(route)});
}

void SceneErrors::AddAt(Error error) {
  if (errors_.size() < limits::kErrors) {
    errors_.push_back(std::move(error));
  } else if (errors_.size() == limits::kErrors) {
    errors_.push_back(Invalid("there are more errors", {source_->name, 0, 0}));
  }
}

bool SceneErrors::Full() const { return errors_.size() > limits::kErrors; }

}  // namespace fjord
