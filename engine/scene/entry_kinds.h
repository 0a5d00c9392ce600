// The kinds of registry entries that a scene uses, and which message stands for each. A message
// that stands for an entry has a text field with the entry's name and a list `parameter` of its
// values; a person writes these values as fields of the message.
//
// A new kind is one line in entry_kinds.cpp. Immutable once read; thread-safe.
#pragma once

#include <google/protobuf/descriptor.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/knobs/registry.h"

namespace fjord {

struct EntryKind {
  std::string_view name;   // in the frame key and in `fjord presets`: "fractal"
  std::string_view noun;   // what one entry is called: "method"
  std::string_view where;  // the scene's field: "objects.fractal"
  const google::protobuf::Descriptor* scene_message;
  const google::protobuf::Descriptor* frame_message;
  std::string_view name_field;  // of both messages: "method"
  std::vector<const EntryInfo*> (*entries)();

  // Null where there is no such entry.
  const EntryInfo* Find(std::string_view entry) const;
  // A knob of that name in any entry, or null. Knobs of one name have one type throughout a kind,
  // so that a value can be read before it is known which entry it belongs to.
  const Knob* AnyKnob(std::string_view knob) const;
  // Every name that a person may write in the message, each once.
  std::vector<std::string> FieldNames() const;
};

std::span<const EntryKind> EntryKinds();
// The kind whose scene message or frame message this is, or null.
const EntryKind* KindOf(const google::protobuf::Descriptor* type);

}  // namespace fjord
