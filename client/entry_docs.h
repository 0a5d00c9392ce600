// What the registries' tables say, for people and programs: `fjord presets` in its forms. Nothing
// here knows any entry or knob by name.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "engine/scene/entry_kinds.h"

namespace fjord {

// Name, version, summary and every knob with type, range, default, unit, words and effect.
nlohmann::ordered_json EntryJson(const EntryInfo& info);
// The same as lines of text.
std::string EntryText(const EntryKind& kind, const EntryInfo& info);
// Tables in Markdown of all entries of a kind, for the documentation.
std::string KindMarkdown(const EntryKind& kind);
// A JSON Schema of scenes in JSON, for editors.
nlohmann::ordered_json SceneSchema();

}  // namespace fjord
