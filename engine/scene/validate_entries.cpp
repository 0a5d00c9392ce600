// CheckEntry and CheckForAnyEntry of validate.h: what the table of a registry's entry says about
// the values that a scene gives it.
#include <algorithm>
#include <map>

#include "engine/scene/limits.h"
#include "engine/scene/nearest.h"
#include "engine/scene/parameters.h"
#include "engine/scene/validate.h"

namespace fjord {
namespace {

using google::protobuf::Message;

// More than any entry has; only a program sends so many.
constexpr int kMostParameters = 1000;

std::string NamesOf(const EntryInfo& info) {
  std::string names;
  for (const Knob& knob : info.knobs.rows())
    names += (names.empty() ? "" : ", ") + std::string(knob.name);
  return names.empty() ? "none" : names;
}

// Which the reader of text sees to; other programs may send anything. False where there is a
// defect.
bool CheckSent(const EntryKind& kind, const Parameters& parameters, const Route& route,
               SceneErrors* errors) {
  if (parameters.size() > kMostParameters) {
    errors->Add(
        route,
        std::to_string(parameters.size()) + " values; at most " + std::to_string(kMostParameters),
        ErrorCode::kLimit);
    return false;
  }
  std::vector<std::string_view> names;
  for (const v1::Parameter& parameter : parameters) {
    const std::string& name = parameter.name();
    if (kind.AnyKnob(name) == nullptr) {
      errors->Add(route, "there is no knob of the name that was sent");
      return false;
    }
    if (std::find(names.begin(), names.end(), name) != names.end()) {
      errors->Add(route.ThenKnob(name), "the value is given twice");
      return false;
    }
    names.emplace_back(name);
    for (const std::string& text : parameter.text()) {
      if (IsPrintable(text)) continue;
      errors->Add(route.ThenKnob(name), "the text is not printable UTF-8");
      return false;
    }
  }
  return true;
}

void AddDefects(const EntryInfo& info, const EntryKind& kind, const Parameters& parameters,
                const Route& route, SceneErrors* errors) {
  std::vector<KnobDefect> defects;
  info.knobs.Read(ValuesOf(parameters), info.name, &defects);
  for (const KnobDefect& defect : defects) {
    const bool unknown = info.knobs.Find(defect.knob) == nullptr;
    errors->Add(route.ThenKnob(defect.knob),
                unknown ? std::string(kind.noun) + " " + std::string(info.name) +
                              " has no such knob; it has " + NamesOf(info)
                        : defect.message);
  }
}

}  // namespace

void CheckEntry(const Message& entry, const Route& route, SceneErrors* errors) {
  const EntryKind& kind = *KindOf(entry.GetDescriptor());
  const Parameters& parameters = ParametersOf(entry);
  if (!CheckSent(kind, parameters, route, errors)) return;
  const std::string name = EntryName(kind, entry);
  const EntryInfo* info = kind.Find(name);
  if (info != nullptr) return AddDefects(*info, kind, parameters, route, errors);
  std::vector<std::string> names;
  for (const EntryInfo* known : kind.entries()) names.emplace_back(known->name);
  if (name.empty()) {
    errors->Add(route, std::string(kind.name_field) + " is missing" + SuggestNames("", names));
  } else {
    errors->Add(route.Then(kind.name_field), "there is no " + std::string(kind.noun) + " \"" +
                                                 name + "\"" + SuggestNames(name, names));
  }
}

void CheckForAnyEntry(const Message& entry, const Route& route, SceneErrors* errors) {
  const EntryKind& kind = *KindOf(entry.GetDescriptor());
  const Parameters& parameters = ParametersOf(entry);
  if (!CheckSent(kind, parameters, route, errors)) return;
  std::map<std::string, std::pair<size_t, std::string>> refused;  // by knob: entries, message
  size_t count = 0;
  for (const EntryInfo* info : kind.entries()) {
    ++count;
    std::vector<KnobDefect> defects;
    info->knobs.Read(ValuesOf(parameters), info->name, &defects);
    std::map<std::string, std::string> once;
    for (KnobDefect& defect : defects) once.emplace(defect.knob, std::move(defect.message));
    for (auto& [knob, message] : once) {
      auto& [entries, first] = refused[knob];
      if (entries++ == 0 || first.find("has no such knob") != std::string::npos) first = message;
    }
  }
  for (const auto& [knob, entries] : refused) {
    if (entries.first == count) errors->Add(route.ThenKnob(knob), entries.second);
  }
}

}  // namespace fjord
