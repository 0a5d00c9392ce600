#include "engine/scene/parse.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/coded_stream.h>

#include <vector>

#include "engine/formats/known_file.h"
#include "engine/scene/binder.h"
#include "engine/scene/limits.h"
#include "engine/scene/read_text.h"

namespace fjord {
namespace {

using google::protobuf::FieldDescriptor;

Errors Read(const std::string& text, bool json, v1::Scene* scene, SceneSource* source) {
  if (json) source->form = SceneSource::Form::kJson;
  MessageBinder binder(scene, source->name, json, &source->places);
  json ? ReadJsonForm(text, &binder) : ReadTextForm(text, &binder);
  return binder.Take();
}

// Has the reader itself said what the file is, with its place?
bool IsNamed(const Errors& errors) {
  return errors.size() == 1 && errors[0].message.find("not a scene") != std::string::npos;
}

// Is there a field anywhere inside that this version does not know?
bool HasUnknownFields(const google::protobuf::Message& message) {
  const auto* reflection = message.GetReflection();
  if (!reflection->GetUnknownFields(message).empty()) return true;
  std::vector<const FieldDescriptor*> fields;
  reflection->ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    if (field->message_type() == nullptr) continue;
    if (!field->is_repeated()) {
      if (HasUnknownFields(reflection->GetMessage(message, field))) return true;
      continue;
    }
    for (int i = 0; i < reflection->FieldSize(message, field); ++i) {
      if (HasUnknownFields(reflection->GetRepeatedMessage(message, field, i))) return true;
    }
  }
  return false;
}

}  // namespace

Errors ParseScene(const std::string& text, v1::Scene* scene, SceneSource* source) {
  const Place file{source->name, 0, 0};
  if (text.size() > limits::kSceneBytes) {
    return {MakeError(ErrorCode::kLimit,
                      "a scene may have at most " + std::to_string(limits::kSceneBytes >> 20) +
                          " MiB; keep shapes in files of their own",
                      file)};
  }
  const size_t zero = text.find('\0');
  if (zero != std::string::npos) {
    if (std::string why = WhyNotScene(text, source->name); !why.empty()) {
      return {Invalid(std::move(why), file)};
    }
    return {Invalid("not a scene in text form: byte " + std::to_string(zero + 1) + " is 0", file)};
  }
  const std::string mark = "\xef\xbb\xbf";  // UTF-8 byte order mark
  const size_t start = text.compare(0, mark.size(), mark) == 0 ? mark.size() : 0;
  const size_t first = text.find_first_not_of(" \t\r\n", start);
  if (first == std::string::npos)
    return {Invalid("the scene is empty; give it at least one object", file)};
  const std::string body = start == 0 ? "" : text.substr(start);
  const std::string& whole = start == 0 ? text : body;
  Errors errors = Read(whole, text[first] == '{', scene, source);
  if (errors.empty()) return errors;
  // What is written in another language has as many defects as words; one line says more.
  std::string why = WhyNotScene(text, source->name);
  if (why.empty() || IsNamed(errors)) return errors;
  return {Invalid(std::move(why), file)};
}

Errors ParseSceneBinary(const std::string& bytes, v1::Scene* scene, SceneSource* source) {
  source->form = SceneSource::Form::kBinary;
  const Place file{source->name, 0, 0};
  if (bytes.size() > limits::kSceneBytes) {
    return {MakeError(ErrorCode::kLimit, "the scene is too big", file)};
  }
  google::protobuf::io::CodedInputStream stream(reinterpret_cast<const uint8_t*>(bytes.data()),
                                                static_cast<int>(bytes.size()));
  stream.SetRecursionLimit(limits::kMessageDepth);
  if (!scene->ParseFromCodedStream(&stream) || !stream.ConsumedEntireMessage()) {
    return {Invalid("not a scene in binary form", file)};
  }
  if (HasUnknownFields(*scene)) {
    return {Invalid(
        "the scene has fields that this version does not know; it was made by a newer Fjord",
        file)};
  }
  return {};
}

}  // namespace fjord
