// The knobs of one entry of a registry, together with its defaults: the one description from which
// everything about its values is made.
//
// Immutable and safe to share between threads.
//
// Invariants
// K1 Every field of the entry's struct has one knob (KnobTableOf does not compile otherwise).
// K2 A list of NamedValues made by Changed holds no more than what makes a difference: a knob at
// its
//    default, or one that does not work beside the others, is left out. So a new knob leaves the
//    frame keys of old scenes as they are.
#pragma once

#include <utility>

#include "engine/knobs/field_count.h"
#include "engine/knobs/knob.h"

namespace fjord {

struct NamedValue {
  std::string name;
  KnobValue value;
  friend bool operator==(const NamedValue&, const NamedValue&) = default;
};

// What an entry cannot do. `knob` names the row; the message says what is wrong with its value.
struct KnobDefect {
  std::string knob;
  std::string message;
};

// "has no effect here; it works with law SHIH"
std::string IdleText(const Knob& knob);

// How values go together, beyond what single rows say. Appends to the list.
using KnobRule = void (*)(const std::any& settings, std::vector<KnobDefect>* defects);

class KnobTable {
 public:
  KnobTable() = default;
  KnobTable(std::vector<Knob> rows, std::any defaults, KnobRule rule = nullptr)
      : rows_(std::move(rows)), defaults_(std::move(defaults)), rule_(rule) {}

  std::span<const Knob> rows() const { return rows_; }
  // Null where there is no such knob.
  const Knob* Find(std::string_view name) const;
  // The entry's struct with every knob at its default.
  const std::any& defaults() const { return defaults_; }
  KnobValue DefaultOf(const Knob& knob) const { return knob.Get(defaults_); }

  // The entry's struct with the values set. Defects: unknown names, wrong values (both are left at
  // their defaults), values that have no effect beside the others, broken rules. `owner`: the
  // entry's name, for the words.
  std::any Read(std::span<const NamedValue> values, std::string_view owner,
                std::vector<KnobDefect>* defects) const;
  // Ranges and rules of values that did not come through Read.
  std::vector<KnobDefect> Check(const std::any& settings, std::string_view owner) const;
  // What differs from the defaults and has an effect, sorted by name.
  std::vector<NamedValue> Changed(const std::any& settings) const;

 private:
  std::vector<Knob> rows_;
  std::any defaults_;
  KnobRule rule_ = nullptr;
};

// The table of an entry that keeps its values in S.
template <typename S, size_t count>
KnobTable KnobTableOf(const Knob (&rows)[count], S defaults = {}, KnobRule rule = nullptr) {
  static_assert(count == FieldCount<S>(), "every field of the struct has one row in its table");
  return KnobTable(std::vector<Knob>(rows, rows + count), std::move(defaults), rule);
}

}  // namespace fjord
