#include "engine/scene/route.h"

#include <google/protobuf/descriptor.h>

#include <charconv>

#include "engine/scene/nearest.h"
#include "engine/scene/parameters.h"

namespace fjord {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

bool IsMessage(const FieldDescriptor& field) {
  return field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
}

// The name field of messages that have one, or null.
const FieldDescriptor* NameField(const Descriptor* type) {
  const FieldDescriptor* field = type == nullptr ? nullptr : type->FindFieldByName("name");
  const bool is_text = field != nullptr && field->cpp_type() == FieldDescriptor::CPPTYPE_STRING;
  return is_text ? field : nullptr;
}

// `field` of NameField.
const std::string& NameOf(const Message& message, const FieldDescriptor* field) {
  thread_local std::string unused;  // generated messages hand out their own
  return message.GetReflection()->GetStringReference(message, field, &unused);
}

std::vector<std::string> FieldNames(const Descriptor& type) {
  if (const EntryKind* kind = KindOf(&type); kind != nullptr) return kind->FieldNames();
  std::vector<std::string> names;
  names.reserve(static_cast<size_t>(type.field_count()));
  for (int i = 0; i < type.field_count(); ++i) names.push_back(type.field(i)->name());
  return names;
}

// The entry of a list that [selector] means; a name wins over a number.
Result<int> FindEntry(const Message* parent, const FieldDescriptor& field,
                      const std::string& selector, const std::string& list) {
  const Reflection* reflection = parent == nullptr ? nullptr : parent->GetReflection();
  const int size = parent == nullptr ? 0 : reflection->FieldSize(*parent, &field);
  const FieldDescriptor* name_field = NameField(field.message_type());
  const auto name_of = [&](int i) -> const std::string& {
    return NameOf(reflection->GetRepeatedMessage(*parent, &field, i), name_field);
  };
  for (int i = 0; i < size && name_field != nullptr; ++i) {
    if (name_of(i) == selector) return i;
  }
  uint64_t number = 0;
  const char* end = selector.data() + selector.size();
  const auto [stop, code] = std::from_chars(selector.data(), end, number);
  if (stop == end && code == std::errc()) {
    if (number >= 1 && number <= static_cast<uint64_t>(size)) return static_cast<int>(number) - 1;
    return Invalid(list + " has " + std::to_string(size) + (size == 1 ? " entry" : " entries") +
                   ", counted from 1; there is no " + selector);
  }
  std::vector<std::string> names;
  for (int i = 0; i < size && name_field != nullptr; ++i) {
    if (!name_of(i).empty()) names.push_back(name_of(i));
  }
  return Invalid(list + " has no entry named \"" + selector + "\"" + SuggestNames(selector, names));
}

// "x y z" or "r g b" by the knob's type; -1 for another name.
int PlaceInVector(const Knob& knob, const std::string& name) {
  if (knob.list || name.size() != 1) return -1;
  const std::string_view names = knob.type == KnobType::kVector  ? "xyz"
                                 : knob.type == KnobType::kColor ? "rgb"
                                                                 : "";
  const size_t at = names.find(name[0]);
  return at == std::string_view::npos ? -1 : static_cast<int>(at);
}

const v1::Parameter* FindParameter(const Message& entry, std::string_view name) {
  for (const v1::Parameter& parameter : ParametersOf(entry)) {
    if (parameter.name() == name) return &parameter;
  }
  return nullptr;
}

const Message* Child(const Message& parent, const RouteStep& step) {
  if (step.knob != nullptr) return FindParameter(parent, step.knob->name);
  const Reflection& reflection = *parent.GetReflection();
  if (step.index >= 0) {
    if (step.index >= reflection.FieldSize(parent, step.field)) return nullptr;
    return &reflection.GetRepeatedMessage(parent, step.field, step.index);
  }
  return reflection.HasField(parent, step.field) ? &reflection.GetMessage(parent, step.field)
                                                 : nullptr;
}

v1::Parameter* OpenParameter(Message* entry, const Knob& knob) {
  for (v1::Parameter& parameter : *MutableParametersOf(entry)) {
    if (parameter.name() == knob.name) return &parameter;
  }
  v1::Parameter* parameter = MutableParametersOf(entry)->Add();
  parameter->set_name(std::string(knob.name));
  return parameter;
}

Error NoField(const Descriptor& type, const std::string& name, const std::string& prefix) {
  const std::vector<std::string> names = FieldNames(type);
  return Invalid((prefix.empty() ? "a scene" : prefix) + " has no field \"" + name + "\"" +
                 SuggestNames(name, names, 32));
}

Error PlainValue(const std::string& prefix, const std::string& name) {
  return Invalid(prefix + " is a plain value; it has no field \"" + name + "\"");
}

Error NotAList(const std::string& field, const std::string& selector) {
  return Invalid(field + " is not a list; leave out [" + selector + "]");
}

Error WhichEntry(const std::string& list) {
  return Invalid(list + " is a list; say which entry, by name or number from 1: " + list + "[1]");
}

}  // namespace

