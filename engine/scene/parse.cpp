#include "engine/scene/parse.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "engine/scene/limits.h"
#include "engine/scene/nearest.h"

namespace fjord {
namespace {

using google::protobuf::FieldDescriptor;

// The n-th text in quotes, from 0.
std::string Quoted(const std::string& text, int n) {
  size_t at = 0;
  for (int i = 0;; ++i) {
    const size_t start = text.find('"', at);
    if (start == std::string::npos) return "";
    const size_t end = text.find('"', start + 1);
    if (end == std::string::npos) return "";
    if (i == n) return text.substr(start + 1, end - start - 1);
    at = end + 1;
  }
}

// Enumerators of all fields of that name, for suggestions.
std::vector<std::string> EnumeratorsOf(const std::string& field_name) {
  std::set<std::string> names;
  const auto* file = v1::Scene::descriptor()->file();
  for (int m = 0; m < file->message_type_count(); ++m) {
    const FieldDescriptor* field = file->message_type(m)->FindFieldByName(field_name);
    if (field == nullptr || field->enum_type() == nullptr) continue;
    for (int i = 0; i < field->enum_type()->value_count(); ++i) {
      names.insert(field->enum_type()->value(i)->name());
    }
  }
  return {names.begin(), names.end()};
}

// The library's messages in our words, with suggestions where a name is wrong.
std::string Reworded(const std::string& message) {
  if (message.find("has no field named") != std::string::npos) {
    const auto* type =
        v1::Scene::descriptor()->file()->pool()->FindMessageTypeByName(Quoted(message, 0));
    const std::string name = Quoted(message, 1);
    std::vector<std::string> names;
    for (int i = 0; type != nullptr && i < type->field_count(); ++i) {
      names.push_back(type->field(i)->name());
    }
    return (type == nullptr ? "a message" : type->name()) + " has no field \"" + name + "\"" +
           SuggestNames(name, names, 32);
  }
  if (message.find("Unknown enumeration value") != std::string::npos) {
    const std::string value = Quoted(message, 0), field = Quoted(message, 1);
    const std::vector<std::string> names = EnumeratorsOf(field);
    return field + " cannot be " + value + SuggestNames(value, names, 16);
  }
  if (message.find("specified multiple times") != std::string::npos) {
    return "field " + Quoted(message, 0) + " is given twice";
  }
  return message;
}

// Lines and columns from 0, as the library counts them: a tab goes on to the next multiple of 8.
struct TextPoint {
  int line = 0;
  int column = 0;

  void Pass(char c) {
    if (c == '\n') {
      ++line;
      column = 0;
    } else {
      column += c == '\t' ? 8 - column % 8 : 1;
    }
  }
};

// The library points behind a wrong name; this is where the name itself begins: its last occurrence
// before `behind`. `behind` where there is none.
TextPoint StartOf(const std::string& name, TextPoint behind, const std::string& text) {
  TextPoint found = behind, at;
  const auto is_letter = [&](size_t i) {
    return i < text.size() &&
           (std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_');
  };
  for (size_t i = 0; i < text.size(); ++i) {
    if (at.line > behind.line || (at.line == behind.line && at.column >= behind.column)) break;
    const bool starts = i == 0 || !is_letter(i - 1);
    if (starts && text.compare(i, name.size(), name) == 0 && !is_letter(i + name.size()))
      found = at;
    at.Pass(text[i]);
  }
  return found;
}

// Unknown fields come as warnings, so that reading goes on and all of them are reported.
class Collector : public google::protobuf::io::ErrorCollector {
 public:
  Collector(std::string name, const std::string& text) : name_(std::move(name)), text_(text) {}
  void AddError(int line, int column, const std::string& message) override {
    if (errors_.size() > limits::kErrors) return;
    TextPoint at{line, column};
    if (message.find("has no field named") != std::string::npos) {
      at = StartOf(Quoted(message, 1), at, text_);
    } else if (message.find("Unknown enumeration value") != std::string::npos) {
      at = StartOf(Quoted(message, 0), at, text_);
    }
    errors_.push_back(
        Invalid(Reworded(message), {name_, at.line + 1, at.line < 0 ? 0 : at.column + 1}));
  }
  void AddWarning(int line, int column, const std::string& message) override {
    if (message.find("has no field named") != std::string::npos) AddError(line, column, message);
  }
  Errors Take() { return std::move(errors_); }

 private:
  const std::string name_;
  const std::string& text_;
  Errors errors_;
};

Errors ParseText(const std::string& text, v1::Scene* scene, SceneSource* source) {
  Collector collector(source->name, text);
  google::protobuf::TextFormat::Parser parser;
  parser.RecordErrorsTo(&collector);
  parser.WriteLocationsTo(&source->tree);
  parser.AllowUnknownField(true);
  parser.SetRecursionLimit(limits::kMessageDepth);
  const bool parsed = parser.ParseFromString(text, scene);
  Errors errors = collector.Take();
  if (!parsed && errors.empty()) errors.push_back(Invalid("not a scene", {source->name, 0, 0}));
  return errors;
}

// The library counts list entries from 0; people count from 1.
std::string CountedFromOne(const std::string& message) {
  std::string text;
  for (size_t i = 0; i < message.size(); ++i) {
    text += message[i];
    if (message[i] != '[') continue;
    size_t end = i + 1;
    while (end < message.size() && message[end] >= '0' && message[end] <= '9') ++end;
    if (end == i + 1 || end - i > 9 || end == message.size() || message[end] != ']') continue;
    text += std::to_string(std::stoul(message.substr(i + 1, end - i - 1)) + 1);
    i = end - 1;
  }
  return text;
}

Errors ParseJson(const std::string& text, v1::Scene* scene, SceneSource* source) {
  source->form = SceneSource::Form::kJson;
  const auto status = google::protobuf::util::JsonStringToMessage(text, scene);
  if (status.ok()) return {};
  std::string message(status.message());
  std::replace(message.begin(), message.end(), '\n', ' ');
  return {Invalid("JSON: " + CountedFromOne(message), {source->name, 0, 0})};
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
    return {Invalid("not a scene in text form: byte " + std::to_string(zero + 1) + " is 0", file)};
  }
  const std::string mark = "\xef\xbb\xbf";  // UTF-8 byte order mark
  const size_t start = text.compare(0, mark.size(), mark) == 0 ? mark.size() : 0;
  const size_t first = text.find_first_not_of(" \t\r\n", start);
  if (first == std::string::npos)
    return {Invalid("the scene is empty; give it at least one object", file)};
  const std::string body = start == 0 ? "" : text.substr(start);
  const std::string& whole = start == 0 ? text : body;
  return text[first] == '{' ? ParseJson(whole, scene, source) : ParseText(whole, scene, source);
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
