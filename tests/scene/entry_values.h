// Values of a registry's entry in a message, for tests.
#pragma once

#include <string>

#include "engine/scene/parameters.h"

namespace fjord::testing {

// As a person would write it; "" where the message has none.
inline std::string ValueIn(const google::protobuf::Message& entry, const std::string& name) {
  for (const v1::Parameter& parameter : ParametersOf(entry)) {
    if (parameter.name() != name) continue;
    const Knob* knob = KindOf(entry.GetDescriptor())->AnyKnob(name);
    return knob->ValueText({{parameter.number().begin(), parameter.number().end()},
                            {parameter.whole().begin(), parameter.whole().end()},
                            {parameter.text().begin(), parameter.text().end()}});
  }
  return "";
}

inline void SetValue(google::protobuf::Message* entry, const std::string& name,
                     const KnobValue& value) {
  for (v1::Parameter& parameter : *MutableParametersOf(entry)) {
    if (parameter.name() == name) return SetParameter({name, value}, &parameter);
  }
  SetParameter({name, value}, MutableParametersOf(entry)->Add());
}

}  // namespace fjord::testing
