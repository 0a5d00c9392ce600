// An entry of a registry is one file and one line: a toy method and a toy stage are found wherever
// entries are read, checked, written down or shown, and no other code knows of them.
#include <gtest/gtest.h>

#include "client/entry_docs.h"
#include "tests/animation/animate.h"
#include "tests/fractal/choices.h"
#include "tests/scene/entry_values.h"
#include "tests/toy/toys.h"

namespace fjord::testing {
namespace {

// The registries' lines, before any test looks at them, and after the tables of the real entries
// have been made.
class Toys : public ::testing::Environment {
 public:
  void SetUp() override {
    FractalRegistry().Extend(ToyMethod());
    StageRegistry().Extend(ToyStage());
  }
};
const ::testing::Environment* const kToys = ::testing::AddGlobalTestEnvironment(new Toys);

std::string SceneWith(const std::string& fractal, const std::string& stage = "",
                      const std::string& more = "") {
  return "output { frames: 3 width: 16 height: 9 }\n"
         "objects {\n"
         "  name: \"o\"\n"
         "  shape { primitive { kind: GRID } }\n"
         "  fractal { method: toy " +
         fractal +
         " }\n"
         "  material { stage { kind: paint " +
         stage + " } }\n}\n" + more;
}

std::string TrackOf(const std::string& path, const std::string& from, const std::string& to) {
  return "track { path: \"objects[o]." + path + "\" key { frame: 1 value: " + from +
         " } key { frame: 3 value: " + to + " } }";
}

const v1::Object& ObjectOf(const LoadResult& loaded) { return loaded.loaded.scene.objects(0); }

TEST(ToyTest, ValuesAreReadAndDefaulted) {
  const LoadResult loaded = Load(SceneWith("toy_rounds: 3", "toy_share: 0.25"));
  ASSERT_TRUE(loaded.ok()) << ErrorsOf(loaded);
  EXPECT_EQ(ValueIn(ObjectOf(loaded).fractal(), "toy_rounds"), "3");
  EXPECT_EQ(ValueIn(ObjectOf(loaded).fractal(), "toy_lift"), "0.5");
  EXPECT_EQ(ValueIn(ObjectOf(loaded).material().stage(0), "toy_share"), "0.25");
  EXPECT_EQ(ValueIn(ObjectOf(loaded).material().stage(0), "color"), "[0.25, 0.5, 0.75]");
}

TEST(ToyTest, JsonMeansTheSame) {
  const std::string json =
      R"({"objects": [{"name": "o", "shape": {"primitive": {"kind": "GRID"}},
 "fractal": {"method": "toy", "toy_lift": 2, "toy_rounds": 3},
 "material": {"stage": [{"kind": "paint", "toy_share": 0.25, "color": [1, 0, 0]}]}}]})";
  const LoadResult loaded = Load(json);
  ASSERT_TRUE(loaded.ok()) << ErrorsOf(loaded);
  EXPECT_EQ(ValueIn(ObjectOf(loaded).fractal(), "toy_lift"), "2");
  EXPECT_EQ(ValueIn(ObjectOf(loaded).material().stage(0), "color"), "[1, 0, 0]");
  std::string wrong = json;
  wrong.replace(wrong.find("\"toy_lift\": 2"), 13, "\"toy_lift\": 4");
  EXPECT_EQ(ErrorsOf(wrong),
            "s.scene:2:31: error: objects[o].fractal.toy_lift: 4; toy takes 0 to 3\n");
}

TEST(ToyTest, DefectsHaveTheirPlaceAndTheNearestName) {
  EXPECT_EQ(ErrorsOf(SceneWith("toy_lift: 4", "toy_share: 2")),
            "s.scene:5:25: error: objects[o].fractal.toy_lift: 4; toy takes 0 to 3\n"
            "s.scene:6:34: error: objects[o].material.stage[1].toy_share: 2; paint takes 0 to 1\n");
  const std::string misspelt = ErrorsOf(SceneWith("toy_lfit: 1", "toy_shar: 1"));
  EXPECT_NE(misspelt.find("s.scene:5:25: error: Fractal has no field \"toy_lfit\"; did you mean "
                          "toy_lift"),
            std::string::npos)
      << misspelt;
  EXPECT_NE(misspelt.find("s.scene:6:34: error: Stage has no field \"toy_shar\"; did you mean "
                          "toy_share"),
            std::string::npos)
      << misspelt;
  EXPECT_NE(ErrorsOf(SceneWith("H: 0.5")).find("method toy has no such knob"), std::string::npos);
}

