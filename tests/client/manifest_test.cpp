#include "client/manifest.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/base/digest.h"

namespace fjord {
namespace {

Manifest Example() {
  v1::Scene scene;
  scene.set_name("hill");
  scene.mutable_output()->set_rate(25);
  scene.mutable_output()->set_frames(3);
  v1::Object* object = scene.add_objects();
  object->set_name("hill");
  object->mutable_fractal()->set_seed(1989);
  v1::Parameter* roughness = object->mutable_fractal()->add_parameter();
  roughness->set_name("H");
  roughness->add_number(.3);
  for (int i = 0; i < 5000; ++i) object->mutable_shape()->mutable_mesh()->add_point()->set_x(i);
  Manifest manifest = DescribeScene(scene, "hill.scene", Sha256Of("scene").Hex());
  manifest.frames[2] = {"hill.0002.png", Sha256Of("p").Hex(), Sha256Of("k").Hex(), 12345678901, 17};
  return manifest;
}

TEST(ManifestTest, C47_HoldsSeedAndEveryParameter) {
  const auto json = nlohmann::json::parse(ManifestText(Example()));
  const auto& fractal = json["scene"]["parameters"]["objects"][0]["fractal"];
  EXPECT_EQ(fractal["seed"], "1989");  // 64 bits: text in JSON
  EXPECT_EQ(fractal["H"], .3);
  EXPECT_TRUE(json["engine"].contains("version"));
  EXPECT_EQ(json["scene"]["file"], "hill.scene");
  EXPECT_FALSE(json["scene"]["parameters"]["objects"][0]["shape"]["mesh"].contains("point"));
}

TEST(ManifestTest, ReadsBackWhatItWrites) {
  const Manifest before = Example();
  const Result<Manifest> after = ParseManifest(ManifestText(before), "manifest.json");
  ASSERT_TRUE(after.ok()) << after.error().message;
  EXPECT_EQ(after->name, "hill");
  EXPECT_EQ(after->rate, 25);
  EXPECT_EQ(after->scene_digest, before.scene_digest);
  ASSERT_EQ(after->frames.size(), 1u);
  EXPECT_EQ(after->frames.at(2).file, "hill.0002.png");
  EXPECT_EQ(after->frames.at(2).frame_key, before.frames.at(2).frame_key);
  EXPECT_EQ(after->frames.at(2).triangles_made, 12345678901u);
}

TEST(ManifestTest, RefusesWhatIsNone) {
  for (const char* bytes : {"", "{", "[]", "{}", "{\"form\":\"fjord-manifest 1\"}",
                            "{\"form\":\"fjord-manifest 1\",\"frames\":[{\"frame\":1}]}",
                            "{\"form\":\"fjord-manifest 1\",\"frames\":[3]}"}) {
    EXPECT_FALSE(ParseManifest(bytes, "m").ok()) << bytes;
  }
}

// A manifest from elsewhere must not make a command read outside its folder.
TEST(ManifestTest, RefusesFilesOutsideTheFolder) {
  std::string text = ManifestText(Example());
  text.replace(text.find("hill.0002.png"), 13, "../secret.png");
  EXPECT_FALSE(ParseManifest(text, "m").ok());
}

}  // namespace
}  // namespace fjord
