// SetFromText of route.h.
#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include <array>
#include <charconv>

#include "engine/scene/nearest.h"
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

class FirstError : public google::protobuf::io::ErrorCollector {
 public:
  void AddError(int, int, const std::string& message) override {
    if (text.empty()) text = message;
  }
  std::string text;
};

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

Result<> SetMessage(Message* parent, const RouteStep& step, const std::string& value) {
  const Reflection* reflection = parent->GetReflection();
  Message* message = step.index >= 0
                         ? reflection->MutableRepeatedMessage(parent, step.field, step.index)
                         : reflection->MutableMessage(parent, step.field);
  FirstError first;
  google::protobuf::TextFormat::Parser parser;
  parser.RecordErrorsTo(&first);
  parser.AllowPartialMessage(true);
  parser.SetRecursionLimit(16);
  std::unique_ptr<Message> fresh(message->New());
  if (!parser.ParseFromString(value, fresh.get())) {
    return Invalid("\"" + value + "\" is not a " + message->GetDescriptor()->name() + ": " +
                   first.text);
  }
  message->MergeFrom(*fresh);
  return {};
}

}  // namespace

Result<> SetFromText(v1::Scene* scene, const Route& route, std::string_view value) {
  const RouteStep& step = route.steps.back();
  Message* parent = OpenParent(scene, route);
  const std::string text(value);
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
      return SetMessage(parent, step, text);
    }
    default:
      return Invalid("this field cannot be set");
  }
}

}  // namespace fjord
