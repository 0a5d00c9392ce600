#include "engine/scene/load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "engine/base/digest.h"
#include "engine/scene/limits.h"
#include "tests/scene/entry_values.h"
#include "tests/scene/load_text.h"

namespace fjord {
namespace {

using testing::ErrorsOf;
using ::testing::HasSubstr;
using testing::Load;
using ::testing::StartsWith;

const std::string kBall = "objects { name: \"ball\" shape { primitive { kind: SPHERE } } }\n";
const std::string kTriangle =
    "shape { mesh { point { x: 0 } point { x: 1 } point { y: 1 } face { v: 1 v: 2 v: 3 } } }\n";

TEST(LoadTest, AWholeSceneLoads) {
  const LoadResult result = Load(kBall);
  EXPECT_TRUE(result.ok()) << ErrorsOf(result);
  EXPECT_EQ(result.loaded.scene.name(), "s");
  EXPECT_EQ(result.loaded.scene.objects(0).name(), "ball");
}

TEST(LoadTest, SyntaxErrorsHaveLineAndColumn) {
  EXPECT_EQ(ErrorsOf("objects {\n  name: ball\n}"),
            "s.scene:2:3: error: name wants a text in quotes, not ball\n");
  EXPECT_THAT(ErrorsOf("objects { shape {"), StartsWith("s.scene:1:18: error: "));
  EXPECT_EQ(ErrorsOf("name: \"a\"\nname: \"b\""),
            "s.scene:2:1: error: field name is given twice\n");
}

TEST(LoadTest, UnknownFieldsAreAllReportedWithTheNearest) {
  EXPECT_EQ(ErrorsOf("objetcs {}\nobjects {\n\tfractal { sigam: 1 } }"),
            "s.scene:1:1: error: Scene has no field \"objetcs\"; did you mean objects?\n"
            "s.scene:3:19: error: Fractal has no field \"sigam\"; did you mean sigma?\n");
  EXPECT_EQ(ErrorsOf("objects { shape { primitive { kind: SPHER } } }"),
            "s.scene:1:31: error: kind cannot be SPHER; did you mean SPHERE?\n");
}

TEST(LoadTest, BadNumbersAreAllReportedAtTheirPlaces) {
  EXPECT_EQ(ErrorsOf("camera { eye { x: nan y: inf z: 1e308 }\n fov: 180 near: -1 }\n"
                     "output { width: 0 height: 16385 frames: 0 }\n" +
                     kBall),
            "s.scene:1:16: error: camera.eye.x: not a finite number\n"
            "s.scene:1:23: error: camera.eye.y: not a finite number\n"
            "s.scene:1:30: error: camera.eye.z: 1e+308 cannot be meant; numbers are at most 1e+12\n"
            "s.scene:2:2: error: camera.fov: 180 is out of range: 1 to 170\n"
            "s.scene:2:11: error: camera.near: -1 is out of range: above 0\n"
            "s.scene:3:10: error: output.width: 0 is out of range: 1 to 16384\n"
            "s.scene:3:19: error: output.height: 16385 is out of range: 1 to 16384\n"
            "s.scene:3:33: error: output.frames: 0 is out of range: 1 to 1000000\n");
}

TEST(LoadTest, FractalKnobsOutOfRangeOrUnknownToTheMethod) {
  EXPECT_EQ(ErrorsOf("objects { name: \"a\" " + kTriangle +
                     " fractal { H: 1.2 max_level: 1000 epsilon: 0 } }"),
            "s.scene:2:12: error: objects[a].fractal.H: 1.2; coast takes 0 to 1\n"
            "s.scene:2:19: error: objects[a].fractal.max_level: 1000 is out of range: 0 to 40\n"
            "s.scene:2:35: error: objects[a].fractal.epsilon: 0 is out of range: above 0\n");
  EXPECT_EQ(
      ErrorsOf("objects { name: \"a\" " + kTriangle + " fractal { H: 1.2 max_level: 1000 } }"),
      "s.scene:2:12: error: objects[a].fractal.H: 1.2; coast takes 0 to 1\n"
      "s.scene:2:19: error: objects[a].fractal.max_level: 1000 is out of range: 0 to 40\n");
  EXPECT_EQ(
      ErrorsOf("objects { name: \"a\" " + kTriangle + " fractal { coast_H: .5 } }"),
      "s.scene:2:12: error: objects[a].fractal.coast_H: method coast has no such knob; it has "
      "H, sigma, amplitude, law, direction, variant, uniforms, move, perturb, stretch\n");
  EXPECT_EQ(ErrorsOf("objects { name: \"a\" " + kTriangle + " fractal { method: \"curv\" } }"),
            "s.scene:2:12: error: objects[a].fractal.method: there is no method \"curv\"; did you "
            "mean curve?\n");
  EXPECT_EQ(ErrorsOf("objects { name: \"a\" " + kTriangle + " fractal { method: \"curve\" } }"),
            "s.scene:2:12: error: objects[a].fractal.method: method curve works on curves, and the "
            "shape is a mesh\n");
  EXPECT_EQ(ErrorsOf("objects { name: \"a\" " + kTriangle + " fractal { pixels: 1 viewing: 2 } }"),
            "s.scene:2:2: error: objects[a].fractal: give one of epsilon, pixels and viewing, not "
            "several\n");
}

TEST(LoadTest, S25_KeysMustAscendAndCorrespond) {
  const auto key = [](int frame, const std::string& points) {
    return "  key { frame: " + std::to_string(frame) + " shape { polyline { " + points + " } } }\n";
  };
  const std::string two = "point {} point { x: 1 }", three = two + " point { x: 2 }";
  EXPECT_EQ(ErrorsOf("objects { name: \"a\"\n" + key(5, two) + key(5, two) + key(4, two) + "}"),
            "s.scene:3:9: error: objects[a].key[2].frame: two keys at frame 5\n"
            "s.scene:4:9: error: objects[a].key[3].frame: frame 4 comes after frame 5; keys "
            "ascend\n");
  EXPECT_EQ(
      ErrorsOf("objects { name: \"a\"\n" + key(1, two) + key(2, three) + "}"),
      "s.scene:3:18: error: objects[a].key[2].shape: key 1 (frame 1) and key 2 (frame 2) have "
      "2 and 3 points; say correspondence: COMPUTED or BY_PAIRS\n");
  EXPECT_EQ(ErrorsOf("objects { name: \"a\"\n" + key(1, two) + key(2, two) + "rest_frame: 3 }"),
            "s.scene:4:1: error: objects[a].rest_frame: there is no key at frame 3\n");
  EXPECT_EQ(
      ErrorsOf("objects { name: \"a\"\n" + key(1, two) + "  key { frame: 2 shape { polyline { " +
               two +
               " } } pair { from: 1 to: 3 } pair "
               "{ from: 0 to: 1 } }\n  correspondence: BY_PAIRS }"),
      "s.scene:3:80: error: objects[a].key[2].pair[1].to: there is no vertex 3; key 2 (frame "
      "2) has vertices 1 to 2\n"
      "s.scene:3:95: error: objects[a].key[2].pair[2].from: there is no vertex 0; key 1 (frame "
      "1) has vertices 1 to 2\n");
}

TEST(LoadTest, DefectsOfAllKindsComeInOneRun) {
  EXPECT_EQ(
      ErrorsOf(
          "output { width: 0 samples: 3 }\n"
          "camera { eye { x: nan } look_at { x: 1 } up {} }\n"
          "lights { direction { x: nan } }\n"
          "objects { name: \"a\" shape { file { path: \"none.std\" } }\n"
          "  fractal { epsilon: -1 max_level: 1000 H: 7 } }\n"
          "objects { name: \"a\"\n"
          "  key { frame: 2000000 shape { primitive { kind: TORUS tube: -1 } } }\n"
          "  key { frame: 5 shape { primitive { kind: SPHERE segments: 2 } } }\n"
          "  key { frame: 4 } }\n"
          "objects { name: \"c\"\n"
          "  shape { mesh { point { x: inf } point {} face { v: 0 v: 1 }\n"
          "    face { v: 1 v: 2 v: 3 } } }\n"
          "  material { ramp { height: nan } ramp { height: -5 } ramp { height: -6 } } }\n"
          "track { path: \"camera.fov\" key { frame: inf value: 0 } key { frame: 1 value: 1 } }\n",
          {{"camera.fov", "900"}, {"nonsense", "1"}}),
      "--set camera.fov=900: error: camera.fov: 900 is out of range: 1 to 170\n"
      "--set nonsense=1: error: a scene has no field \"nonsense\"; there are name, output, camera, "
      "background, ambient, lights, sea, objects, track, haze\n"
      "s.scene:1:10: error: output.width: 0 is out of range: 1 to 16384\n"
      "s.scene:1:19: error: output.samples: 3 is not 1, 4 or 16\n"
      "s.scene:2:16: error: camera.eye.x: not a finite number\n"
      "s.scene:2:42: error: camera.up: up has no direction\n"
      "s.scene:3:22: error: lights[light-1].direction.x: not a finite number\n"
      "s.scene:4:36: error: objects[a].shape.file.path: there is no file none.std\n"
      "s.scene:5:13: error: objects[a].fractal.epsilon: -1 is out of range: above 0\n"
      "s.scene:5:25: error: objects[a].fractal.max_level: 1000 is out of range: 0 to 40\n"
      "s.scene:5:41: error: objects[a].fractal.H: 7; surface takes 0 to 1\n"
      "s.scene:6:11: error: objects[a].name: object 1 is named \"a\" too\n"
      "s.scene:7:9: error: objects[a].key[1].frame: 2000000 is out of range: 1 to 1000000\n"
      "s.scene:7:56: error: objects[a].key[1].shape.primitive.tube: -1 is out of range: above 0\n"
      "s.scene:8:18: error: objects[a].key[2].shape: segments must be at least 3, not 2\n"
      "s.scene:9:3: error: objects[a].key[3].shape: the shape is empty; give it mesh, polyline, "
      "primitive, file or heights\n"
      "s.scene:9:9: error: objects[a].key[3].frame: frame 4 comes after frame 5; keys ascend\n"
      "s.scene:11:26: error: objects[c].shape.mesh.point[1].x: not a finite number\n"
      "s.scene:11:44: error: objects[c].shape.mesh.face[1]: 2 corners; a face needs three or more\n"
      "s.scene:11:51: error: objects[c].shape.mesh.face[1].v[1]: there is no vertex 0; the mesh "
      "has vertices 1 to 2\n"
      "s.scene:12:22: error: objects[c].shape.mesh.face[2].v[3]: there is no vertex 3; the mesh "
      "has vertices 1 to 2\n"
      "s.scene:13:21: error: objects[c].material.ramp[1].height: not a finite number\n"
      "s.scene:13:62: error: objects[c].material.ramp[3].height: -6 comes after -5; heights "
      "ascend\n"
      "s.scene:14:34: error: track[1].key[1].frame: not a finite number\n"
      "s.scene:14:45: error: track[1].key[1].value[1]: 0 is out of range: 1 to 170\n");
}

TEST(LoadTest, AValueIsRefusedOnce) {
  // what follows from it is no defect of its own: no order, no direction, no view of a bad number
  EXPECT_EQ(ErrorsOf("camera { eye {} look_at { x: nan } up { z: inf } }\n" + kBall),
            "s.scene:1:27: error: camera.look_at.x: not a finite number\n"
            "s.scene:1:41: error: camera.up.z: not a finite number\n");
  EXPECT_EQ(ErrorsOf("name: \"a\\001\"\n" + kBall),
            "s.scene:1:1: error: name: the text is not printable UTF-8\n");
}

TEST(LoadTest, S25_KeysOfAMeshJoinTheSameVertices) {
  const auto meshes = [](const std::string& second, const std::string& more) {
    const std::string square = "point {} point { x: 1 } point { x: 1 y: 1 } point { y: 1 } ";
    return ErrorsOf("objects { name: \"m\"\nkey { frame: 1 shape { mesh { " + square +
                    "face { v: [1,2,3] } face { v: [1,3,4] } } } }\n" +
                    "key { frame: 2 shape { mesh { " + square + second + " } }" +
                    (more.empty() ? " }" : more) + " }");
  };
  const std::string start =
      "s.scene:3:16: error: objects[m].key[2].shape: other faces than key 1 (frame 1): it ";
  const std::string remedy =
      " (vertices as numbered there); move the vertices and leave the faces, or say by pairs which "
      "vertex becomes which (correspondence: BY_PAIRS)\n";
  EXPECT_EQ(
      meshes("face { v: [1,2,4] } face { v: [2,3,4] }", ""),
      start + "lacks the face 1 2 3 and has the face 1 2 4, and 2 faces more differ" + remedy);
  EXPECT_EQ(meshes("face { v: [1,2,3] }", ""), start + "lacks the face 1 3 4" + remedy);
  EXPECT_EQ(meshes("face { v: [3,1,2] } face { v: [1,3,4] } face { v: [4,3,1] }", ""),
            start + "has the face 1 4 3" + remedy);
  EXPECT_EQ(meshes("face { v: [4,1,3] } face { v: [2,3,1] }", ""), "");
  const std::string turned =
      " pair { from: 1 to: 2 } pair { from: 2 to: 3 } pair { from: 3 to: 4 } pair { from: 4 to: 1 }"
      " }\ncorrespondence: BY_PAIRS";
  EXPECT_EQ(meshes("face { v: [2,3,4] } face { v: [2,4,1] }", turned), "");
}

TEST(LoadTest, S25_MeshPairsCoverEveryVertex) {
  EXPECT_EQ(
      ErrorsOf("objects { name: \"a\"\nkey { frame: 1 " + kTriangle + " }\nkey { frame: 2 " +
               kTriangle +
               " pair { from: 1 to: 2 } pair { from: 3 to: 1 } }\n"
               "correspondence: BY_PAIRS }"),
      "s.scene:4:1: error: objects[a].key[2]: vertex 2 of key 1 (frame 1) has no pair; meshes "
      "need a pair for every vertex\n");
}

TEST(LoadTest, S25_PathsNeedWhatTheirKindNeeds) {
  const std::string keys =
      "key { frame: 1 " + kTriangle + " }\nkey { frame: 9 " + kTriangle + " }\n";
  EXPECT_EQ(ErrorsOf("objects { name: \"a\"\n" + keys + "path { kind: SPLINE } }"),
            "s.scene:6:8: error: objects[a].path.kind: SPLINE needs three keys or more; there are "
            "2\n");
  EXPECT_EQ(
      ErrorsOf("objects { name: \"a\"\n" + keys + "path { kind: STEER } }"),
      "s.scene:6:1: error: objects[a].path: kind STEER needs control points; add control { x: "
      "0 y: 0 z: 1 }\n");
  EXPECT_EQ(ErrorsOf("objects { name: \"a\"\n" + keys + "point_path { vertex: 4 } }"),
            "s.scene:6:14: error: objects[a].point_path[1].vertex: there is no vertex 4; key 1 has "
            "vertices 1 to 3\n");
}

TEST(LoadTest, ShapesAreChecked) {
  EXPECT_EQ(
      ErrorsOf("objects { name: \"a\" }"),
      "s.scene:1:1: error: objects[a]: the object has no shape; add shape { ... } or key { ... "
      "}\n");
  EXPECT_EQ(
      ErrorsOf("objects { name: \"a\" shape { mesh { point {} face { v: 1 v: 0 v: 1 } } } }"),
      "s.scene:1:57: error: objects[a].shape.mesh.face[1].v[2]: there is no vertex 0; the mesh "
      "has vertices 1 to 1\n");
  EXPECT_EQ(
      ErrorsOf("objects { name: \"a\" shape { mesh { point {}\n face { v: 2 v: 1 v: 1 }\n"
               " face { v: [1, 4294967295] } } } }"),
      "s.scene:2:9: error: objects[a].shape.mesh.face[1].v[1]: there is no vertex 2; the mesh "
      "has vertices 1 to 1\n"
      "s.scene:3:2: error: objects[a].shape.mesh.face[2]: 2 corners; a face needs three or more\n"
      "s.scene:3:16: error: objects[a].shape.mesh.face[2].v[2]: there is no vertex 4294967295; "
      "the mesh has vertices 1 to 1\n");
  EXPECT_EQ(
      ErrorsOf("objects { name: \"a\" shape { polyline { closed: true point {} point {} } } }"),
      "s.scene:1:21: error: objects[a].shape: a closed polyline needs 3 points or more; this "
      "has 2\n");
}

TEST(LoadTest, NamesAreUniqueAndPlain) {
  EXPECT_EQ(
      ErrorsOf(kBall + kBall + "objects { name: \"a b\" " + kTriangle + "}"),
      "s.scene:2:11: error: objects[ball].name: object 1 is named \"ball\" too\n"
      "s.scene:3:11: error: objects[3].name: \"a b\" cannot be a name: letters, digits, - and "
      "_, at most 200, not digits alone\n");
}

TEST(LoadTest, W2_TracksMustLeadToNumbers) {
  const auto track = [](const std::string& path, const std::string& keys) {
    return ErrorsOf(kBall + "track { path: \"" + path + "\" " + keys + " }");
  };
  EXPECT_EQ(track("objects[bal].transform.translate.z", "key { frame: 1 value: 1 }"),
            "s.scene:2:9: error: track[1].path: objects has no entry named \"bal\"; did you mean "
            "ball?\n");
  EXPECT_EQ(
      track("output.width", "key { frame: 1 value: 1 }"),
      "s.scene:2:9: error: track[1].path: output.width cannot have a track: it belongs to the "
      "whole shot\n");
  EXPECT_THAT(track("objects[ball].fractal.seed", "key { frame: 1 value: 1 }"),
              HasSubstr("seed shapes the whole shot"));
  EXPECT_THAT(track("objects[ball].fractal.max_level", "key { frame: 1 value: 1 }"),
              HasSubstr("max_level shapes the whole shot"));
  EXPECT_THAT(track("objects[ball].fractal.uniforms", "key { frame: 1 value: 1 }"),
              HasSubstr("uniforms shapes the whole shot"));
  EXPECT_THAT(track("objects[ball].rest_frame", "key { frame: 1 value: 1 }"),
              HasSubstr("rest_frame decides which points there are"));
  EXPECT_THAT(track("objects[ball].fractal.H", "key { frame: 1 value: 1 }"),
              HasSubstr("the object has no fractal; add fractal {}"));
  EXPECT_THAT(track("sea.level", "key { frame: 1 value: 1 }"), HasSubstr("the scene has no sea"));
  EXPECT_THAT(track("camera", "key { frame: 1 value: 1 }"),
              HasSubstr("go on to one of its fields"));
  EXPECT_EQ(track("camera.fov", "key { frame: 2 value: 30 } key { frame: 2 value: 400 }"),
            "s.scene:2:61: error: track[1].key[2].frame: frame 2 comes after frame 2; keys ascend, "
            "one at a frame\n"
            "s.scene:2:70: error: track[1].key[2].value[1]: 400 is out of range: 1 to 170\n");
  EXPECT_THAT(track("camera.eye", "key { frame: 1 value: 1 }"),
              HasSubstr("camera.eye has 3 numbers; this key gives 1"));
  EXPECT_THAT(track("camera.fov", ""), HasSubstr("the track has no keys"));
  EXPECT_THAT(ErrorsOf(kBall + "track { path: \"camera.eye\" key { frame: 1 value: [1,2,3] } }\n"
                               "track { path: \"camera.eye.x\" key { frame: 1 value: 1 } }"),
              HasSubstr("s.scene:3:9: error: track[2].path: camera.eye.x and camera.eye are tracks "
                        "of the same number"));
}

TEST(LoadTest, SettingsCountAsWritten) {
  const LoadResult result = Load(kBall, {{"objects[ball].shape.primitive.radius", "3"},
                                         {"lights[sun].intensity", "2"},
                                         {"output.format", "EXR_HALF"}});
  ASSERT_TRUE(result.ok()) << ErrorsOf(result);
  EXPECT_EQ(result.loaded.scene.objects(0).shape().primitive().radius(), 3);
  EXPECT_EQ(result.loaded.scene.lights(0).intensity(), 2);
  EXPECT_EQ(ErrorsOf(kBall, {{"objects[ball].shape.primitive.radius", "-3"}, {"camera.fov", "x"}}),
            "--set camera.fov=x: error: \"x\" is not a number\n"
            "--set objects[ball].shape.primitive.radius=-3: error: "
            "objects[ball].shape.primitive.radius: -3 is out of range: above 0\n");
  EXPECT_EQ(ErrorsOf(kBall, {{"camera.eye", "1 2"}}),
            "--set camera.eye=1 2: error: \"1 2\" is not three numbers, as in \"0 -5 2\"\n");
  EXPECT_EQ(ErrorsOf(kBall, {{"camera.fow", "3"}}),
            "--set camera.fow=3: error: camera has no field \"fow\"; did you mean fov?\n");
}

TEST(LoadTest, JsonIsTheSameScene) {
  const LoadResult text = Load("camera { fov: 20 }\n" + kBall);
  const LoadResult json = Load(
      "{ \"camera\": { \"fov\": 20 }, \"objects\": [ { \"name\": \"ball\", \"shape\": { "
      "\"primitive\": { \"kind\": \"SPHERE\" } } } ] }");
  ASSERT_TRUE(text.ok() && json.ok()) << ErrorsOf(json);
  EXPECT_EQ(SerializeScene(text.loaded.scene), SerializeScene(json.loaded.scene));
}

// Every defect that can be found, each with its line and column.
TEST(LoadTest, JsonErrorsAreAllReportedWithTheirPlaces) {
  EXPECT_EQ(ErrorsOf("{ \"objects\": [ { \"nam\": 3 } ] }"),
            "s.scene:1:18: error: Object has no field \"nam\"; did you mean name?\n");
  EXPECT_EQ(ErrorsOf("{ \"output\": { \"widht\": 3, \"height\": \"tall\", \"format\": \"PNG9\" },\n"
                     "  \"camera\": 3, \"camera\": {},\n"
                     "  \"objects\": [ { \"shape\": { \"primitive\": { \"kind\": \"SPHERE\" } },\n"
                     "    \"fractal\": { \"sigam\": 1, \"H\": true, \"law\": \"AFINE\",\n"
                     "      \"stretch\": 1, \"uniforms\": -4 },\n"
                     "    \"material\": { \"color\": [1, 2] } } ] }"),
            "s.scene:1:15: error: Output has no field \"widht\"; did you mean width?\n"
            "s.scene:1:27: error: height wants a whole number from 0 to 4294967295, not \"tall\"\n"
            "s.scene:1:45: error: format cannot be PNG9; did you mean PNG8?\n"
            "s.scene:2:3: error: camera wants a group: camera { ... }, not 3\n"
            "s.scene:2:16: error: field camera is given twice\n"
            "s.scene:4:18: error: Fractal has no field \"sigam\"; did you mean sigma?\n"
            "s.scene:4:30: error: H wants a number, not true\n"
            "s.scene:4:41: error: law cannot be \"AFINE\"; did you mean AFFINE?\n"
            "s.scene:5:7: error: stretch wants true or false, not 1\n"
            "s.scene:5:21: error: uniforms wants a whole number from 0, not -4\n"
            "s.scene:6:28: error: color has 3 numbers; this gives 2\n");
  EXPECT_EQ(
      ErrorsOf("{ \"objects\": [ { \"name\": \"b\", \"shape\": { \"primitive\": { \"radius\": "
               "\"NaN\" } } } ] }"),
      "s.scene:1:57: error: objects[b].shape.primitive.radius: not a finite number\n");
  EXPECT_THAT(ErrorsOf("{ \"objects\": [ "), StartsWith("s.scene:1:16: error: JSON: "));
}

TEST(LoadTest, S23_BallsAreEvenWhereNobodySaysOtherwise) {
  const auto base = [](const std::string& words) {
    const LoadResult result = Load("objects { shape { primitive { " + words + " } } }");
    EXPECT_TRUE(result.ok()) << ErrorsOf(result);
    return result.loaded.scene.objects(0).shape().primitive().base();
  };
  EXPECT_EQ(base("kind: SPHERE"), v1::Primitive::EVEN);
  EXPECT_EQ(base("kind: ELLIPSOID"), v1::Primitive::EVEN);
  EXPECT_EQ(base("kind: SPHERE base: LATITUDE"), v1::Primitive::LATITUDE);
  EXPECT_EQ(base("kind: SPHERE segments: 24"), v1::Primitive::LATITUDE);
  EXPECT_EQ(base("kind: ELLIPSOID rings: 12"), v1::Primitive::LATITUDE);
  EXPECT_EQ(base("kind: SPHERE rings: 12 base: EVEN"), v1::Primitive::EVEN);
  EXPECT_EQ(
      ErrorsOf("objects { shape { primitive { kind: TORUS base: EVEN } } }"),
      "s.scene:1:43: error: objects[object-1].shape.primitive.base: TORUS has no base; SPHERE "
      "and ELLIPSOID have\n");
}

TEST(LoadTest, WhatIsForShapesIsRefusedOfPictures) {
  for (const char* words : {"spacing: 1", "up: Y", "outline: true", "curve: 1"}) {
    const std::string field(words, std::string(words).find(':'));
    EXPECT_THAT(ErrorsOf("objects { shape { heights { file { path: \"a.png\" " +
                         std::string(words) + " } } } }"),
                HasSubstr("heights.file." + field + ": a picture of heights has no " + field));
  }
  EXPECT_THAT(
      ErrorsOf("objects { name: \"a\" shape { file { path: \"a.obj\" spacing: 1 } } }\n"
               "track { path: \"objects[a].shape.file.spacing\" key { frame: 1 value: 2 } }",
               {}, {{"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"}}),
      HasSubstr("it decides which points there are"));
}

TEST(LoadTest, GeoJsonIsNamed) {
  EXPECT_EQ(
      ErrorsOf("{ \"features\": [ { \"type\": \"Feature\" } ],\n"
               "  \"type\": \"FeatureCollection\" }"),
      "s.scene:2:11: error: this is GeoJSON (\"type\": \"FeatureCollection\"), not a scene. A "
      "scene has fields such as objects and camera; shapes are read from the .std, .obj, "
      ".ply and .svg files that it names: \"shape\": {\"file\": {\"path\": \"a.svg\"}}\n");
}

// Several defects of the text itself in one run; a wrong value does not hide the rest.
TEST(LoadTest, TextErrorsAreAllReported) {
  EXPECT_EQ(ErrorsOf("camera { fov: wide eye: [1, 2] eye { x: 1 } }\n"
                     "objects { fractal { law: AFINE H: high stretch: 1 uniforms: 2.5 } }\n"
                     "objects { shape { primitive {} mesh {} } fractal { H { x: 1 } H: .5 } }\n"),
            "s.scene:1:10: error: fov wants a number, not wide\n"
            "s.scene:1:25: error: eye has 3 numbers; this gives 2\n"
            "s.scene:1:32: error: field eye is given twice\n"
            "s.scene:2:21: error: law cannot be AFINE; did you mean AFFINE?\n"
            "s.scene:2:32: error: H wants a number, not high\n"
            "s.scene:2:40: error: stretch wants true or false, not 1\n"
            "s.scene:2:51: error: uniforms wants a whole number from 0, not 2.5\n"
            "s.scene:3:32: error: give primitive or mesh, not both\n"
            "s.scene:3:52: error: H wants a number, not a group { }\n"
            "s.scene:3:63: error: field H is given twice\n");
}

TEST(LoadTest, VectorsAndColoursMayBeLists) {
  const LoadResult groups = Load("camera { eye { x: 1 y: -2 z: 3 } }\n" + kBall);
  const LoadResult lists = Load("camera { eye: [1, -2, 3] }\n" + kBall);
  ASSERT_TRUE(lists.ok()) << ErrorsOf(lists);
  EXPECT_EQ(SerializeScene(lists.loaded.scene), SerializeScene(groups.loaded.scene));
}

// A knob that changes nothing beside the others is refused, not carried into the key.
TEST(LoadTest, KnobsWithoutEffectAreRefused) {
  const auto errors = [](const std::string& fractal, const std::string& more = "") {
    return ErrorsOf("objects { name: \"a\" " + kTriangle + "fractal { " + fractal + " } }\n" +
                    more);
  };
  EXPECT_EQ(errors("move: .3"),
            "s.scene:2:11: error: objects[a].fractal.move: has no effect here; it works with law "
            "SHIH\n");
  EXPECT_EQ(errors("variant: FIXED perturb: .3"),
            "s.scene:2:26: error: objects[a].fractal.perturb: has no effect here; it works with "
            "variant PERTURBED\n");
  EXPECT_EQ(errors("amplitude: .3"),
            "s.scene:2:11: error: objects[a].fractal.amplitude: has no effect here; it works with "
            "law AFFINE\n");
  EXPECT_EQ(errors("law: AFFINE amplitude: .3"), "");
  EXPECT_EQ(errors("move: .4"), "");  // its default
  EXPECT_EQ(errors("", "track { path: \"objects[a].fractal.move\" key { frame: 1 value: 1 } }"),
            "s.scene:3:9: error: track[1].path: objects[a].fractal.move has no effect here; it "
            "works with law SHIH\n");
  EXPECT_EQ(errors("", "track { path: \"objects[a].fractal.H\" key { frame: 1 value: .01 } }"),
            "s.scene:3:53: error: track[1].key[1].value[1]: 0.01; law SIMILAR takes 0.06 to 1\n");
}

TEST(LoadTest, WhatIsNoSceneSaysSo) {
  EXPECT_EQ(ErrorsOf(""), "s.scene: error: the scene is empty; give it at least one object\n");
  EXPECT_EQ(ErrorsOf("# only a comment\n"),
            "s.scene: error: the scene has no objects; add objects { shape { ... } }\n");
  EXPECT_EQ(ErrorsOf(std::string("a\0b", 3)),
            "s.scene: error: not a scene in text form: byte 2 is 0\n");
  std::string deep;
  for (int i = 0; i < 10000; ++i) deep += "objects { ";
  EXPECT_THAT(ErrorsOf(deep), HasSubstr("error"));
  std::string deep_json = "{";
  for (int i = 0; i < 10000; ++i) deep_json += "\"objects\":[{";
  EXPECT_THAT(ErrorsOf(deep_json), HasSubstr("too deep"));
}

TEST(LoadTest, LimitsAreNamed) {
  std::string objects;
  for (int i = 0; i <= limits::kObjects; ++i) objects += "objects {}\n";
  EXPECT_EQ(ErrorsOf(objects), "s.scene: error: objects: 10001 objects; at most 10000\n");
  std::string tracks = kBall;
  for (int i = 0; i <= limits::kTracks; ++i) tracks += "track {}\n";
  EXPECT_THAT(ErrorsOf(tracks), HasSubstr("10001 tracks; at most 10000"));
  EXPECT_THAT(ErrorsOf(kBall, {{"objects[ball].shape.primitive.segments", "16000000"},
                               {"objects[ball].shape.primitive.rings", "16000000"}}),
              HasSubstr("at most 16000000"));
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "lights { intensity: -1 }\n";
  const LoadResult result = Load(many + kBall);
  EXPECT_EQ(result.errors.size(), static_cast<size_t>(limits::kErrors) + 1);
  EXPECT_EQ(result.errors.back().message, "there are more errors");
}

constexpr char kStd[] = "free text\ndata 3 1\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3\n";

TEST(LoadTest, FilesAreReadOnceAndNamedByDigest) {
  const LoadResult result = Load(
      "objects { shape { file { path: \"a.std\" } } }\n"
      "objects { shape { file { path: \"a.std\" outline: true } } }",
      {}, {{"a.std", kStd}});
  ASSERT_TRUE(result.ok()) << ErrorsOf(result);
  const std::string digest = Sha256Of(kStd).Hex();
  EXPECT_EQ(result.loaded.scene.objects(0).shape().file().digest(), digest);
  EXPECT_EQ(result.loaded.scene.objects(1).shape().file().digest(), digest);
  EXPECT_EQ(result.loaded.assets.size(), 1u);
  EXPECT_EQ(result.loaded.assets.at(digest), kStd);
}

TEST(LoadTest, FilesThatAreMissingBrokenOrOthers) {
  EXPECT_EQ(ErrorsOf("objects { name: \"a\" shape { file { path: \"b.std\" } } }"),
            "s.scene:1:36: error: objects[a].shape.file.path: there is no file b.std\n");
  const std::string broken = ErrorsOf("objects { shape { file { path: \"a.std\" } } }", {},
                                      {{"a.std", "data 3 1\n0 0 0\n"}});
  EXPECT_THAT(broken, StartsWith("a.std:"));
  EXPECT_THAT(
      ErrorsOf("objects { name: \"a\" shape { file { path: \"a.std\" digest: \"" +
                   std::string(64, '0') + "\" } } }",
               {}, {{"a.std", kStd}}),
      StartsWith("s.scene:1:50: error: objects[a].shape.file.digest: the file has digest "));
  EXPECT_THAT(ErrorsOf("objects { shape { file { path: \"a.std\" digest: \"12\" } } }"),
              HasSubstr("not a digest"));
}

class LoadFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("fjord-load-" + std::to_string(::getpid()) + "-" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_ / "in here");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string Write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  std::filesystem::path folder_;
};

TEST_F(LoadFileTest, FilesAreRelativeToTheScene) {
  Write("in here/a.std", kStd);
  const std::string path =
      Write("in here/my scene.scene", "objects { shape { file { path: \"a.std\" } } }");
  const LoadResult result = LoadSceneFile(path);
  EXPECT_TRUE(result.ok()) << ErrorsOf(result);
  EXPECT_EQ(result.loaded.scene.name(), "my scene");
}

TEST_F(LoadFileTest, UnreadableScenesSayWhy) {
  EXPECT_EQ(LoadSceneFile((folder_ / "none.scene").string()).errors[0].code, ErrorCode::kNotFound);
  EXPECT_THAT(LoadSceneFile(folder_.string()).errors[0].message, HasSubstr("is a folder"));
  const std::string big = Write("big.scene", "");
  std::filesystem::resize_file(big, limits::kSceneBytes + 1);  // sparse
  EXPECT_EQ(LoadSceneFile(big).errors[0].code, ErrorCode::kLimit);
}

TEST(LoadTest, C47_TheWireFormIsTheWholeScene) {
  const LoadResult text =
      Load("objects { shape { file { path: \"a.std\" } } fractal {} }", {}, {{"a.std", kStd}});
  ASSERT_TRUE(text.ok()) << ErrorsOf(text);
  const std::string bytes = SerializeScene(text.loaded.scene);
  const AssetReader by_digest = [](const v1::File& file) -> Result<std::string> {
    EXPECT_EQ(file.digest(), Sha256Of(kStd).Hex());
    return std::string(kStd);
  };
  const LoadResult wire = LoadSceneBinary(bytes, "job", by_digest);
  ASSERT_TRUE(wire.ok()) << ErrorsOf(wire);
  EXPECT_EQ(SerializeScene(wire.loaded.scene), bytes);
}

TEST(LoadTest, TheWireFormIsCheckedInFull) {
  const AssetReader none = [](const v1::File&) -> Result<std::string> { return Invalid("none"); };
  EXPECT_EQ(LoadSceneBinary("\xff\xff\xff", "job", none).errors[0].ToString(),
            "job: error: not a scene in binary form");
  v1::Scene scene;
  testing::SetValue(scene.add_objects()->mutable_fractal(), "H", {.numbers = {3}});
  scene.mutable_objects(0)->mutable_shape()->mutable_primitive();
  EXPECT_THAT(ErrorsOf(LoadSceneBinary(scene.SerializeAsString(), "job", none)),
              HasSubstr("job: error: objects[object-1].fractal.H: 3; surface takes 0 to 1"));
  scene.mutable_output()->set_format(static_cast<v1::Output::Format>(77));
  EXPECT_THAT(ErrorsOf(LoadSceneBinary(scene.SerializeAsString(), "job", none)),
              HasSubstr("output.format: there is no choice number 77"));
  v1::Scene later;
  later.GetReflection()->MutableUnknownFields(&later)->AddVarint(99, 1);
  EXPECT_THAT(ErrorsOf(LoadSceneBinary(later.SerializeAsString(), "job", none)),
              HasSubstr("made by a newer Fjord"));
}

LoadResult LoadFile(const std::string& file, const std::string& bytes,
                    const std::string& more = "") {
  return LoadSceneText("objects {\n  shape { file { path: \"" + file + "\" " + more + " } } }\n",
                       "a.scene", [&](const v1::File&) { return Result<std::string>(bytes); });
}

const char* const kThreeCurves =
    "<svg><path d='M0 0L1 1L2 0z'/><path d='M5 5L6 6'/><path d='M7 7L9 9L8 8'/></svg>";

TEST(LoadTest, WhatOfAFileIsLeftOutIsSaid) {
  const LoadResult first = LoadFile("a.svg", kThreeCurves);
  ASSERT_TRUE(first.ok());
  ASSERT_EQ(first.notes.size(), 1u);
  EXPECT_THAT(first.notes[0], HasSubstr("a.scene:2:11: note: "));
  EXPECT_THAT(first.notes[0], HasSubstr("2 more curves of the file are left out"));
  EXPECT_TRUE(LoadFile("a.svg", kThreeCurves, "curve: 2").notes.empty());
  const LoadResult mixed =
      LoadFile("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 5 5 0\nv 6 6 0\nf 1 2 3\nl 4 5\n");
  ASSERT_EQ(mixed.notes.size(), 1u);
  EXPECT_THAT(mixed.notes[0], HasSubstr("1 curve of the file is left out"));
}

TEST(LoadTest, WhatAFileShowsAndAShapeCannotHoldIsSaidOnceAFile) {
  const std::string object = "objects { shape { file { path: \"a.svg\" } } }\n";
  const LoadResult loaded = LoadSceneText(object + object, "a.scene", [](const v1::File&) {
    return Result<std::string>("<svg>\n<text/><path d='M0 0L1 1'/></svg>");
  });
  ASSERT_TRUE(loaded.ok());
  ASSERT_EQ(loaded.notes.size(), 1u);
  EXPECT_THAT(loaded.notes[0], HasSubstr("a.scene:1:19: note: "));
  EXPECT_THAT(loaded.notes[0], HasSubstr("a.svg:2:1: <text> is passed over"));
}

TEST(LoadTest, ColoursOfVerticesThatAreBytesAreRefused) {
  const auto mesh = [](const std::string& color) {
    return "objects { shape { mesh { point {} point { x: 1 } point { y: 1 }\n"
           "color { r: 1 } color {} color { " +
           color + " } face { v: [1, 2, 3] } } } }";
  };
  EXPECT_EQ(ErrorsOf(mesh("b: 1")), "");
  EXPECT_THAT(ErrorsOf(mesh("g: 255")),
              HasSubstr("shape.mesh.color[3]: a vertex has a colour that is not within 0 to 1"));
  EXPECT_THAT(ErrorsOf(mesh("g: 255")), HasSubstr("s.scene:2:25: error"));
}

TEST(LoadTest, ACurveThatIsNotThereIsNamed) {
  const LoadResult none = LoadFile("a.svg", kThreeCurves, "curve: 4");
  ASSERT_EQ(none.errors.size(), 1u);
  EXPECT_THAT(none.errors[0].message, HasSubstr("there is no curve 4; the file has 3"));
}

}  // namespace
}  // namespace fjord
