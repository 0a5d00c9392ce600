// The table of an entry that has a field of every type.
#include "engine/knobs/knob_table.h"

#include <gtest/gtest.h>

#include "engine/knobs/knob_row.h"
#include "engine/knobs/registry.h"

namespace fjord {
namespace {

enum class Form : uint32_t { kRound = 1, kSharp };
constexpr KnobWord kForms[] = {{"ROUND", 1, "soft tops"}, {"SHARP", 2, "peaks"}};

struct HillSettings {
  double height = 2;
  float gain = .5F;
  uint32_t count = 3;
  uint64_t seed = 1;
  bool snow = false;
  Form form = Form::kRound;
  std::string label = "hill";
  Vec3 axis{0, 0, 1};
  Rgb color{1, .5F, .25F};
  std::vector<double> heights{1, 2};
  std::vector<Rgb> colors;
  KnobCurve profile{{{0, 0}, {1, 1}}};
  double edge = 1;
};

KnobTable Hills() {
  const Knob rows[] = {
      KnobRow<&HillSettings::height>("height", "higher hills").In(0, 10).Unit("units"),
      KnobRow<&HillSettings::gain>("gain", "more of everything").Above(0),
      KnobRow<&HillSettings::count>("count", "more hills").In(1, 9),
      KnobRow<&HillSettings::seed>("seed", "other hills"),
      KnobRow<&HillSettings::snow>("snow", "white tops"),
      KnobRow<&HillSettings::form>("form", "what tops look like").Of(kForms),
      KnobRow<&HillSettings::label>("label", "what it is called"),
      KnobRow<&HillSettings::axis>("axis", "where up is"),
      KnobRow<&HillSettings::color>("color", "of the slopes"),
      KnobRow<&HillSettings::heights>("heights", "of single hills").In(0, 10),
      KnobRow<&HillSettings::colors>("colors", "of single hills"),
      KnobRow<&HillSettings::profile>("profile", "height over distance"),
      KnobRow<&HillSettings::edge>("edge", "sharper edges")
          .Fixed()
          .When("form SHARP",
                WhenSettings<HillSettings,
                             [](const HillSettings& s) { return s.form == Form::kSharp; }>),
  };
  return KnobTableOf<HillSettings>(rows, {}, [](const std::any& settings, auto* defects) {
    const auto& s = std::any_cast<const HillSettings&>(settings);
    if (s.snow && s.height < 1) defects->push_back({"snow", "needs a height of 1 or more"});
  });
}

// Another right value of the knob.
KnobValue Other(const Knob& knob) {
  switch (knob.type) {
    case KnobType::kNumber:
      return {.numbers = {3.5}};
    case KnobType::kWhole:
      return {.wholes = {5}};
    case KnobType::kFlag:
      return {.wholes = {1}};
    case KnobType::kChoice:
      return {.texts = {"SHARP"}};
    case KnobType::kText:
      return {.texts = {"other"}};
    case KnobType::kVector:
    case KnobType::kColor:
      return {.numbers = {.25, .5, .75}};
    case KnobType::kCurve:
      return {.numbers = {0, 1, 2, 3}};
  }
  return {};
}

std::string DefectsText(const std::vector<NamedValue>& values) {
  std::vector<KnobDefect> defects;
  Hills().Read(values, "hills", &defects);
  std::string text;
  for (const KnobDefect& defect : defects) text += defect.knob + ": " + defect.message + "\n";
  return text;
}

static_assert(FieldCount<HillSettings>() == 13);

TEST(KnobTableTest, EachKnobWritesItsOwnFieldAndNoOther) {
  const KnobTable table = Hills();
  for (const Knob& knob : table.rows()) {
    std::any settings = table.defaults();
    const KnobValue other = Other(knob);
    ASSERT_EQ(knob.DefectOf(other, "hills"), "") << knob.name;
    ASSERT_NE(other, table.DefaultOf(knob)) << knob.name;
    knob.Set(settings, other);
    for (const Knob& each : table.rows()) {
      EXPECT_EQ(each.Get(settings), &each == &knob ? other : table.DefaultOf(each)) << knob.name;
    }
  }
}

TEST(KnobTableTest, ChangedHoldsWhatDiffersAndWorksSortedByName) {
  const KnobTable table = Hills();
  HillSettings hills;
  EXPECT_TRUE(table.Changed(hills).empty());
  hills.height = 4;
  hills.count = 5;
  hills.edge = 7;
  EXPECT_EQ(table.Changed(hills),
            (std::vector<NamedValue>{{"count", {.wholes = {5}}}, {"height", {.numbers = {4}}}}));
  hills.form = Form::kSharp;
  ASSERT_EQ(table.Changed(hills).size(), 4u);
  EXPECT_EQ(table.Changed(hills)[1], (NamedValue{"edge", {.numbers = {7}}}));
  EXPECT_EQ(table.Changed(hills)[2], (NamedValue{"form", {.texts = {"SHARP"}}}));
}

TEST(KnobTableTest, WhatChangedReadsBack) {
  const KnobTable table = Hills();
  std::any settings = table.defaults();
  for (const Knob& knob : table.rows()) knob.Set(settings, Other(knob));
  std::vector<KnobDefect> defects;
  const std::vector<NamedValue> changed = table.Changed(settings);
  EXPECT_EQ(changed.size(), table.rows().size());
  const std::any again = table.Read(changed, "hills", &defects);
  EXPECT_TRUE(defects.empty());
  EXPECT_EQ(table.Changed(again), changed);
}

TEST(KnobTableTest, EveryDefectIsNamed) {
  EXPECT_EQ(DefectsText({{"height", {.numbers = {12}}},
                         {"count", {.wholes = {0}}},
                         {"snow", {.wholes = {2}}},
                         {"form", {.texts = {"FLAT"}}},
                         {"axis", {.numbers = {1, 2}}},
                         {"profile", {.numbers = {1, 2, 1, 3}}},
                         {"gain", {.numbers = {0}}},
                         {"heights", {.numbers = {1, 20}}},
                         {"label", {.numbers = {1}}},
                         {"sun", {.numbers = {1}}}}),
            "height: 12; hills takes 0 to 10\n"
            "count: 0; hills takes 1 to 9\n"
            "snow: 2; hills takes true or false\n"
            "form: FLAT is not one of hills's: ROUND, SHARP\n"
            "axis: this is not a vector\n"
            "profile: 1 comes after 1; the first number of each point must ascend\n"
            "gain: 0; hills takes above 0\n"
            "heights: 20; hills takes 0 to 10\n"
            "label: this is not a text\n"
            "sun: hills has no such knob\n");
  EXPECT_EQ(DefectsText({{"height", {.numbers = {0.0 / 0.0}}}}),
            "height: not a finite number; hills takes 0 to 10\n");
  EXPECT_EQ(DefectsText({{"height", {.numbers = {.5}}}, {"snow", {.wholes = {1}}}}),
            "snow: needs a height of 1 or more\n");
}

TEST(KnobTableTest, AKnobWithoutEffectIsRefusedUnlessAtItsDefault) {
  EXPECT_EQ(DefectsText({{"edge", {.numbers = {3}}}}),
            "edge: has no effect here; it works with form SHARP\n");
  EXPECT_EQ(DefectsText({{"edge", {.numbers = {3}}}, {"form", {.texts = {"SHARP"}}}}), "");
  EXPECT_EQ(DefectsText({{"edge", {.numbers = {1}}}}), "");
}

TEST(KnobTableTest, OnlyNumbersOfTheFrameHaveTracks) {
  const KnobTable table = Hills();
  const auto numbers = [&](std::string_view name) { return table.Find(name)->TrackNumbers(); };
  EXPECT_EQ(numbers("height"), 1);
  EXPECT_EQ(numbers("axis"), 3);
  EXPECT_EQ(numbers("color"), 3);
  for (const char* name : {"edge", "count", "snow", "form", "label", "heights", "profile"})
    EXPECT_EQ(numbers(name), 0) << name;
}

TEST(KnobTableTest, ValuesAreShownAsTheyAreWritten) {
  const KnobTable table = Hills();
  const auto text = [&](std::string_view name) {
    const Knob& knob = *table.Find(name);
    return knob.ValueText(table.DefaultOf(knob));
  };
  EXPECT_EQ(text("height"), "2");
  EXPECT_EQ(text("snow"), "false");
  EXPECT_EQ(text("form"), "ROUND");
  EXPECT_EQ(text("label"), "\"hill\"");
  EXPECT_EQ(text("axis"), "[0, 0, 1]");
  EXPECT_EQ(text("profile"), "[0, 0, 1, 1]");
  EXPECT_EQ(text("colors"), "[]");
}

TEST(RegistryTest, EntriesAreFoundByName) {
  Registry<EntryInfo> registry({{"hills", 2, "round ones", Hills()}});
  ASSERT_NE(registry.Find("hills"), nullptr);
  EXPECT_EQ(registry.Find("hills")->version, 2u);
  EXPECT_EQ(registry.Find("dunes"), nullptr);
  registry.Extend({"dunes", 1, "long ones", Hills()});
  EXPECT_EQ(registry.entries().back().name, "dunes");
}

}  // namespace
}  // namespace fjord
