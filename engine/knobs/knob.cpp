#include "engine/knobs/knob.h"

#include <algorithm>

#include "engine/base/check.h"

namespace fjord {
namespace {

constexpr size_t kLongestList = 4096;
constexpr size_t kLongestText = 4096;

// Places of one value in its list.
size_t WidthOf(KnobType type) {
  return type == KnobType::kVector || type == KnobType::kColor ? 3
         : type == KnobType::kCurve                            ? 2
                                                               : 1;
}

bool IsWhole(KnobType type) { return type == KnobType::kWhole || type == KnobType::kFlag; }
bool IsText(KnobType type) { return type == KnobType::kChoice || type == KnobType::kText; }

std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  return quoted.append(text).append("\"");
}

}  // namespace

Knob Knob::In(double lowest, double highest) const {
  Knob knob = *this;
  knob.range = {lowest, highest};
  return knob;
}

Knob Knob::Above(double lowest, double highest) const {
  Knob knob = *this;
  knob.range = {lowest, highest, true};
  return knob;
}

Knob Knob::Of(std::span<const KnobWord> choices) const {
  Knob knob = *this;
  knob.words = choices;
  return knob;
}

Knob Knob::Unit(std::string_view name_of_unit) const {
  Knob knob = *this;
  knob.unit = name_of_unit;
  return knob;
}

Knob Knob::Fixed() const {
  Knob knob = *this;
  knob.fixed = true;
  return knob;
}

Knob Knob::When(std::string_view condition, bool (*holds)(const std::any& settings)) const {
  Knob knob = *this;
  knob.works_when = condition;
  knob.works = holds;
  return knob;
}

KnobValue Knob::Get(const std::any& settings) const {
  KnobValue value = get_raw(settings);
  if (type != KnobType::kChoice) return value;
  for (const uint64_t number : value.wholes) {
    const auto word = std::find_if(words.begin(), words.end(),
                                   [&](const KnobWord& w) { return w.number == number; });
    value.texts.emplace_back(word == words.end() ? "?" : word->word);
  }
  value.wholes.clear();
  return value;
}

void Knob::Set(std::any& settings, const KnobValue& value) const {
  if (type != KnobType::kChoice) {
    set_raw(settings, value);
    return;
  }
  KnobValue raw;
  for (const std::string& text : value.texts) {
    const auto word =
        std::find_if(words.begin(), words.end(), [&](const KnobWord& w) { return w.word == text; });
    FJORD_CHECK(word != words.end(), name, text);
    raw.wholes.push_back(word->number);
  }
  set_raw(settings, raw);
}

int Knob::TrackNumbers() const {
  if (fixed || list || type == KnobType::kCurve || IsWhole(type) || IsText(type)) return 0;
  return static_cast<int>(WidthOf(type));
}

std::string Knob::DefectOf(const KnobValue& value, std::string_view owner) const {
  const std::string takes = "; " + std::string(owner) + " takes ";
  const size_t numbers = value.numbers.size(), wholes = value.wholes.size();
  const size_t texts = value.texts.size();
  const size_t right = IsText(type) ? texts : IsWhole(type) ? wholes : numbers;
  const size_t width = WidthOf(type);
  const bool many = list || type == KnobType::kCurve;
  if (numbers + wholes + texts != right || right % width != 0 || (!many && right != width))
    return "this is not " + TypeText();
  if (right / width > kLongestList)
    return std::to_string(right / width) + " values; at most " + std::to_string(kLongestList);
  for (const double number : value.numbers) {
    if (!(number - number == 0)) return "not a finite number" + takes + range.ToString();
    if (!range.Holds(number)) return NumberText(number) + takes + range.ToString();
  }
  for (const uint64_t whole : value.wholes) {
    if (type == KnobType::kFlag ? whole > 1 : !range.Holds(static_cast<double>(whole)))
      return std::to_string(whole) +
             (type == KnobType::kFlag ? takes + "true or false" : takes + range.ToString());
  }
  for (size_t i = 2; type == KnobType::kCurve && i < numbers; i += 2) {
    if (value.numbers[i] > value.numbers[i - 2]) continue;
    return NumberText(value.numbers[i]) + " comes after " + NumberText(value.numbers[i - 2]) +
           "; the first number of each point must ascend";
  }
  for (const std::string& text : value.texts) {
    if (text.size() > kLongestText) return "the text is longer than 4096 bytes";
    if (type != KnobType::kChoice) continue;
    std::string known;
    bool found = false;
    for (const KnobWord& word : words) {
      found = found || word.word == text;
      known += (known.empty() ? "" : ", ") + std::string(word.word);
    }
    if (!found) return text + " is not one of " + std::string(owner) + "'s: " + known;
  }
  return "";
}

std::string Knob::TypeText() const {
  switch (type) {
    case KnobType::kNumber:
      return list ? "a list of numbers" : "a number";
    case KnobType::kWhole:
      return list ? "a list of whole numbers" : "a whole number";
    case KnobType::kFlag:
      return list ? "a list of true and false" : "true or false";
    case KnobType::kChoice:
      return list ? "a list of words" : "a word";
    case KnobType::kText:
      return list ? "a list of texts" : "a text";
    case KnobType::kVector:
      return list ? "a list of vectors" : "a vector";
    case KnobType::kColor:
      return list ? "a list of colours" : "a colour";
    case KnobType::kCurve:
      return "a curve: a list of x and y in turn";
  }
  return "";
}

std::string Knob::ValueText(const KnobValue& value) const {
  std::vector<std::string> parts;
  for (const double number : value.numbers) parts.push_back(NumberText(number));
  for (const uint64_t whole : value.wholes)
    parts.push_back(type != KnobType::kFlag ? std::to_string(whole)
                    : whole != 0            ? "true"
                                            : "false");
  for (const std::string& text : value.texts)
    parts.push_back(type == KnobType::kText ? Quoted(text) : text);
  if (!list && parts.size() == 1) return parts[0];
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  std::string whole = "[";
  return whole.append(text).append("]");
}

}  // namespace fjord
