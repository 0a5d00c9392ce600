// What a method offers, read from its table: every combination of its choices, and its words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/fractal/registry.h"

namespace fjord::test {

struct Choice {
  std::string name;  // "AFFINE/EDGE/FIXED": the words, but those that stand for number 0
  std::any own;
};

// Every combination of words that the table allows; all other knobs at their defaults.
inline std::vector<Choice> AllChoices(const MethodInfo& method) {
  std::vector<Choice> choices = {{"", method.knobs.defaults()}};
  for (const Knob& knob : method.knobs.rows()) {
    if (knob.type != KnobType::kChoice || knob.list) continue;
    std::vector<Choice> more;
    for (const Choice& choice : choices) {
      for (const KnobWord& word : knob.words) {
        Choice next = choice;
        knob.Set(next.own, {.texts = {std::string(word.word)}});
        if (word.number > 0 && !next.name.empty()) next.name += '/';
        if (word.number > 0) next.name += word.word;
        more.push_back(std::move(next));
      }
    }
    choices = std::move(more);
  }
  std::erase_if(choices, [&](const Choice& choice) {
    return !method.knobs.Check(choice.own, method.name).empty();
  });
  return choices;
}

// Sets a knob where the method has it.
inline void SetKnob(const MethodInfo& method, std::string_view name, const KnobValue& value,
                    std::any* own) {
  if (const Knob* knob = method.knobs.Find(name); knob != nullptr) knob->Set(*own, value);
}

template <typename Enum>
std::vector<Enum> WordsOf(const MethodInfo& method, std::string_view knob) {
  std::vector<Enum> values;
  for (const KnobWord& word : method.knobs.Find(knob)->words)
    values.push_back(static_cast<Enum>(word.number));
  return values;
}
inline std::vector<Law> LawsOf(const MethodInfo& m) { return WordsOf<Law>(m, "law"); }
inline std::vector<Direction> DirectionsOf(const MethodInfo& m) {
  return WordsOf<Direction>(m, "direction");
}
inline std::vector<Variant> VariantsOf(const MethodInfo& m) {
  return WordsOf<Variant>(m, "variant");
}
inline constexpr Split kSplits[] = {Split::kShot, Split::kAdaptive, Split::kLength};

}  // namespace fjord::test

namespace fjord {

// The word of a number in any method's choice of that name.
inline std::string_view WordOf(std::string_view knob, uint32_t number) {
  for (const MethodInfo& method : FractalMethods()) {
    const Knob* found = method.knobs.Find(knob);
    if (found == nullptr) continue;
    for (const KnobWord& word : found->words) {
      if (word.number == number) return word.word;
    }
  }
  return "?";
}
inline std::string_view LawName(Law law) { return WordOf("law", static_cast<uint32_t>(law)); }
inline std::string_view DirectionName(Direction direction) {
  return WordOf("direction", static_cast<uint32_t>(direction));
}
inline std::string_view VariantName(Variant variant) {
  return WordOf("variant", static_cast<uint32_t>(variant));
}
inline std::string_view SplitName(Split split) {
  constexpr std::string_view kNames[] = {"SPLIT_DEFAULT", "SHOT", "ADAPTIVE", "LENGTH"};
  return kNames[static_cast<uint32_t>(split)];
}

}  // namespace fjord