RouteStep KnobStep(const Descriptor* type, std::string_view name) {
  const EntryKind* kind = KindOf(type);
  const Knob* knob = kind == nullptr ? nullptr : kind->AnyKnob(name);
  if (knob == nullptr) return {};
  const Descriptor* parameter = v1::Parameter::descriptor();
  const bool text = knob->type == KnobType::kChoice || knob->type == KnobType::kText;
  const bool whole = knob->type == KnobType::kWhole || knob->type == KnobType::kFlag;
  return {parameter->FindFieldByName(text ? "text" : whole ? "whole" : "number"), -1, knob};
}

Route Route::Then(std::string_view field, int index) const {
  const Descriptor* type =
      steps.empty() ? v1::Scene::descriptor() : steps.back().field->message_type();
  FJORD_CHECK(type != nullptr, field);
  const FieldDescriptor* found = type->FindFieldByName(std::string(field));
  Route route = *this;
  if (found == nullptr) {
    route.steps.push_back(KnobStep(type, field));
  } else {
    route.steps.push_back({found, index});
  }
  FJORD_CHECK(route.steps.back().field != nullptr, type->full_name(), field);
  return route;
}

Route Route::ThenKnob(std::string_view knob) const {
  const RouteStep step = KnobStep(steps.back().field->message_type(), knob);
  Route route = *this;
  if (step.field != nullptr) route.steps.push_back(step);
  return route;
}

bool Route::Holds(const Route& other) const {
  if (other.steps.size() < steps.size()) return false;
  for (size_t i = 0; i < steps.size(); ++i) {
    if (!(steps[i] == other.steps[i])) return false;
  }
  return true;
}

std::string PrintRoute(const v1::Scene& scene, const Route& route) {
  std::string text;
  const Message* message = &scene;
  for (const RouteStep& step : route.steps) {
    if (!text.empty()) text += '.';
    if (step.knob != nullptr) {
      const char* names = step.knob->type == KnobType::kColor ? "rgb" : "xyz";
      step.index < 0 ? text += step.knob->name : text += names[step.index];
      continue;
    }
    text += step.field->name();
    const Message* child = message != nullptr && IsMessage(*step.field) &&
                                   (step.index >= 0 || !step.field->is_repeated())
                               ? Child(*message, step)
                               : nullptr;
    if (step.index >= 0) {
      const FieldDescriptor* field = child == nullptr ? nullptr : NameField(child->GetDescriptor());
      const std::string name = field == nullptr ? std::string() : NameOf(*child, field);
      text += '[' + (IsSceneName(name) ? name : std::to_string(step.index + 1)) + ']';
    }
    message = child;
  }
  return text;
}

