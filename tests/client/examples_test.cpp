// Every example is a good scene and renders.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/client/run_program.h"

namespace fjord::testing {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> Examples() {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(Example(""))) {
    if (entry.path().extension() == ".scene")
      names.push_back(fs::relative(entry.path(), Example("")).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class ExamplesTest : public ::testing::TestWithParam<std::string> {};

TEST_P(ExamplesTest, IsGoodAndRendersAtATinySize) {
  const std::string scene = Example(GetParam());
  const ProgramRun check = RunFjord({"check", "--animation", scene});
  EXPECT_EQ(check.code, 0) << check.err;
  const ScratchFolder folder;
  const ProgramRun run =
      RunFjord({"render", scene, "-o", folder.path(), "--size", "64x36", "--frames", "1"});
  EXPECT_EQ(run.code, 0) << run.err;
}

INSTANTIATE_TEST_SUITE_P(All, ExamplesTest, ::testing::ValuesIn(Examples()), [](const auto& file) {
  std::string name = file.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
});

// The jobs of the thesis' pictures 1-12 and its roughened solids are there.
TEST(ExamplesTest, S10_S11_S12_S20_S23_ThePicturesOfTheThesisAreJobs) {
  for (int picture = 1; picture <= 12; ++picture) {
    char name[40];
    std::snprintf(name, sizeof name, "shih/picture-%02d.scene", picture);
    EXPECT_TRUE(fs::exists(Example(name))) << name;
  }
  for (const char* name : {"sphere.scene", "ellipsoid.scene", "torus.scene", "taiwan-rising.scene"})
    EXPECT_TRUE(fs::exists(Example(name))) << name;
}

TEST(ExamplesTest, S25_TheDemoMovesFromKeyToKey) {
  const ScratchFolder folder;
  const ProgramRun run = RunFjord({"render", Example("taiwan-rising.scene"), "-o", folder.path(),
                                   "--size", "96x54", "--set", "objects[island].fractal.pixels=4"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto manifest = nlohmann::json::parse(ReadAll(folder / "manifest.json"));
  ASSERT_EQ(manifest["frames"].size(), 96u);
  for (size_t i = 1; i < 96; ++i)
    EXPECT_NE(manifest["frames"][i]["pixel_digest"], manifest["frames"][i - 1]["pixel_digest"])
        << i;
}

}  // namespace
}  // namespace fjord::testing
