// MessageBinder::PutKnob: a single value into a knob's parameter, and what numbers are.
#include <algorithm>
#include <charconv>

#include "engine/scene/binder.h"
#include "engine/scene/nearest.h"
#include "engine/scene/parameters.h"

namespace fjord {
namespace {

// Every word that a knob of this name can be in any entry.
std::vector<std::string> WordsOf(const EntryKind& kind, std::string_view name) {
  std::vector<std::string> words;
  for (const EntryInfo* entry : kind.entries()) {
    const Knob* knob = entry->knobs.Find(name);
    if (knob == nullptr) continue;
    for (const KnobWord& word : knob->words) {
      if (std::find(words.begin(), words.end(), word.word) == words.end())
        words.emplace_back(word.word);
    }
  }
  return words;
}

std::string Shown(const WrittenValue& value) {
  if (value.kind != WrittenValue::Kind::kText) return value.text;
  std::string text = "\"";
  return text.append(value.text.substr(0, 40)).append("\"");
}

}  // namespace

bool MessageBinder::ToNumber(const WrittenValue& value, double* number) const {
  if (value.kind == WrittenValue::Kind::kNumber) {
    *number = value.number;
    return true;
  }
  if (value.kind != WrittenValue::Kind::kText || !json_) return false;
  const char* end = value.text.data() + value.text.size();
  const auto [stop, code] = std::from_chars(value.text.data(), end, *number);
  return stop == end && code == std::errc() && !value.text.empty();
}

bool MessageBinder::ToWhole(const WrittenValue& value, uint64_t most, uint64_t* whole) const {
  *whole = value.whole;
  if (value.kind == WrittenValue::Kind::kNumber) return value.is_whole && *whole <= most;
  if (value.kind != WrittenValue::Kind::kText || !json_) return false;
  const char* end = value.text.data() + value.text.size();
  const auto [stop, code] = std::from_chars(value.text.data(), end, *whole);
  return stop == end && code == std::errc() && *whole <= most;
}

void MessageBinder::Mismatch(const WrittenValue& value, const std::string& wanted, TextPlace at) {
  const Level& level = top();
  const std::string name = level.name.empty() ? levels_[levels_.size() - 2].name : level.name;
  Fail(level.in_list || level.name.empty() ? at : level.place,
       name + " wants " + wanted + ", not " + Shown(value));
}

v1::Parameter* MessageBinder::OpenParameter() {
  const std::string_view name = top().target.knob->name;
  Parameters* all = MutableParametersOf(top().message);
  for (v1::Parameter& parameter : *all) {
    if (parameter.name() == name) return &parameter;
  }
  v1::Parameter* parameter = all->Add();
  parameter->set_name(std::string(name));
  return parameter;
}

void MessageBinder::PutKnob(const WrittenValue& value, TextPlace at) {
  const Level& level = top();
  const Knob& knob = *level.target.knob;
  const bool word = value.kind == WrittenValue::Kind::kWord;
  switch (knob.type) {
    case KnobType::kNumber:
    case KnobType::kCurve: {
      double number = 0;
      if (knob.type == KnobType::kCurve && !level.in_list)
        return Mismatch(value, knob.TypeText(), at);
      if (!ToNumber(value, &number)) return Mismatch(value, "a number", at);
      OpenParameter()->add_number(number);
      break;
    }
    case KnobType::kWhole: {
      uint64_t whole = 0;
      if (!ToWhole(value, UINT64_MAX, &whole)) return Mismatch(value, "a whole number from 0", at);
      OpenParameter()->add_whole(whole);
      break;
    }
    case KnobType::kFlag:
      if (!word || (value.text != "true" && value.text != "false"))
        return Mismatch(value, "true or false", at);
      OpenParameter()->add_whole(value.text == "true" ? 1 : 0);
      break;
    case KnobType::kChoice: {
      const std::vector<std::string> words = WordsOf(*level.kind, knob.name);
      if (value.kind == WrittenValue::Kind::kNumber ||
          std::find(words.begin(), words.end(), value.text) == words.end()) {
        return Fail(level.in_list ? at : level.place, level.name + " cannot be " + Shown(value) +
                                                          SuggestNames(value.text, words, 16));
      }
      OpenParameter()->add_text(value.text);
      break;
    }
    case KnobType::kText:
      if (value.kind != WrittenValue::Kind::kText) return Mismatch(value, "a text in quotes", at);
      OpenParameter()->add_text(value.text);
      break;
    case KnobType::kVector:
    case KnobType::kColor:
      return Mismatch(value, knob.TypeText() + " as in [0, 0, 1]", at);
  }
  AddPlace(at);
}

}  // namespace fjord
