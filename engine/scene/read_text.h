// The two forms of text that people write, read piece by piece into a MessageBinder.
#pragma once

#include <string>

#include "engine/scene/binder.h"

namespace fjord {

// Protobuf's text form: `name: value`, `name { ... }`, `name: [ ... ]`, # comments.
void ReadTextForm(const std::string& text, MessageBinder* binder);

// JSON. A value's place is where it begins.
void ReadJsonForm(const std::string& text, MessageBinder* binder);

}  // namespace fjord
