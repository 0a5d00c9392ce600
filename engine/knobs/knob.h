// A knob: one value that a person can set on an entry of a registry (a fractal method, a texture
// stage, ...). The entry keeps its values in a plain struct of its own, which its kernel reads; a
// Knob describes one field of that struct. Everything else that is known about the field is made
// from this description: reading, ranges, tracks, the frame scene and its key, `fjord presets`,
// the tables of the documentation. knob_row.h makes knobs from pointers to members.
//
// The struct is passed as std::any, so that one code serves all entries. Knobs are immutable;
// texts and words are string literals or static tables.
#pragma once

#include <any>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/knobs/range.h"

namespace fjord {

enum class KnobType : uint8_t {
  kNumber,
  kWhole,   // from 0
  kFlag,    // true or false
  kChoice,  // one of the knob's words
  kText,
  kVector,  // x y z
  kColor,   // r g b, linear light
  kCurve,   // points x y, x ascending
};

// The value of a knob of any type. Which list holds it depends on the type; the others are empty.
struct KnobValue {
  std::vector<double> numbers;     // number 1, vector and colour 3, curve 2 for each point
  std::vector<uint64_t> wholes;    // whole number, flag
  std::vector<std::string> texts;  // choice, text
  friend bool operator==(const KnobValue&, const KnobValue&) = default;
};

// A word that a choice can be, with the number of its enumerator.
struct KnobWord {
  std::string_view word;
  uint32_t number;
  std::string_view effect;
};

struct Knob {
  std::string_view name;
  std::string_view effect;  // what one sees when it alone is turned up, or what it is
  KnobType type = KnobType::kNumber;
  bool list = false;  // any count of such values
  NumberRange range;  // of each number
  std::string_view unit;
  bool fixed = false;  // holds for the whole shot: no tracks
  std::span<const KnobWord> words;
  // Whether the knob changes anything beside the other values, and how to say when it does. Null:
  // it always does.
  bool (*works)(const std::any& settings) = nullptr;
  std::string_view works_when;
  // Of choices: the enumerator's number in `wholes`. Get and Set below give words.
  KnobValue (*get_raw)(const std::any& settings) = nullptr;
  void (*set_raw)(std::any& settings, const KnobValue& value) = nullptr;

  // The same knob with one thing more said of it.
  Knob In(double lowest, double highest) const;
  Knob Above(double lowest, double highest = kLargestNumber) const;
  Knob Of(std::span<const KnobWord> choices) const;
  Knob Unit(std::string_view name_of_unit) const;
  Knob Fixed() const;
  Knob When(std::string_view condition, bool (*holds)(const std::any& settings)) const;

  KnobValue Get(const std::any& settings) const;
  // `value` must have no defect.
  void Set(std::any& settings, const KnobValue& value) const;
  // How many numbers a track of this knob has: 0 where it cannot change over time.
  int TrackNumbers() const;
  bool Works(const std::any& settings) const { return works == nullptr || works(settings); }
  // What is wrong with a value: its type, its count, its range; empty where nothing is. `owner`,
  // the entry's name, takes part in the words.
  std::string DefectOf(const KnobValue& value, std::string_view owner) const;
  // "a number", "true or false", "a list of colours"
  std::string TypeText() const;
  // As a person writes it: 0.7, AFFINE, [0, 1, 0].
  std::string ValueText(const KnobValue& value) const;
};

}  // namespace fjord
