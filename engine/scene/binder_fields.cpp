// MessageBinder::PutField: a single value into a plain field of a message.
#include <google/protobuf/descriptor.h>

#include "engine/scene/binder.h"
#include "engine/scene/nearest.h"

namespace fjord {
namespace {

using google::protobuf::EnumDescriptor;
using google::protobuf::EnumValueDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

// Writes through Set... or Add..., as the field demands.
template <typename Value, typename Single, typename Repeated>
void Put(Message* message, const FieldDescriptor* field, Value value, Single single,
         Repeated repeated) {
  const Reflection* reflection = message->GetReflection();
  field->is_repeated() ? (reflection->*repeated)(message, field, value)
                       : (reflection->*single)(message, field, value);
}

std::vector<std::string> WordsOf(const EnumDescriptor& type) {
  std::vector<std::string> words;
  for (int i = 0; i < type.value_count(); ++i) words.push_back(type.value(i)->name());
  return words;
}

}  // namespace

void MessageBinder::PutField(const WrittenValue& value, TextPlace at) {
  const Level& level = top();
  const FieldDescriptor* field = level.target.field;
  Message* message = level.message;
  const bool word = value.kind == WrittenValue::Kind::kWord;
  if (field->is_repeated() && !level.in_list && json_) {
    return Fail(at, level.name + " is a list; write [ ]");
  }
  AddPlace(at);
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE: {
      double number = 0;
      if (!ToNumber(value, &number)) return Mismatch(value, "a number", at);
      return Put(message, field, number, &Reflection::SetDouble, &Reflection::AddDouble);
    }
    case FieldDescriptor::CPPTYPE_UINT32: {
      uint64_t whole = 0;
      if (!ToWhole(value, UINT32_MAX, &whole))
        return Mismatch(value, "a whole number from 0 to 4294967295", at);
      return Put(message, field, static_cast<uint32_t>(whole), &Reflection::SetUInt32,
                 &Reflection::AddUInt32);
    }
    case FieldDescriptor::CPPTYPE_UINT64: {
      uint64_t whole = 0;
      if (!ToWhole(value, UINT64_MAX, &whole)) return Mismatch(value, "a whole number from 0", at);
      return Put(message, field, whole, &Reflection::SetUInt64, &Reflection::AddUInt64);
    }
    case FieldDescriptor::CPPTYPE_BOOL:
      if (!word || (value.text != "true" && value.text != "false"))
        return Mismatch(value, "true or false", at);
      return Put(message, field, value.text == "true", &Reflection::SetBool, &Reflection::AddBool);
    case FieldDescriptor::CPPTYPE_STRING:
      if (value.kind != WrittenValue::Kind::kText &&
          !(word && level.kind != nullptr && field->name() == level.kind->name_field)) {
        return Mismatch(value, "a text in quotes", at);
      }
      return Put(message, field, value.text, &Reflection::SetString, &Reflection::AddString);
    case FieldDescriptor::CPPTYPE_ENUM: {
      const EnumValueDescriptor* found =
          value.kind == WrittenValue::Kind::kNumber
              ? (value.is_whole && value.whole < 1000
                     ? field->enum_type()->FindValueByNumber(static_cast<int>(value.whole))
                     : nullptr)
              : field->enum_type()->FindValueByName(value.text);
      if (found == nullptr) {
        return Fail(level.in_list ? at : level.place,
                    level.name + " cannot be " + value.text +
                        SuggestNames(value.text, WordsOf(*field->enum_type()), 16));
      }
      return Put(message, field, found, &Reflection::SetEnum, &Reflection::AddEnum);
    }
    default:
      return Mismatch(value, "a group: " + level.name + " { ... }", at);
  }
}

}  // namespace fjord
