#include "engine/formats/import.h"

#include <gtest/gtest.h>

#include "tests/formats/expect_error.h"

namespace fjord {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string Import(const std::string& file, const char* par = nullptr) {
  const ShapeFile shape = ReadShape(ReadTestFile("examples/data/" + file), file).value();
  if (par == nullptr) return SceneTextFromShape(shape, file, nullptr, "").value();
  const ParFile read = ReadPar(par, "a.par").value();
  return SceneTextFromShape(shape, file, &read, "a.par").value();
}

TEST(ImportTest, S27_AFlatMeshIsACoast) {
  const std::string scene = Import("taiwan.std");
  EXPECT_THAT(scene, HasSubstr("# taiwan.std: a flat mesh, 101 vertices, 167 faces"));
  EXPECT_THAT(scene, HasSubstr("method: \"coast\""));
  EXPECT_THAT(scene, HasSubstr("projection: ORTHOGRAPHIC"));
  EXPECT_THAT(scene, HasSubstr("file { path: \"taiwan.std\" }"));
  EXPECT_THAT(scene, Not(HasSubstr("To mend")));
}

TEST(ImportTest, S27_AnOutlineIsACurve) {
  const std::string scene = Import("taiwan_coast.std");
  EXPECT_THAT(scene, HasSubstr("outline: true"));
  EXPECT_THAT(scene, HasSubstr("method: \"curve\""));
}

TEST(ImportTest, S27_AReliefGetsASea) {
  const std::string scene = Import("taiwan_relief.std");
  EXPECT_THAT(scene, HasSubstr("method: \"surface\""));
  EXPECT_THAT(scene, HasSubstr("sea { level: 0 }"));
  EXPECT_THAT(scene, HasSubstr("coast: true"));
  EXPECT_THAT(scene, HasSubstr("fov: 35"));
}

TEST(ImportTest, S27_ParametersBecomeKnobsThatNameTheirSource) {
  const std::string keyed =
      Import("taiwan_relief.std",
             "parameters\nmaxlevel 10\nepsilon .1\nfixvl .4\nseed 71\nH-Fdim .3\nsigma .5");
  EXPECT_THAT(keyed, HasSubstr("# Fractal knobs from a.par"));
  for (const char* line :
       {"max_level: 10  # maxlevel\n", "epsilon: 0.1  # epsilon\n", "move: 0.4  # fixvl\n",
        "law: SHIH  #", "seed: 71  # seed\n", "H: 0.3  # H-Fdim\n", "sigma: 0.5  # sigma\n"}) {
    EXPECT_THAT(keyed, HasSubstr(line));
  }
  const std::string positional = Import("taiwan_coast.std", "100 750 71 .7 1");
  EXPECT_THAT(positional, HasSubstr("epsilon: 0.075  # 0.01 x eye distance 750 / scale 100"));
}

TEST(ImportTest, S28_DefectsAreSaid) {
  const ShapeFile shape =
      ReadShape("data 4 1\n0 0 0\n0 1 0\n1 0 0\n5 5 0\n3 1 2 3\n", "bad.std").value();
  const std::string scene = SceneTextFromShape(shape, "bad.std", nullptr, "").value();
  EXPECT_THAT(scene, HasSubstr("# To mend in bad.std: the mesh is clockwise"));
  EXPECT_THAT(scene, HasSubstr("# To mend in bad.std: vertex 4 belongs to no face"));
}

TEST(ImportTest, AShapeWithoutExtentIsRefused) {
  const ShapeFile shape = ReadShape("data 3 1\n1 1 1\n1 1 1\n1 1 1\n3 1 2 3\n", "a.std").value();
  ExpectError(SceneTextFromShape(shape, "a.std", nullptr, ""), "a.std", "at one place");
}

TEST(ImportTest, OddPathsAreQuoted) {
  const ShapeFile shape = ReadShape("v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n", "x").value();
  const std::string scene = SceneTextFromShape(shape, "a b/\"q\" \\.obj", nullptr, "").value();
  EXPECT_THAT(scene, HasSubstr("path: \"a b/\\\"q\\\" \\\\.obj\""));
  EXPECT_THAT(scene, HasSubstr("name: \"_q___\""));
  ExpectError(SceneTextFromShape(shape, "a\nb", nullptr, ""), "a\nb", "control character");
}

}  // namespace
}  // namespace fjord
