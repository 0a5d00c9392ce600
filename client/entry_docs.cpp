#include "client/entry_docs.h"

namespace fjord {
namespace {

using Json = nlohmann::ordered_json;

std::string Padded(std::string text, size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text + " ";
}

// Which values a knob takes: its words, its range, or its type.
std::string ValuesText(const Knob& knob) {
  std::string text;
  for (const KnobWord& word : knob.words) text.append(text.empty() ? "" : " ").append(word.word);
  if (!text.empty()) return text;
  const bool numbers = knob.type == KnobType::kNumber || knob.type == KnobType::kWhole ||
                       knob.type == KnobType::kCurve;
  const NumberRange any;
  if (!numbers || (knob.range.lowest <= any.lowest && knob.range.highest >= any.highest))
    return knob.TypeText();
  const std::string highest = NumberText(knob.range.highest);
  if (knob.range.above) text = "above " + NumberText(knob.range.lowest);
  if (!knob.range.above) text = NumberText(knob.range.lowest) + " .. " + highest;
  return knob.list ? "a list, each " + text : text;
}

std::string EffectText(const Knob& knob) {
  std::string text(knob.effect);
  if (!knob.unit.empty()) text.append(", in ").append(knob.unit);
  if (!knob.works_when.empty()) text.append(" (with ").append(knob.works_when).append(")");
  return text;
}

}  // namespace

Json EntryJson(const EntryInfo& info) {
  Json knobs = Json::array();
  for (const Knob& knob : info.knobs.rows()) {
    Json row = {{"name", knob.name},
                {"type", knob.TypeText()},
                {"default", knob.ValueText(info.knobs.DefaultOf(knob))},
                {"values", ValuesText(knob)},
                {"tracks", knob.TrackNumbers() > 0},
                {"effect", knob.effect}};
    if (!knob.unit.empty()) row["unit"] = knob.unit;
    if (!knob.works_when.empty()) row["works_with"] = knob.works_when;
    for (const KnobWord& word : knob.words)
      row["words"].push_back({{"word", word.word}, {"effect", word.effect}});
    knobs.push_back(std::move(row));
  }
  return {{"name", info.name},
          {"version", info.version},
          {"summary", info.summary},
          {"knobs", std::move(knobs)}};
}

std::string EntryText(const EntryKind& kind, const EntryInfo& info) {
  std::string text = std::string(info.name) + "  (" + std::string(kind.noun) + " of " +
                     std::string(kind.where) + ", version " + std::to_string(info.version) +
                     ")\n  " + std::string(info.summary) + "\n";
  for (const Knob& knob : info.knobs.rows()) {
    text += "  " + Padded(std::string(knob.name), 11) +
            Padded(knob.ValueText(info.knobs.DefaultOf(knob)), 10) + Padded(ValuesText(knob), 16) +
            EffectText(knob) + "\n";
    for (const KnobWord& word : knob.words)
      text += std::string(14, ' ') + Padded(std::string(word.word), 10) + std::string(word.effect) +
              "\n";
  }
  return text;
}

std::string KindMarkdown(const EntryKind& kind) {
  std::string text;
  for (const EntryInfo* info : kind.entries()) {
    text += "`" + std::string(info->name) + "`: " + std::string(info->summary) +
            "\n\n| knob | values | default | tracks | turned up alone |\n|-|-|-|-|-|\n";
    for (const Knob& knob : info->knobs.rows()) {
      text += "| `" + std::string(knob.name) + "` | " + ValuesText(knob) + " | " +
              knob.ValueText(info->knobs.DefaultOf(knob)) + " | " +
              (knob.TrackNumbers() > 0 ? "yes" : "") + " | " + EffectText(knob) + " |\n";
    }
    text += "\n";
  }
  return text;
}

}  // namespace fjord
