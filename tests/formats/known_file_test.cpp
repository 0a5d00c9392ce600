// What is no scene, or no shape, is told by its content.
#include "engine/formats/known_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/formats/shape_file.h"
#include "tests/formats/expect_error.h"

namespace fjord {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using namespace std::string_literals;

std::string BinaryStl() {
  std::string bytes(80, ' ');
  bytes.replace(0, 5, "solid");  // as some programs begin it
  bytes += "\x02\0\0\0"s;
  return bytes + std::string(100, '\0');
}

struct Sample {
  const char* what;
  std::string bytes;
  const char* remedy;  // as a scene
};

const std::vector<Sample>& Foreign() {
  static const auto* const kSamples = new std::vector<Sample>{
      {"an STL mesh", "solid a\n facet normal 0 0 1\n  outer loop\n", "save it as .obj"},
      {"an STL mesh", BinaryStl(), "save it as .obj"},
      {"GeoJSON", "{\"features\": [], \"type\" : \"FeatureCollection\"}", "outlines"},
      {"a glTF model", "{\"asset\": {}, \"meshes\": []}", "save it as .obj"},
      {"a glTF model", "glTF\x02\0\0\0"s, "save it as .obj"},
      {"a Houdini geometry", "[\"fileversion\",\"19.5\"]", "save it as .obj"},
      {"JSON", "[1, 2]", "objects and camera"},
      {"JSON", "{\"a\": 1}", "objects and camera"},
      {"a PNG picture", "\x89PNG\r\n\x1a\n\0\0"s, "heights { file"},
      {"an OpenEXR picture", "\x76\x2f\x31\x01\x02\0"s, "heights { file"},
      {"a TIFF picture", "II*\0\x08\0"s, ".png of 16 bits"},
      {"an FBX model", "Kaydara FBX Binary  \0"s, "save it as .obj"},
      {"a Blender file", "BLENDER-v300", "save it as .obj"},
      {"a USD scene", "#usda 1.0\n(\n)\n", "save it as .obj"},
      {"a DXF drawing", "  0\nSECTION\n  2\nHEADER\n", "outlines"},
      {"a KML map", "<?xml version='1.0'?>\n<kml xmlns='k'/>", "outlines"},
      {"a zip archive", "PK\x03\x04\x14\0"s, "objects and camera"},
  };
  return *kSamples;
}

TEST(KnownFileTest, ForeignFilesAreNamedWithTheWayOut) {
  for (const Sample& sample : Foreign()) {
    const std::string scene = WhyNotScene(sample.bytes, "a.b");
    EXPECT_THAT(scene, AllOf(HasSubstr("this is "s + sample.what + ", not a scene"),
                             HasSubstr(sample.remedy)));
    ExpectError(ReadShape(sample.bytes, "a.obj"), "a.obj",
                "this is "s + sample.what + ", not a shape");
  }
}

TEST(KnownFileTest, ShapesGivenAsScenesAreToBeImported) {
  for (const auto& [what, bytes] : std::vector<std::pair<const char*, const char*>>{
           {"a .std shape", "Taiwan, by hand\n\ndata 3 1\n0 0 0\n"},
           {"a Wavefront .obj shape", "# Blender\nmtllib a.mtl\no Plane\nv 0 0 0\n"},
           {"a Wavefront .obj shape", "v 0 0 0\n"},
           {"a .ply shape", "ply\r\nformat ascii 1.0\r\n"},
           {"an .svg drawing", "<?xml version='1.0'?><svg/>"}}) {
    EXPECT_EQ(WhyNotScene(bytes, "x/a.txt"),
              "this is "s + what +
                  ", not a scene; `fjord import x/a.txt -o NAME.scene` makes a first scene of it");
    EXPECT_EQ(WhyNotShape(bytes), "");
  }
}

TEST(KnownFileTest, ScenesAreScenes) {
  for (const char* scene :
       {"# v 1 2 3\nname: \"x\"\nobjects { }\n", "objects{shape{}}", "{ \"objects\": [] }",
        "output { frames: 3 }\nobjekts {}\n", "camera: { }"}) {
    EXPECT_EQ(WhyNotScene(scene, "a"), "") << scene;
    EXPECT_THAT(WhyNotShape(scene), HasSubstr("a scene of Fjord")) << scene;
  }
  for (const char* nothing : {"", " \n", "just some words\n", "\x01\x02\x03\x04", "name: 3"}) {
    EXPECT_EQ(WhyNotScene(nothing, "a"), "") << nothing;
    EXPECT_EQ(WhyNotShape(nothing), "") << nothing;
  }
}

}  // namespace
}  // namespace fjord
