#include "engine/scene/binder.h"

#include <google/protobuf/descriptor.h>

#include <algorithm>

#include "engine/scene/limits.h"
#include "engine/scene/nearest.h"
#include "engine/scene/parameters.h"

namespace fjord {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

const FieldDescriptor* FindField(const Descriptor& type, const EntryKind* kind,
                                 const std::string& name, bool json) {
  const FieldDescriptor* field = type.FindFieldByName(name);
  if (field == nullptr && json) field = type.FindFieldByCamelcaseName(name);
  return field != nullptr && kind != nullptr && field->name() == "parameter" ? nullptr : field;
}

std::vector<std::string> NamesIn(const Descriptor& type, const EntryKind* kind) {
  if (kind != nullptr) return kind->FieldNames();
  std::vector<std::string> names;
  for (int i = 0; i < type.field_count(); ++i) names.push_back(type.field(i)->name());
  return names;
}

bool IsTriple(const FieldDescriptor& field) {
  return field.message_type() == v1::Vec3::descriptor() ||
         field.message_type() == v1::Color::descriptor();
}

}  // namespace

MessageBinder::MessageBinder(Message* root, std::string file, bool json, PlaceTree* places)
    : file_(std::move(file)), json_(json), places_(places) {
  Level level;
  level.message = root;
  level.kind = KindOf(root->GetDescriptor());
  levels_.push_back(std::move(level));
}

void MessageBinder::Fail(TextPlace at, const std::string& message) {
  if (errors_.size() < limits::kErrors) {
    errors_.push_back(Invalid(message, {file_, at.line, at.column}));
  } else if (!full_) {
    errors_.push_back(Invalid("there are more errors", {file_, 0, 0}));
    full_ = true;
  }
}

void MessageBinder::Refuse(TextPlace at, const std::string& message) {
  errors_.clear();
  Fail(at, message);
  full_ = true;
}

void MessageBinder::Field(const std::string& name, TextPlace at) {
  if (passing_ > 0 || full_) return;
  Level& level = top();
  level.target = {};
  level.name = name;
  level.place = at;
  level.in_list = false;
  const auto twice = [&](const std::string& known) {
    if (std::find(level.given.begin(), level.given.end(), known) != level.given.end()) return true;
    level.given.push_back(known);
    return false;
  };
  if (level.message == nullptr) {  // a part of a vector
    const size_t part = name.size() == 1 ? level.parts.find(name[0]) : std::string_view::npos;
    if (part == std::string_view::npos) {
      std::vector<std::string> parts;
      for (const char c : level.parts) parts.emplace_back(1, c);
      return Fail(at, "there is no field \"" + name + "\"" + SuggestNames(name, parts));
    }
    if (twice(name)) return Fail(at, "field " + name + " is given twice");
    const RouteStep& knob = levels_[levels_.size() - 2].target;
    level.target = {knob.field, static_cast<int>(part), knob.knob};
    return;
  }
  const Descriptor& type = *level.message->GetDescriptor();
  const FieldDescriptor* field = FindField(type, level.kind, name, json_);
  if (field != nullptr) {
    if (!field->is_repeated() && twice(field->name()))
      return Fail(at, "field " + name + " is given twice");
    const auto* oneof = field->real_containing_oneof();
    const Reflection& reflection = *level.message->GetReflection();
    if (oneof != nullptr && reflection.HasOneof(*level.message, oneof)) {
      return Fail(at, "give " + reflection.GetOneofFieldDescriptor(*level.message, oneof)->name() +
                          " or " + name + ", not both");
    }
    level.target = {field, -1};
    return;
  }
  const RouteStep knob = level.kind == nullptr ? RouteStep{} : KnobStep(&type, name);
  if (knob.field == nullptr) {
    return Fail(at, type.name() + " has no field \"" + name + "\"" +
                        SuggestNames(name, NamesIn(type, level.kind), 32));
  }
  if (twice(name) && !knob.knob->list) return Fail(at, "field " + name + " is given twice");
  level.target = knob;
}

int MessageBinder::AddPlace(TextPlace at) {
  Level& level = top();
  RouteStep step = level.target;
  if (step.knob == nullptr && step.field->is_repeated()) {
    step.index = level.message->GetReflection()->FieldSize(*level.message, step.field);
  }
  return places_ == nullptr ? 0 : places_->Add(level.node, step, level.in_list ? at : level.place);
}

bool MessageBinder::Push(Level level, TextPlace at) {
  if (levels_.size() >= limits::kMessageDepth) {
    Fail(at, "nested too deep; a scene needs less than " + std::to_string(limits::kMessageDepth));
    full_ = true;
    return false;
  }
  levels_.push_back(std::move(level));
  return true;
}

