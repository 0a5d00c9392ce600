#include "engine/scene/write_json.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/util/json_util.h>

#include <nlohmann/json.hpp>

#include "engine/scene/parameters.h"

namespace fjord {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using Json = nlohmann::ordered_json;

// A knob's value as a person writes it.
Json ValueJson(const Knob& knob, const v1::Parameter& parameter) {
  Json values = Json::array();
  const bool triple = knob.type == KnobType::kVector || knob.type == KnobType::kColor;
  for (int i = 0; i < parameter.number_size(); ++i) {
    if (triple && knob.list && i % 3 == 0) values.push_back(Json::array());
    (triple && knob.list ? values.back() : values).push_back(parameter.number(i));
  }
  for (const uint64_t whole : parameter.whole())
    values.push_back(knob.type == KnobType::kFlag ? Json(whole != 0) : Json(whole));
  for (const std::string& text : parameter.text()) values.push_back(text);
  const bool many = knob.list || triple || knob.type == KnobType::kCurve;
  return !many && values.size() == 1 ? values[0] : values;
}

// The library's JSON of the message, with the parameters of entries as fields.
void Flatten(const Message& message, Json* json) {
  const google::protobuf::Descriptor& type = *message.GetDescriptor();
  const EntryKind* kind = KindOf(&type);
  if (kind != nullptr) {
    json->erase("parameter");
    for (const v1::Parameter& parameter : ParametersOf(message)) {
      if (const Knob* knob = kind->AnyKnob(parameter.name()); knob != nullptr)
        (*json)[parameter.name()] = ValueJson(*knob, parameter);
    }
  }
  for (auto& [name, value] : json->items()) {
    const FieldDescriptor* field = type.FindFieldByName(name);
    if (field == nullptr || field->message_type() == nullptr) continue;
    const auto& reflection = *message.GetReflection();
    if (!field->is_repeated()) {
      Flatten(reflection.GetMessage(message, field), &value);
      continue;
    }
    for (int i = 0; i < reflection.FieldSize(message, field); ++i)
      Flatten(reflection.GetRepeatedMessage(message, field, i), &value[static_cast<size_t>(i)]);
  }
}

}  // namespace

std::string SceneJson(const v1::Scene& scene) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  std::string text;
  if (!google::protobuf::util::MessageToJsonString(scene, &text, options).ok()) return "{}";
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return "{}";
  Flatten(scene, &json);
  return json.dump(1);
}

}  // namespace fjord
