#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/formats/import.h"
#include "engine/scene/load.h"
#include "engine/scene/shapes.h"
#include "tests/formats/expect_error.h"
#include "tests/scene/entry_values.h"

namespace fjord {
namespace {

const char* const kKeyed =
    "parameters\nmaxlevel 10\nepsilon .1\nfixvl .4\nseed 71\nH-Fdim .3\nsigma .5\n";
const char* const kPositional = "100\n750\n71\n0.7\n1\n";

v1::Scene Load(const std::string& text, const std::string& bytes) {
  const LoadResult result = LoadSceneText(
      text, "imported.scene", [&bytes](const v1::File&) { return Result<std::string>(bytes); });
  for (const Error& error : result.errors) ADD_FAILURE() << error.ToString() << "\n" << text;
  return result.loaded.scene;
}

v1::Scene Import(const std::string& bytes, const std::string& path, const char* par) {
  const ShapeFile shape = ReadShape(bytes, path).value();
  if (par == nullptr) return Load(SceneTextFromShape(shape, path, nullptr, "").value(), bytes);
  const ParFile read = ReadPar(par, "a.par").value();
  return Load(SceneTextFromShape(shape, path, &read, "a.par").value(), bytes);
}

TEST(ImportSceneTest, S27_WhatImportWritesLoadsWithoutADefect) {
  for (const char* file : {"taiwan.std", "taiwan_coast.std", "taiwan_relief.std"}) {
    const std::string bytes = ReadTestFile(std::string("examples/data/") + file);
    for (const char* par : {static_cast<const char*>(nullptr), kKeyed, kPositional}) {
      EXPECT_EQ(Import(bytes, file, par).objects_size(), 1);
    }
  }
}

TEST(ImportSceneTest, S27_ParametersArrive) {
  const std::string bytes = ReadTestFile("examples/data/taiwan_relief.std");
  const v1::Fractal keyed = Import(bytes, "a.std", kKeyed).objects(0).fractal();
  EXPECT_EQ(keyed.max_level(), 10u);
  EXPECT_EQ(keyed.epsilon(), .1);
  EXPECT_EQ(testing::ValueIn(keyed, "move"), "0.4");
  EXPECT_EQ(keyed.seed(), 71u);
  EXPECT_EQ(testing::ValueIn(keyed, "H"), "0.3");
  EXPECT_EQ(testing::ValueIn(keyed, "sigma"), "0.5");
  EXPECT_EQ(testing::ValueIn(keyed, "law"), "SHIH");
  EXPECT_EQ(testing::ValueIn(keyed, "coast"), "true");
  EXPECT_EQ(Import(bytes, "a.std", kPositional).objects(0).fractal().epsilon(), .075);
}

TEST(ImportSceneTest, OtherFormatsAndFormsLoadToo) {
  struct Case {
    const char* path;
    const char* bytes;
  };
  for (const Case& c : {
           Case{"a b.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 1 0 0 1\nf 1 2 3\n"},
           Case{"closed.obj",
                "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"},
           Case{"line.svg", "<svg><path d='M0 0L1 1L2 0'/></svg>"},
           Case{"tall.svg", "<svg><path d='M0 0L0 7'/></svg>"},
           Case{"small.obj", "v 0 0 0\nv 1e-9 0 0\nv 0 1e-9 0\nf 1 2 3\n"},
           Case{"far.obj", "v 1e9 1e9 0\nv 1000000001 1e9 0\nv 1e9 1000000001 5\nf 1 2 3\n"},
           Case{"\"odd\\ .obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
       }) {
    SCOPED_TRACE(c.path);
    EXPECT_EQ(Import(c.bytes, c.path, nullptr).objects_size(), 1);
  }
}

TEST(ImportSceneTest, EveryCurveOfAFileBecomesAnObject) {
  const v1::Scene svg =
      Import("<svg><path d='M0 0L1 1L2 0z'/><path d='M5 5L6 6'/></svg>", "17.svg", nullptr);
  ASSERT_EQ(svg.objects_size(), 2);
  EXPECT_EQ(svg.objects(0).name(), "shape17");
  EXPECT_EQ(svg.objects(0).shape().file().curve(), 1u);
  EXPECT_TRUE(svg.objects(0).material().fill());
  EXPECT_EQ(svg.objects(1).shape().file().curve(), 2u);
  EXPECT_FALSE(svg.objects(1).material().fill());
  const v1::Scene obj =
      Import("v 0 0 0\nv 1 0 0\nv 0 1 1\nv 3 0 0\nv 4 0 0\nf 1 2 3\nl 4 5\n", "both.obj", nullptr);
  ASSERT_EQ(obj.objects_size(), 2);
  EXPECT_EQ(obj.objects(0).shape().file().curve(), 0u);
  EXPECT_EQ(obj.objects(1).shape().file().curve(), 1u);
}

TEST(ImportSceneTest, WhatImportSaysOfTheFileArrives) {
  const std::string bytes = "v 0 0 0\nv 0 0 1\nv 9 0 1\nv 9 0 0\nl 1 2 3 4 1\n";
  const ShapeFile shape = ReadShape(bytes, "a.obj").value();
  const std::string text =
      SceneTextFromShape(shape, "a.obj", nullptr, "", {UpAxis::kY, 2.}).value();
  const LoadResult result = LoadSceneText(
      text, "imported.scene", [&](const v1::File&) { return Result<std::string>(bytes); });
  ASSERT_TRUE(result.errors.empty()) << result.errors[0].ToString() << "\n" << text;
  const Geometry geometry =
      DecodeShape(result.loaded.scene.objects(0).shape(), result.loaded.assets).value();
  ASSERT_EQ(geometry.points.size(), 1u + 5 + 1 + 5);
  EXPECT_EQ(geometry.points[1], Vec3(0, -1, 0));
  EXPECT_NEAR(geometry.points[2].x, 1.8, 1e-15);
}

// Law AFFINE: k^(1-H), H .7.
TEST(ImportSceneTest, AmplitudeFollowsTheSizeOfTheShape) {
  const auto amplitude = [](const std::string& x) {
    const std::string bytes =
        "v 0 0 0\nv " + x + " 0 0\nv 0 " + x + " 0\nv 0 0 " + x + "\nf 1 2 3\nf 1 3 4\n";
    return std::stod(
        testing::ValueIn(Import(bytes, "a.obj", nullptr).objects(0).fractal(), "amplitude"));
  };
  EXPECT_EQ(amplitude("2"), .15);
  EXPECT_NEAR(amplitude("10000"), 1.931, 1e-3);
  EXPECT_NEAR(amplitude("0.02"), .03768, 1e-5);
}

}  // namespace
}  // namespace fjord