// Is a vector or a colour, as one value, what comes next?
bool MessageBinder::TakesNumbers(const Level& level) const {
  const RouteStep& target = level.target;
  if (level.message == nullptr) return false;
  if (target.knob != nullptr) {
    const KnobType type = target.knob->type;
    return (type == KnobType::kVector || type == KnobType::kColor) &&
           (!target.knob->list || level.in_list);
  }
  return IsTriple(*target.field) && (!target.field->is_repeated() || level.in_list);
}

void MessageBinder::BeginNumbers(std::string_view parts, TextPlace at) {
  Level level;
  level.node = AddPlace(at);
  level.parts = parts;
  level.numbers.resize(parts.size());
  level.place = at;
  Push(std::move(level), at);
}

void MessageBinder::EndNumbers() {
  const std::vector<double> numbers = std::move(top().numbers);
  const TextPlace at = top().place;
  levels_.pop_back();
  Level& owner = top();
  if (numbers.size() != 3) {
    Fail(at, owner.name + " has 3 numbers; this gives " + std::to_string(numbers.size()));
    return;
  }
  if (owner.target.knob != nullptr) {
    OpenParameter()->mutable_number()->Add(numbers.begin(), numbers.end());
    return;
  }
  const FieldDescriptor* field = owner.target.field;
  const Reflection& reflection = *owner.message->GetReflection();
  Message* triple = field->is_repeated() ? reflection.AddMessage(owner.message, field)
                                         : reflection.MutableMessage(owner.message, field);
  for (int i = 0; i < 3; ++i) {
    triple->GetReflection()->SetDouble(triple, triple->GetDescriptor()->field(i),
                                       numbers[static_cast<size_t>(i)]);
  }
}

void MessageBinder::BeginGroup(TextPlace at) {
  if (passing_ > 0 || full_ || top().target.field == nullptr) {
    ++passing_;
    return;
  }
  Level& level = top();
  const RouteStep& target = level.target;
  if (target.knob != nullptr && TakesNumbers(level)) {
    return BeginNumbers(target.knob->type == KnobType::kColor ? "rgb" : "xyz", at);
  }
  if (target.knob != nullptr || target.field->message_type() == nullptr) {
    ++passing_;
    const std::string wanted = target.knob != nullptr && target.index < 0
                                   ? target.knob->TypeText()
                                   : std::string("a single value");
    return Fail(level.in_list ? at : level.place,
                level.name + " wants " + wanted + ", not a group { }");
  }
  Level inner;
  inner.node = AddPlace(at);
  const Reflection& reflection = *level.message->GetReflection();
  inner.message = target.field->is_repeated()
                      ? reflection.AddMessage(level.message, target.field)
                      : reflection.MutableMessage(level.message, target.field);
  inner.kind = KindOf(inner.message->GetDescriptor());
  Push(std::move(inner), at);
}

void MessageBinder::EndGroup() {
  if (passing_ > 0) {
    --passing_;
  } else if (full_) {
    return;
  } else if (top().message == nullptr) {
    EndNumbers();
  } else if (levels_.size() > 1) {
    levels_.pop_back();
  }
}

void MessageBinder::BeginList(TextPlace at) {
  if (passing_ > 0 || full_ || top().target.field == nullptr) {
    ++passing_;
    return;
  }
  Level& level = top();
  const Knob* knob = level.target.knob;
  if (TakesNumbers(level)) return BeginNumbers("", at);
  const bool many = knob != nullptr ? knob->list || knob->type == KnobType::kCurve
                                    : level.target.field->is_repeated();
  if (many && !level.in_list && level.message != nullptr) {
    level.in_list = true;
    return;
  }
  ++passing_;
  Fail(level.in_list ? at : level.place, level.name + " is not a list; leave out [ ]");
}

void MessageBinder::EndList() {
  if (passing_ > 0) {
    --passing_;
  } else if (full_) {
    return;
  } else if (top().message == nullptr) {
    EndNumbers();
  } else {
    top().in_list = false;
  }
}

void MessageBinder::Value(const WrittenValue& value, TextPlace at) {
  if (passing_ > 0 || full_) return;
  Level& level = top();
  const bool plain_list = level.message == nullptr && level.parts.empty();
  if (!plain_list && level.target.field == nullptr) return;
  if (level.message != nullptr) {
    return level.target.knob != nullptr ? PutKnob(value, at) : PutField(value, at);
  }
  double number = 0;
  if (!ToNumber(value, &number)) return Mismatch(value, "a number", at);
  if (plain_list) {
    if (level.numbers.size() <= 3) level.numbers.push_back(number);
    return;
  }
  AddPlace(at);
  level.numbers[static_cast<size_t>(level.target.index)] = number;
}

}  // namespace fjord
