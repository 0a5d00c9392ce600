// Makes a Knob from a pointer to a member: the member's type says the knob's type, so that the two
// cannot disagree.
//
//   enum class Form { kRound, kSharp };
//   struct HillSettings { double height = 1; Form form = Form::kRound; };
//   const Knob kRows[] = {
//       KnobRow<&HillSettings::height>("height", "higher hills").In(0, 10),
//       KnobRow<&HillSettings::form>("form", "what tops look like").Of(kForms),
//   };
#pragma once

#include <array>
#include <type_traits>

#include "engine/geometry/vec.h"
#include "engine/knobs/knob.h"

namespace fjord {

// A curve as an entry keeps it: points x y.
struct KnobCurve {
  std::vector<std::array<double, 2>> points;
  friend bool operator==(const KnobCurve&, const KnobCurve&) = default;
};

// How a field of type T stands in a KnobValue: `width` places from `at`.
template <typename T>
struct KnobField;

template <typename T, KnobType kind, auto list_member, typename Stored>
struct PlainKnobField {
  static constexpr KnobType type = kind;
  static constexpr size_t width = 1;
  static auto& List(auto& value) { return value.*list_member; }
  static void Put(const T& field, KnobValue* value) {
    List(*value).push_back(static_cast<Stored>(field));
  }
  static T Take(const KnobValue& value, size_t at) { return static_cast<T>(List(value)[at]); }
};

template <>
struct KnobField<double> : PlainKnobField<double, KnobType::kNumber, &KnobValue::numbers, double> {
};
template <>
struct KnobField<float> : PlainKnobField<float, KnobType::kNumber, &KnobValue::numbers, double> {};
template <>
struct KnobField<uint32_t>
    : PlainKnobField<uint32_t, KnobType::kWhole, &KnobValue::wholes, uint64_t> {};
template <>
struct KnobField<uint64_t>
    : PlainKnobField<uint64_t, KnobType::kWhole, &KnobValue::wholes, uint64_t> {};
template <>
struct KnobField<bool> : PlainKnobField<bool, KnobType::kFlag, &KnobValue::wholes, uint64_t> {};
template <>
struct KnobField<std::string>
    : PlainKnobField<std::string, KnobType::kText, &KnobValue::texts, std::string> {};
template <typename T>
requires std::is_enum_v<T>
struct KnobField<T> : PlainKnobField<T, KnobType::kChoice, &KnobValue::wholes, uint64_t> {
};

template <typename T, KnobType kind>
struct TripleKnobField {
  static constexpr KnobType type = kind;
  static constexpr size_t width = 3;
  static auto& List(auto& value) { return value.numbers; }
  static void Put(const T& field, KnobValue* value) {
    for (int i = 0; i < 3; ++i) value->numbers.push_back(field[i]);
  }
  static T Take(const KnobValue& value, size_t at) {
    const auto number = [&](size_t i) {
      return static_cast<typename T::value_type>(value.numbers[at + i]);
    };
    return T(number(0), number(1), number(2));
  }
};
template <>
struct KnobField<Vec3> : TripleKnobField<Vec3, KnobType::kVector> {};
template <>
struct KnobField<Rgb> : TripleKnobField<Rgb, KnobType::kColor> {};

template <>
struct KnobField<KnobCurve> {
  static constexpr KnobType type = KnobType::kCurve;
  static constexpr size_t width = 0;  // as many as there are
  static void Put(const KnobCurve& field, KnobValue* value) {
    for (const auto& point : field.points) {
      value->numbers.insert(value->numbers.end(), point.begin(), point.end());
    }
  }
  static KnobCurve Take(const KnobValue& value, size_t) {
    KnobCurve curve;
    for (size_t i = 0; i + 1 < value.numbers.size(); i += 2)
      curve.points.push_back({value.numbers[i], value.numbers[i + 1]});
    return curve;
  }
};

template <typename T>
struct KnobField<std::vector<T>> {
  using Item = KnobField<T>;
  static_assert(Item::width > 0, "a list of lists is no knob");
  static constexpr KnobType type = Item::type;
  static void Put(const std::vector<T>& field, KnobValue* value) {
    for (const T& item : field) Item::Put(item, value);
  }
  static std::vector<T> Take(const KnobValue& value, size_t) {
    std::vector<T> field;
    for (size_t at = 0; at + Item::width <= Item::List(value).size(); at += Item::width)
      field.push_back(Item::Take(value, at));
    return field;
  }
};

template <typename T>
inline constexpr bool kIsKnobList = false;
template <typename T>
inline constexpr bool kIsKnobList<std::vector<T>> = true;

template <auto member>
struct KnobMember;
template <typename S, typename T, T S::*member>
struct KnobMember<member> {
  using Settings = S;
  using Type = T;
};

template <auto member>
Knob KnobRow(std::string_view name, std::string_view effect) {
  using Settings = typename KnobMember<member>::Settings;
  using Type = typename KnobMember<member>::Type;
  Knob knob;
  knob.name = name;
  knob.effect = effect;
  knob.type = KnobField<Type>::type;
  knob.list = kIsKnobList<Type>;
  if (knob.type == KnobType::kWhole) knob.range = {0, sizeof(Type) == 4 ? 4294967295.0 : 0x1p64};
  if (knob.type == KnobType::kColor) knob.range = {0, 1e6};
  knob.get_raw = [](const std::any& settings) {
    KnobValue value;
    KnobField<Type>::Put(std::any_cast<const Settings&>(settings).*member, &value);
    return value;
  };
  knob.set_raw = [](std::any& settings, const KnobValue& value) {
    std::any_cast<Settings&>(settings).*member = KnobField<Type>::Take(value, 0);
  };
  return knob;
}

// A condition of Knob::When on the entry's own struct:
//   WhenSettings<HillSettings, [](const HillSettings& s) { return s.form == Form::kSharp; }>
template <typename Settings, auto holds>
bool WhenSettings(const std::any& settings) {
  return holds(std::any_cast<const Settings&>(settings));
}

}  // namespace fjord