TEST(ToyTest, SetAndTracksReachTheFrameScene) {
  const auto animation =
      Animate(SceneWith("", "", TrackOf("material.stage[1].toy_share", "0", "1")),
              {{"objects[o].fractal.toy_lift", "1.5"}});
  ASSERT_NE(animation, nullptr);
  const v1::FrameScene frame = FrameOf(*animation, 3);
  EXPECT_EQ(ValueIn(frame.object(0).fractal(), "toy_lift"), "1.5");
  EXPECT_EQ(ValueIn(frame.object(0).fractal(), "toy_rounds"), "");  // at its default
  EXPECT_EQ(ValueIn(frame.object(0).material().stage(0), "toy_share"), "1");
  EXPECT_NE(KeyOf(*animation, 1), KeyOf(*animation, 3));
}

TEST(ToyTest, WhatIsNoNumberOfAFrameHasNoTrack) {
  const std::string errors = ErrorsOf(SceneWith("", "", TrackOf("fractal.toy_rounds", "1", "2")));
  EXPECT_NE(errors.find("toy_rounds shapes the whole shot; it cannot change over time"),
            std::string::npos)
      << errors;
  EXPECT_NE(ErrorsOf(SceneWith("", "", TrackOf("fractal.toy_lift", "1", "4"))), "");
}

TEST(ToyTest, TheFrameKeyFollowsValuesAndVersions) {
  const std::string plain = KeyOf(*Animate(SceneWith("")), 1);
  EXPECT_EQ(plain, KeyOf(*Animate(SceneWith("toy_lift: 0.5", "toy_share: 0.5")), 1));
  EXPECT_NE(plain, KeyOf(*Animate(SceneWith("toy_lift: 1")), 1));
  EXPECT_NE(plain, KeyOf(*Animate(SceneWith("", "toy_share: 1")), 1));
  const auto bytes = FrameKeyBytes(FrameOf(*Animate(SceneWith("")), 1));
  ASSERT_TRUE(bytes.ok());
  EXPECT_NE(bytes->find("fractal/toy 7\n"), std::string::npos);
  EXPECT_NE(bytes->find("texture/paint 5\n"), std::string::npos);
}

TEST(ToyTest, PresetsTablesAndSchemaShowThem) {
  const std::string schema = SceneSchema().dump();
  for (const EntryKind& kind : EntryKinds()) {
    const bool method = kind.name == "fractal";
    const std::string name = method ? "toy" : "paint", knob = method ? "toy_lift" : "toy_share";
    const EntryInfo* info = kind.Find(name);
    ASSERT_NE(info, nullptr);
    EXPECT_NE(EntryText(kind, *info).find(knob), std::string::npos);
    EXPECT_NE(EntryJson(*info).dump().find("\"name\":\"" + knob + "\""), std::string::npos);
    EXPECT_NE(KindMarkdown(kind).find("| `" + knob + "` | 0 .. " + (method ? "3" : "1") +
                                      " | 0.5 | yes |"),
              std::string::npos);
    EXPECT_NE(schema.find("\"" + knob + "\""), std::string::npos);
  }
}

TEST(ToyTest, TheLoopsOverTheRegistriesMeetThem) {
  EXPECT_EQ(FractalMethods().back().name, "toy");
  EXPECT_EQ(TextureStages().back().name, "paint");
  // Of what the gate's probe makes of a table:
  EXPECT_EQ(test::AllChoices(FractalMethods().back()).size(), 1u);
}

TEST(ToyTest, KnobsOfOneNameHaveOneTypeInAKind) {
  for (const EntryKind& kind : EntryKinds()) {
    for (const EntryInfo* info : kind.entries()) {
      for (const Knob& knob : info->knobs.rows()) {
        EXPECT_EQ(kind.AnyKnob(knob.name)->type, knob.type) << kind.name << " " << knob.name;
        EXPECT_EQ(kind.AnyKnob(knob.name)->list, knob.list) << kind.name << " " << knob.name;
        EXPECT_EQ(kind.scene_message->FindFieldByName(std::string(knob.name)), nullptr)
            << kind.name << " " << knob.name;
      }
    }
  }
}

}  // namespace
}  // namespace fjord::testing
