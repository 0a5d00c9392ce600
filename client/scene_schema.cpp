// SceneSchema of entry_docs.h: the messages of scene.proto, their ranges and the registries'
// tables.
#include <google/protobuf/descriptor.h>

#include "client/entry_docs.h"
#include "engine/scene/ranges.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using Json = nlohmann::ordered_json;

void AddRange(const NumberRange& range, Json* schema) {
  if (range.lowest > -kLargestNumber)
    (*schema)[range.above ? "exclusiveMinimum" : "minimum"] = range.lowest;
  if (range.highest < kLargestNumber) (*schema)["maximum"] = range.highest;
}

Json Triple(const char* parts) {
  Json group = {{"type", "object"}, {"additionalProperties", false}};
  for (const char* part = parts; *part != 0; ++part)
    group["properties"][std::string(1, *part)] = {{"type", "number"}};
  const Json list = {
      {"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 3}, {"maxItems", 3}};
  return {{"anyOf", {list, group}}};
}

Json OfOne(const Knob& knob) {
  Json schema;
  switch (knob.type) {
    case KnobType::kNumber:
      schema = {{"type", "number"}};
      AddRange(knob.range, &schema);
      return schema;
    case KnobType::kWhole:
      schema = {{"type", "integer"}};
      AddRange(knob.range, &schema);
      return schema;
    case KnobType::kFlag:
      return {{"type", "boolean"}};
    case KnobType::kChoice:
      for (const KnobWord& word : knob.words) schema["enum"].push_back(word.word);
      return schema;
    case KnobType::kText:
      return {{"type", "string"}};
    case KnobType::kVector:
      return Triple("xyz");
    case KnobType::kColor:
      return Triple("rgb");
    case KnobType::kCurve:
      return {{"type", "array"}, {"items", {{"type", "number"}}}};
  }
  return schema;
}

Json OfKnob(const Knob& knob, const KnobTable& table) {
  Json schema = OfOne(knob);
  if (knob.list) schema = {{"type", "array"}, {"items", schema}};
  schema["description"] =
      std::string(knob.effect) + " (default " + knob.ValueText(table.DefaultOf(knob)) + ")";
  return schema;
}

Json OfField(const FieldDescriptor& field) {
  Json schema;
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      schema = {{"type", "number"}};
      break;
    case FieldDescriptor::CPPTYPE_UINT32:
    case FieldDescriptor::CPPTYPE_UINT64:
      schema = {{"type", "integer"}, {"minimum", 0}};
      break;
    case FieldDescriptor::CPPTYPE_BOOL:
      schema = {{"type", "boolean"}};
      break;
    case FieldDescriptor::CPPTYPE_ENUM:
      for (int i = 0; i < field.enum_type()->value_count(); ++i)
        schema["enum"].push_back(field.enum_type()->value(i)->name());
      break;
    case FieldDescriptor::CPPTYPE_MESSAGE:
      schema = {{"$ref", "#/definitions/" + field.message_type()->name()}};
      break;
    default:
      schema = {{"type", "string"}};
  }
  if (const NumberRange* range = RangeOf(field); range != nullptr && schema.contains("type"))
    AddRange(*range, &schema);
  if (field.is_repeated()) schema = {{"type", "array"}, {"items", schema}};
  return schema;
}

Json OfMessage(const Descriptor& type) {
  if (&type == v1::Vec3::descriptor()) return Triple("xyz");
  if (&type == v1::Color::descriptor()) return Triple("rgb");
  Json fields = Json::object();
  for (int i = 0; i < type.field_count(); ++i) {
    if (type.field(i)->name() != "parameter")
      fields[type.field(i)->name()] = OfField(*type.field(i));
  }
  const EntryKind* kind = KindOf(&type);
  if (kind == nullptr)
    return {{"type", "object"}, {"properties", fields}, {"additionalProperties", false}};
  Json choices = Json::array();
  for (const EntryInfo* info : kind->entries()) {
    Json of_entry = fields;
    of_entry[std::string(kind->name_field)] = {{"const", info->name},
                                               {"description", info->summary}};
    for (const Knob& knob : info->knobs.rows())
      of_entry[std::string(knob.name)] = OfKnob(knob, info->knobs);
    choices.push_back(
        {{"type", "object"}, {"properties", of_entry}, {"additionalProperties", false}});
  }
  if (choices.empty())
    return {{"type", "object"}, {"properties", fields}, {"additionalProperties", false}};
  return {{"anyOf", choices}};
}

void Define(const Descriptor& type, Json* definitions) {
  if (definitions->contains(type.name())) return;
  (*definitions)[type.name()] = OfMessage(type);
  for (int i = 0; i < type.field_count(); ++i) {
    const Descriptor* inner = type.field(i)->message_type();
    if (inner != nullptr && type.field(i)->name() != "parameter") Define(*inner, definitions);
  }
}

}  // namespace

Json SceneSchema() {
  Json definitions = Json::object();
  Define(*v1::Scene::descriptor(), &definitions);
  return {{"$schema", "http://json-schema.org/draft-07/schema#"},
          {"title", "A scene of Fjord"},
          {"$ref", "#/definitions/Scene"},
          {"definitions", std::move(definitions)}};
}

}  // namespace fjord
