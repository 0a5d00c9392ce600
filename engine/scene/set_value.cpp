// SetFromText of route.h.
#include <google/protobuf/descriptor.h>
#include <google/protobuf/stubs/strutil.h>

#include <array>
#include <charconv>
#include <memory>

#include "engine/scene/nearest.h"
#include "engine/scene/parameters.h"
#include "engine/scene/read_text.h"
#include "engine/scene/route.h"

namespace fjord {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

template <typename T>
bool ReadWhole(std::string_view text, T* value) {
  const char* end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, *value);
  return code == std::errc() && stop == end && !text.empty();
}

// Three numbers with blanks or commas between.
bool ReadThree(std::string_view text, std::array<double, 3>* values) {
  size_t at = 0;
  for (double& value : *values) {
    at = text.find_first_not_of(" ,", at);
    if (at == std::string_view::npos) return false;
    const size_t end = std::min(text.find_first_of(" ,", at), text.size());
    if (!ReadWhole(text.substr(at, end - at), &value)) return false;
    at = end;
  }
  return text.find_first_not_of(" ,", at) == std::string_view::npos;
}

// Writes through Set... or SetRepeated..., as the step demands.
template <typename Value, typename Single, typename Repeated>
void Put(Message* parent, const RouteStep& step, Value value, Single single, Repeated repeated) {
  const Reflection* reflection = parent->GetReflection();
  if (step.index >= 0) {
    (reflection->*repeated)(parent, step.field, step.index, value);
  } else {
    (reflection->*single)(parent, step.field, value);
  }
}

// The text form of a group, on top of what the message has.
Result<> SetMessage(Message* message, const std::string& value) {
  std::unique_ptr<Message> fresh(message->New());
  MessageBinder binder(fresh.get(), "", false, nullptr);
  ReadTextForm(value, &binder);
  const Errors errors = binder.Take();
  if (!errors.empty()) {
    return Invalid("\"" + value + "\" is not a " + message->GetDescriptor()->name() + ": " +
                   errors[0].message);
  }
  message->MergeFrom(*fresh);
  return {};
}

// Reads the value as a scene would hold it: as the one field of an entry of its own.
Result<> SetKnob(v1::Scene* scene, const Route& route, const std::string& value) {
  const RouteStep& step = route.steps.back();
  const Knob& knob = *step.knob;
  if (step.index >= 0) {  // one number of a vector
    double number = 0;
    if (!ReadWhole(std::string_view(value), &number))
      return Invalid("\"" + value + "\" is not a number");
    SetNumbers(scene, route, {&number, 1});
    return {};
  }
  std::string text = value;
  std::array<double, 3> three{};
  if (knob.type == KnobType::kText) text = '"' + google::protobuf::CEscape(value) + '"';
  if (knob.TrackNumbers() == 3 && ReadThree(value, &three)) {
    SetNumbers(scene, route, three);
    return {};
  }
  const auto* type = route.steps[route.steps.size() - 2].field->message_type();
  const std::unique_ptr<Message> entry(
      google::protobuf::MessageFactory::generated_factory()->GetPrototype(type)->New());
  MessageBinder binder(entry.get(), "", false, nullptr);
  ReadTextForm(std::string(knob.name) + ": " + text, &binder);
  const Errors errors = binder.Take();
  if (!errors.empty()) return Invalid(errors[0].message);
  const Parameters& read = ParametersOf(*entry);
  if (read.size() != 1) return Invalid("\"" + value + "\" is not " + knob.TypeText());
  *static_cast<v1::Parameter*>(OpenParent(scene, route)) = read[0];
  return {};
}

}  // namespace

Result<> SetFromText(v1::Scene* scene, const Route& route, std::string_view value) {
  const RouteStep& step = route.steps.back();
  const std::string text(value);
  if (step.knob != nullptr) return SetKnob(scene, route, text);
  Message* parent = OpenParent(scene, route);
  const auto wrong = [&](const std::string& wanted) {
    return Invalid("\"" + text + "\" is not " + wanted);
  };
  switch (step.field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE: {
      double number = 0;
      if (!ReadWhole(value, &number)) return wrong("a number");
      Put(parent, step, number, &Reflection::SetDouble, &Reflection::SetRepeatedDouble);
      return {};
    }
    case FieldDescriptor::CPPTYPE_UINT32: {
      uint32_t number = 0;
      if (!ReadWhole(value, &number)) return wrong("a whole number from 0 to 4294967295");
      Put(parent, step, number, &Reflection::SetUInt32, &Reflection::SetRepeatedUInt32);
      return {};
    }
    case FieldDescriptor::CPPTYPE_UINT64: {
      uint64_t number = 0;
      if (!ReadWhole(value, &number)) return wrong("a whole number from 0");
      Put(parent, step, number, &Reflection::SetUInt64, &Reflection::SetRepeatedUInt64);
      return {};
    }
    case FieldDescriptor::CPPTYPE_BOOL:
      if (text != "true" && text != "false") return wrong("true or false");
      Put(parent, step, text == "true", &Reflection::SetBool, &Reflection::SetRepeatedBool);
      return {};
    case FieldDescriptor::CPPTYPE_STRING:
      Put(parent, step, text, &Reflection::SetString, &Reflection::SetRepeatedString);
      return {};
    case FieldDescriptor::CPPTYPE_ENUM: {
      const auto* type = step.field->enum_type();
      const auto* found = type->FindValueByName(text);
      if (found != nullptr) {
        Put(parent, step, found, &Reflection::SetEnum, &Reflection::SetRepeatedEnum);
        return {};
      }
      std::vector<std::string> names;
      names.reserve(static_cast<size_t>(type->value_count()));
      for (int i = 0; i < type->value_count(); ++i) names.push_back(type->value(i)->name());
      return Invalid("\"" + text + "\" is not a " + type->name() + SuggestNames(text, names));
    }
    case FieldDescriptor::CPPTYPE_MESSAGE: {
      std::array<double, 3> three{};
      if (NumberCount(step) == 3 && ReadThree(value, &three)) {
        SetNumbers(scene, route, three);
        return {};
      }
      if (NumberCount(step) == 3 && text.find(':') == std::string::npos)
        return wrong("three numbers, as in \"0 -5 2\"");
      return SetMessage(
          step.index >= 0
              ? parent->GetReflection()->MutableRepeatedMessage(parent, step.field, step.index)
              : parent->GetReflection()->MutableMessage(parent, step.field),
          text);
    }
    default:
      return Invalid("this field cannot be set");
  }
}

}  // namespace fjord
