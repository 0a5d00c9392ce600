#include "engine/knobs/knob_table.h"

#include <algorithm>

namespace fjord {

std::string IdleText(const Knob& knob) {
  return "has no effect here; it works with " + std::string(knob.works_when);
}

const Knob* KnobTable::Find(std::string_view name) const {
  for (const Knob& knob : rows_) {
    if (knob.name == name) return &knob;
  }
  return nullptr;
}

std::any KnobTable::Read(std::span<const NamedValue> values, std::string_view owner,
                         std::vector<KnobDefect>* defects) const {
  std::any settings = defaults_;
  for (const NamedValue& named : values) {
    const Knob* knob = Find(named.name);
    if (knob == nullptr) {
      defects->push_back({named.name, std::string(owner) + " has no such knob"});
      continue;
    }
    std::string defect = knob->DefectOf(named.value, owner);
    if (!defect.empty()) {
      defects->push_back({named.name, std::move(defect)});
    } else {
      knob->Set(settings, named.value);
    }
  }
  for (const NamedValue& named : values) {
    const Knob* knob = Find(named.name);
    if (knob == nullptr || knob->Works(settings) || knob->Get(settings) == DefaultOf(*knob))
      continue;
    defects->push_back({named.name, IdleText(*knob)});
  }
  if (rule_ != nullptr) rule_(settings, defects);
  return settings;
}

std::vector<KnobDefect> KnobTable::Check(const std::any& settings, std::string_view owner) const {
  std::vector<KnobDefect> defects;
  for (const Knob& knob : rows_) {
    std::string defect = knob.DefectOf(knob.Get(settings), owner);
    if (!defect.empty()) defects.push_back({std::string(knob.name), std::move(defect)});
  }
  if (rule_ != nullptr) rule_(settings, &defects);
  return defects;
}

std::vector<NamedValue> KnobTable::Changed(const std::any& settings) const {
  std::vector<NamedValue> changed;
  for (const Knob& knob : rows_) {
    KnobValue value = knob.Get(settings);
    if (!knob.Works(settings) || value == DefaultOf(knob)) continue;
    changed.push_back({std::string(knob.name), std::move(value)});
  }
  std::sort(changed.begin(), changed.end(),
            [](const NamedValue& a, const NamedValue& b) { return a.name < b.name; });
  return changed;
}

}  // namespace fjord
