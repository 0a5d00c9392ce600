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

// Eleven short pieces and one long span: the span is divided, where nobody says otherwise.
std::string Bay(double scale) {
  std::string bytes;
  for (int i = 0; i < 12; ++i) {
    bytes += "v " + std::to_string(scale * i) + " " + std::to_string(scale * (i % 2 + 5)) + " 0\n";
  }
  return bytes + "v " + std::to_string(scale * 40) + " 0 0\nl 1 2 3 4 5 6 7 8 9 10 11 12 13\n";
}

std::string ImportText(const std::string& bytes, const ImportOptions& options = {}) {
  return SceneTextFromShape(ReadShape(bytes, "a.obj").value(), "a.obj", nullptr, "", options)
      .value();
}

TEST(ImportTest, LongSpansBesideShortOnesAreDivided) {
  EXPECT_THAT(ImportText(Bay(1)), HasSubstr("file { path: \"a.obj\" spacing: 4.25 }"));
  EXPECT_THAT(ImportText(Bay(1000)), HasSubstr(" spacing: 4243 }"));
  EXPECT_THAT(ImportText(Bay(1), {UpAxis::kZ, 2.5}), HasSubstr(" spacing: 2.5 }"));
  EXPECT_THAT(ImportText(Bay(1), {UpAxis::kZ, 0}), Not(HasSubstr("spacing")));
  // Even outlines stay as they are drawn, and so does what a .par file's numbers are for.
  EXPECT_THAT(ImportText("v 0 0 0\nv 1 0 0\nv 2 1 0\nv 2 3 0\nl 1 2 3 4 1\n"),
              Not(HasSubstr("spacing")));
  const ParFile par = ReadPar("100 750 71 .7 1", "a.par").value();
  EXPECT_THAT(
      SceneTextFromShape(ReadShape(Bay(1), "a.obj").value(), "a.obj", &par, "a.par").value(),
      Not(HasSubstr("spacing")));
}

// A fan over an even outline: no span is long, but its triangles are slivers.
TEST(ImportTest, FansAreTriangulatedEvenly) {
  std::string flat, lid, faces;
  for (int i = 0; i < 40; ++i) {
    const double x = i < 20 ? i : 39 - i, y = i < 20 ? .02 * i * (19 - i) : 4 + .02 * i * (39 - i);
    flat += "v " + std::to_string(x) + " " + std::to_string(y) + " 0\n";
    if (i > 1) faces += "f 1 " + std::to_string(i) + " " + std::to_string(i + 1) + "\n";
  }
  EXPECT_THAT(ImportText(flat + faces), HasSubstr(" spacing: "));
  EXPECT_THAT(ImportText(flat + faces, {UpAxis::kZ, 0}), Not(HasSubstr("spacing")));
  const std::string folded =  // as thin, but every edge is a crease
      "v 0 0 0\nv 9 0 1\nv 9 .5 0\nv 9 1 1\nv 9 1.5 0\nf 1 2 3\nf 1 3 4\nf 1 4 5\n";
  EXPECT_THAT(ImportText(folded), Not(HasSubstr("spacing")));
}

TEST(ImportTest, UpIsTurnedToZ) {
  const std::string hill =
      "v 0 0 0\nv 0 0 4\nv 4 0 4\nv 4 0 0\nv 2 1 2\n"
      "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
  const std::string scene = ImportText(hill, {UpAxis::kY, {}});
  EXPECT_THAT(scene, HasSubstr("file { path: \"a.obj\" up: Y }"));
  EXPECT_THAT(scene, HasSubstr("x 0 to 4, y -4 to 0, z 0 to 1\n"));
  EXPECT_THAT(scene, HasSubstr("sea { level: 0 }"));
  EXPECT_THAT(ImportText(hill, {UpAxis::kX, {}}), HasSubstr("x -4 to 0, y 0 to 1, z 0 to 4\n"));
  EXPECT_TRUE(LooksTurned(ReadShape(hill, "a.obj").value()));
  const std::string upright = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 2 1\nf 1 2 4\nf 2 3 4\n";
  EXPECT_FALSE(LooksTurned(ReadShape(upright, "a.obj").value()));
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
