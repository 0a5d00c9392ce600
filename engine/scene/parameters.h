// Between the Parameter messages of scenes and frame scenes and the plain values of engine/knobs.
#pragma once

#include <google/protobuf/message.h>

#include <string>
#include <vector>

#include "engine/knobs/knob_table.h"
#include "engine/scene/entry_kinds.h"
#include "fjord/v1/parameter.pb.h"

namespace fjord {

using Parameters = google::protobuf::RepeatedPtrField<v1::Parameter>;

std::vector<NamedValue> ValuesOf(const Parameters& parameters);
void SetParameters(std::span<const NamedValue> values, Parameters* parameters);
void SetParameter(const NamedValue& value, v1::Parameter* parameter);

// The same lists of any message that stands for an entry, and the entry's name in it.
const Parameters& ParametersOf(const google::protobuf::Message& entry);
Parameters* MutableParametersOf(google::protobuf::Message* entry);
std::string EntryName(const EntryKind& kind, const google::protobuf::Message& entry);

// Writes out every value that has an effect, in the order of the table, and nothing else; so scenes
// that mean the same have the same bytes. Leaves the message alone where a value has a defect.
void CompleteEntry(const EntryInfo& info, google::protobuf::Message* entry);

}  // namespace fjord
