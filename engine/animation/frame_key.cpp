#include "engine/animation/frame_key.h"

#include <google/protobuf/descriptor.h>

#include <map>
#include <vector>

#include "engine/animation/frame_geometry.h"
#include "engine/animation/walk.h"
#include "engine/scene/parameters.h"

namespace fjord {

namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

// Adds every registry entry that is used anywhere in the message, with its version.
Result<> AddEntries(const Message& message, std::map<std::string, uint32_t>* used) {
  if (const EntryKind* kind = KindOf(message.GetDescriptor()); kind != nullptr) {
    const std::string name = EntryName(*kind, message);
    const EntryInfo* info = kind->Find(name);
    if (info == nullptr) {
      return Invalid("the frame scene uses the " + std::string(kind->name) + " " +
                     std::string(kind->noun) + " \"" + name +
                     "\", which this version does not have");
    }
    (*used)[std::string(kind->name) + "/" + name] = info->version;
    return {};
  }
  const auto& reflection = *message.GetReflection();
  std::vector<const FieldDescriptor*> fields;
  reflection.ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    if (field->message_type() == nullptr) continue;
    const int count = field->is_repeated() ? reflection.FieldSize(message, field) : 1;
    for (int i = 0; i < count; ++i) {
      const Message& part = field->is_repeated() ? reflection.GetRepeatedMessage(message, field, i)
                                                 : reflection.GetMessage(message, field);
      if (Result<> added = AddEntries(part, used); !added) return added;
    }
  }
  return {};
}

}  // namespace

Result<std::string> FrameKeyBytes(const v1::FrameScene& frame) {
  for (const v1::FrameObject& object : frame.object()) {
    if (Result<> form = CheckGeometryForm(object); !form) return form.error();
  }
  std::map<std::string, uint32_t> used;  // sorted by name
  if (Result<> added = AddEntries(frame, &used); !added) return added.error();
  std::string bytes = "fjord-frame 1\ncore " + std::to_string(kCoreShapeVersion) + "\n";
  for (const auto& [name, version] : used) bytes += name + " " + std::to_string(version) + "\n";
  if (Result<> walked = AppendWalk(frame, bytes); !walked) return walked.error();
  return bytes;
}

Result<Digest> FrameKey(const v1::FrameScene& frame) {
  Result<std::string> bytes = FrameKeyBytes(frame);
  if (!bytes) return bytes.error();
  return Sha256Of(*bytes);
}

}  // namespace fjord