Result<Route> FindRoute(const v1::Scene& scene, const FieldPath& path) {
  Route route;
  const Message* message = &scene;
  const Descriptor* type = v1::Scene::descriptor();
  std::string prefix;
  for (const PathPiece& piece : path.pieces) {
    std::string here = prefix;
    if (!here.empty()) here += '.';
    here += piece.field;
    if (!route.empty() && route.steps.back().knob != nullptr) {  // a number of a vector
      const RouteStep& knob = route.steps.back();
      const int place = knob.index < 0 ? PlaceInVector(*knob.knob, piece.field) : -1;
      if (place < 0) return PlainValue(prefix, piece.field);
      if (!piece.selector.empty()) return NotAList(here, piece.selector);
      route.steps.push_back({knob.field, place, knob.knob});
      prefix = here;
      continue;
    }
    if (type == nullptr) return PlainValue(prefix, piece.field);
    const FieldDescriptor* field = type->FindFieldByName(piece.field);
    const bool hidden = KindOf(type) != nullptr && piece.field == "parameter";
    RouteStep step{hidden ? nullptr : field, -1};
    if (step.field == nullptr) step = KnobStep(type, piece.field);
    if (step.field == nullptr) return NoField(*type, piece.field, prefix);
    field = step.field;
    if (step.knob != nullptr || !field->is_repeated()) {
      if (!piece.selector.empty()) return NotAList(here, piece.selector);
    } else if (piece.selector.empty()) {
      return WhichEntry(here);
    } else {
      Result<int> entry = FindEntry(message, *field, piece.selector, here);
      if (!entry) return entry.error();
      step.index = *entry;
    }
    const auto* oneof = field->real_containing_oneof();
    if (oneof != nullptr && message != nullptr) {
      const FieldDescriptor* used =
          message->GetReflection()->GetOneofFieldDescriptor(*message, oneof);
      if (used != nullptr && used != field) {
        return Invalid(prefix + " is a " + used->name() + ", not a " + field->name());
      }
    }
    route.steps.push_back(step);
    prefix = here;
    if (step.index >= 0) prefix.append("[").append(piece.selector).append("]");
    type = step.knob != nullptr ? nullptr : field->message_type();
    message = message != nullptr && type != nullptr ? Child(*message, step) : nullptr;
  }
  return route;
}

Message* OpenParent(v1::Scene* scene, const Route& route) {
  FJORD_CHECK(!route.empty());
  Message* message = scene;
  for (size_t i = 0; i + 1 < route.steps.size(); ++i) {
    const RouteStep& step = route.steps[i];
    if (step.knob != nullptr) return OpenParameter(message, *step.knob);
    const Reflection* reflection = message->GetReflection();
    message = step.index >= 0 ? reflection->MutableRepeatedMessage(message, step.field, step.index)
                              : reflection->MutableMessage(message, step.field);
  }
  const Knob* knob = route.steps.back().knob;
  return knob != nullptr ? OpenParameter(message, *knob) : message;
}

const Message* FindParent(const v1::Scene& scene, const Route& route) {
  const Message* message = &scene;
  for (size_t i = 0; i < route.steps.size() && message != nullptr; ++i) {
    const RouteStep& step = route.steps[i];
    if (step.knob != nullptr) return Child(*message, step);
    if (i + 1 < route.steps.size()) message = Child(*message, step);
  }
  return message;
}

int NumberCount(const RouteStep& step) {
  if (step.knob != nullptr) return step.index >= 0 ? 1 : step.knob->TrackNumbers();
  if (step.field->is_repeated() && step.index < 0) return 0;
  if (step.field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) return 1;
  if (!IsMessage(*step.field)) return 0;
  const Descriptor* type = step.field->message_type();
  return type == v1::Vec3::descriptor() || type == v1::Color::descriptor() ? 3 : 0;
}

void SetNumbers(v1::Scene* scene, const Route& route, std::span<const double> values) {
  const RouteStep& last = route.steps.back();
  FJORD_CHECK(static_cast<int>(values.size()) == NumberCount(last), values.size());
  Message* parent = OpenParent(scene, route);
  const Reflection* reflection = parent->GetReflection();
  if (last.knob != nullptr) {
    auto* numbers = static_cast<v1::Parameter*>(parent)->mutable_number();
    const int width = last.knob->TrackNumbers();
    if (numbers->size() != width) numbers->Resize(width, 0);
    const int first = last.index < 0 ? 0 : last.index;
    for (size_t i = 0; i < values.size(); ++i) numbers->Set(first + static_cast<int>(i), values[i]);
    return;
  }
  if (!IsMessage(*last.field)) {
    if (last.index >= 0) {
      reflection->SetRepeatedDouble(parent, last.field, last.index, values[0]);
    } else {
      reflection->SetDouble(parent, last.field, values[0]);
    }
    return;
  }
  Message* vector = last.index >= 0
                        ? reflection->MutableRepeatedMessage(parent, last.field, last.index)
                        : reflection->MutableMessage(parent, last.field);
  for (int i = 0; i < 3; ++i) {
    vector->GetReflection()->SetDouble(vector, vector->GetDescriptor()->field(i),
                                       values[static_cast<size_t>(i)]);
  }
}

}  // namespace fjord
