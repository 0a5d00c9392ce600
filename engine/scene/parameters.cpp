#include "engine/scene/parameters.h"

#include <google/protobuf/descriptor.h>

namespace fjord {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

const FieldDescriptor* ListField(const Message& entry) {
  const FieldDescriptor* field = entry.GetDescriptor()->FindFieldByName("parameter");
  FJORD_CHECK(field != nullptr, entry.GetDescriptor()->full_name());
  return field;
}

}  // namespace

// Their replacement, GetRepeatedFieldRef, copies a message an element.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
const Parameters& ParametersOf(const Message& entry) {
  return entry.GetReflection()->GetRepeatedPtrField<v1::Parameter>(entry, ListField(entry));
}

Parameters* MutableParametersOf(Message* entry) {
  return entry->GetReflection()->MutableRepeatedPtrField<v1::Parameter>(entry, ListField(*entry));
}
#pragma GCC diagnostic pop

std::vector<NamedValue> ValuesOf(const Parameters& parameters) {
  std::vector<NamedValue> values;
  values.reserve(static_cast<size_t>(parameters.size()));
  for (const v1::Parameter& parameter : parameters) {
    values.push_back({parameter.name(),
                      {{parameter.number().begin(), parameter.number().end()},
                       {parameter.whole().begin(), parameter.whole().end()},
                       {parameter.text().begin(), parameter.text().end()}}});
  }
  return values;
}

void SetParameter(const NamedValue& value, v1::Parameter* parameter) {
  parameter->Clear();
  parameter->set_name(value.name);
  parameter->mutable_number()->Add(value.value.numbers.begin(), value.value.numbers.end());
  parameter->mutable_whole()->Add(value.value.wholes.begin(), value.value.wholes.end());
  for (const std::string& text : value.value.texts) parameter->add_text(text);
}

void SetParameters(std::span<const NamedValue> values, Parameters* parameters) {
  parameters->Clear();
  for (const NamedValue& value : values) SetParameter(value, parameters->Add());
}

std::string EntryName(const EntryKind& kind, const Message& entry) {
  const FieldDescriptor* field =
      entry.GetDescriptor()->FindFieldByName(std::string(kind.name_field));
  return entry.GetReflection()->GetString(entry, field);
}

void CompleteEntry(const EntryInfo& info, Message* entry) {
  std::vector<KnobDefect> defects;
  const std::any settings = info.knobs.Read(ValuesOf(ParametersOf(*entry)), info.name, &defects);
  if (!defects.empty()) return;
  std::vector<NamedValue> values;
  for (const Knob& knob : info.knobs.rows()) {
    if (knob.Works(settings)) values.push_back({std::string(knob.name), knob.Get(settings)});
  }
  SetParameters(values, MutableParametersOf(entry));
}

}  // namespace fjord
