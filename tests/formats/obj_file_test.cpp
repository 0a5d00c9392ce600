#include <gtest/gtest.h>

#include "engine/formats/shape_file.h"
#include "tests/formats/expect_error.h"

namespace fjord {
namespace {

Result<ShapeFile> Read(const std::string& text) { return ReadShape(text, "a.obj"); }

TEST(ObjFileTest, FacesInAllTheirForms) {
  const ShapeFile shape =
      Read(
          "# made by hand\nmtllib x.mtl\no thing\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0\n"
          "v 0 1 0\nvt 0 0\nvn 0 0 1\nusemtl red\ns off\n"
          "f 1 2 3\nf 1/1 3/1 4/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 3/1/1 4/1/1\n"
          "f -4 -3 -2\nf 1 2 \\\n 3 4  # continued\n")
          .value();
  EXPECT_EQ(shape.mesh.points.size(), 4u);
  EXPECT_EQ(shape.mesh.face_size, (std::vector<uint32_t>{3, 3, 3, 4, 3, 4}));
  EXPECT_EQ(shape.mesh.face_vertex,
            (std::vector<uint32_t>{0, 1, 2, 0, 2, 3, 0, 1, 2, 0, 1, 2, 3, 0, 1, 2, 0, 1, 2, 3}));
  EXPECT_EQ(shape.face_line.back(), 17);
  EXPECT_EQ(shape.vertex_line, (std::vector<int>{4, 5, 6, 7}));
}

TEST(ObjFileTest, ColoursAfterTheVertex) {
  const ShapeFile shape = Read("v 0 0 0 1 0.5 0\nv 1 0 0 0 0.25 1\nv 0 1 0\nf 1 2 3\n").value();
  ASSERT_EQ(shape.mesh.colors.size(), 3u);
  EXPECT_EQ(shape.mesh.colors[0], Rgb(1, .5, 0));
  EXPECT_EQ(shape.mesh.colors[1], Rgb(0, .25, 1));
  EXPECT_EQ(shape.mesh.colors[2], Rgb(1));  // none given: white
}

TEST(ObjFileTest, G52_LinesAreCurves) {
  const ShapeFile shape =
      Read("v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\nl 1/1 2/2 3/3 1/1\nl 1 2\n").value();
  ASSERT_EQ(shape.curves.size(), 3u);
  EXPECT_TRUE(shape.mesh.points.empty());
  EXPECT_FALSE(shape.curves[0].closed);
  EXPECT_EQ(shape.curves[0].points.size(), 3u);
  EXPECT_TRUE(shape.curves[1].closed);
  EXPECT_EQ(shape.curves[1].points.size(), 3u);
}

TEST(ObjFileTest, LinesOfTwoPointsJoin) {
  const ShapeFile shape = Read(
                              "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 0\nv 6 6 0\nl 5 6 1\nl 1 "
                              "2\nl 2 3\nl 4 3\nl 1 4\n")
                              .value();
  ASSERT_EQ(shape.curves.size(), 2u);
  EXPECT_EQ(shape.curves[0].points.size(), 3u);
  EXPECT_TRUE(shape.curves[1].closed);
  EXPECT_EQ(shape.curves[1].points,
            (std::vector<Vec3>{Vec3(0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}));
}

TEST(ObjFileTest, CommentsNeverContinue) {
  const std::string tail = "v 1 0 0\nv 1 1 0\nf 1 2 3\n";
  for (const char* head :
       {"# model C:\\work\\\nv 0 0 0\n", "v 0 0 0 # a path \\\n", "v 0 0 \\ # of three\n0\n",
        "v 0 0 0#1.#IND\n", "v 0 0 0.#In hand\n", "#\\\r\nv 0 0 0\r\n"}) {
    SCOPED_TRACE(head);
    const ShapeFile shape = Read(head + tail).value();
    EXPECT_EQ(shape.mesh.points, (std::vector<Vec3>{Vec3(0), Vec3(1, 0, 0), Vec3(1, 1, 0)}));
  }
}

// A folder's name may end in a backslash; the statement after it is no part of the name.
TEST(ObjFileTest, NamesThatEndInABackslashSwallowNoStatement) {
  const std::string tail = "v 1 0 0\nv 1 1 0\nf 1 2 3\n";
  for (const char* head :
       {"mtllib C:\\maps\\\nv 0 0 0\n", "mtllib C:\\my maps\\ \nv 0 0 0\n",
        "usemtl a\\\r\nv 0 0 0\r\n", "o D:\\\nv 0 0 0\n", "maplib \\\n\n# v\nv 0 0 0\n",
        "g left \\\nright\nv 0 0 0\n", "g a \\\n  b \\\n c\nv 0 0 0\n",
        "usemap C:\\\nusemtl C:\\\n\tv 0 0 0\n"}) {
    SCOPED_TRACE(head);
    const ShapeFile shape = Read(head + tail).value();
    EXPECT_EQ(shape.mesh.points, (std::vector<Vec3>{Vec3(0), Vec3(1, 0, 0), Vec3(1, 1, 0)}));
  }
  EXPECT_TRUE(Read("v 0 0 0\n" + tail + "mtllib C:\\"));
}

TEST(ObjFileTest, WhatIsPassedOverAndDrawsIsNoted) {
  const ShapeFile shape =
      Read("v 0 0 0\nv 1 0 0\nv 0 1 0\np 1\np 2 3\nvp 0.5 1\ncstype bezier\ndeg 3\nend\nf 1 2 3\n")
          .value();
  EXPECT_THAT(NotesOf(shape),
              testing::ElementsAre("a.obj:4:1: points (p) are passed over: they are no curve",
                                   "a.obj:6:1: vp belongs to free-form curves and is passed over"));
  EXPECT_TRUE(Read("mtllib a\ns 1\ng b\nv 0 0 0\nv 1 0 0\nl 1 2\n")->notes.empty());
}

// What is not used may be what programs write where they have no number.
TEST(ObjFileTest, UnusedNumbersMayBeAnything) {
  EXPECT_TRUE(
      Read("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn nan nan nan\nvt 1e99 -inf\nf 1/1/1 2/1/1 3/1/1\n"));
}

TEST(ObjFileTest, BlanksMayFollowTheBackslash) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  for (const char* face :
       {"f 1 2 \\ \n3 4\n", "f 1 2\\\t\r\n3 4\n", "f \\  \n1 2 3\\ \n4", "f 1 2 3 4 \\ "}) {
    SCOPED_TRACE(face);
    EXPECT_EQ(Read(points + face).value().mesh.face_vertex, (std::vector<uint32_t>{0, 1, 2, 3}));
  }
}

TEST(ObjFileTest, VerticesMayFollowTheirUse) {
  EXPECT_EQ(Read("v 0 0 0\nf 1 2 3\nv 1 0 0\nv 0 1 0\n").value().mesh.FaceCount(), 1u);
}

TEST(ObjFileTest, VerticesOfLinesAloneAreNotTheMeshs) {
  const ShapeFile shape =
      Read("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 8 8 8\nl 1 5\nf 2 3 4\n").value();
  EXPECT_EQ(shape.mesh.points.size(), 3u);
  EXPECT_EQ(shape.mesh.face_vertex, (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(shape.vertex_line, (std::vector<int>{2, 3, 4}));
}

TEST(ObjFileTest, EveryFaultIsNamedWithItsPlace) {
  struct Case {
    const char* text;
    const char* place;
    const char* words;
  };
  const Case cases[] = {
      {"v 0 0 0\nv 1 0\n", "a.obj:2:6", "vertex 2 has 2 numbers"},
      {"v 0 0 0\nv 1 0 0 1 1\n", "a.obj:2:12", "5 numbers"},
      {"v 0 0 0\nv 1 0 0 1 1 1 1 1\n", "a.obj:2:17", "more than seven"},
      {"v 0 0 0\nv 1 0 0 1 1 1 1\n", "a.obj:2:16", "seven numbers"},
      {"v 0 0 0\nv 1 0 0 255 0 0\n", "a.obj:2:16", "not within 0 to 1"},
      {"v 0 0 0\nv nan 0 0\n", "a.obj:2:3", "not finite"},
      {"v 0 0 0\nv 0 -inf 0\n", "a.obj:2:5", "not finite"},
      {"v 0 0 0\nv 0 1e308 0\n", "a.obj:2:5", "too large"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "a.obj:4:3", "count from 1"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", "a.obj:4:7", "before the first"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 4 9\nf 1 2 9\n", "a.obj:5:5",
       "vertex 4; the file has 3"},
      {"v 0 0 0\nf 1 2 99999999\n", "a.obj:2:7", "more than a file may hold"},
      {"v 0 0 0\nf 1 2 99999999999999999999\n", "a.obj:2:7", "no vertex number"},
      {"v 0 0 0\nv 1 0 0\nf 1 2\n", "a.obj:3:6", "at least 3"},
      {"v 0 0 0\nl 1\n", "a.obj:2:4", "at least 2"},
      {"v 0 0 0\nf 1 2/x 3\n", "a.obj:2:5", "no corner"},
      {"v 0 0 0\nf 1 2/1/1/1 3\n", "a.obj:2:5", "no corner"},
      {"v 0 0 0\nf a b c\n", "a.obj:2:3", "no vertex number"},
      {"v 0 0 0\nv 1 0 0\n", "a.obj:2", "no face"},
      {"v 0 0 0\ncurv 0 1 1 2\n", "a.obj:2:1", "free-form"},
      {"v 0 0 0\n surf 0 1 0 1\n", "a.obj:2:2", "free-form"},
      {"v 0 0 0\nbsp 1 2\n", "a.obj:2:1", "free-form"},
      {"v 0 0 0\ncurv2 1 2\n", "a.obj:2:1", "free-form"},
      {"v 0 0 0\ncall other.obj\n", "a.obj:2:1", "put its statements here"},
      {"v 0 0 0\ncsh ls\n", "a.obj:2:1", "put its statements here"},
      {"v 0 0 0\nv 1 0 0 nan\n", "a.obj:2:9", "not finite"},
      {"v 0 0 0\nv 1 0 0 0 0 inf\n", "a.obj:2:13", "not finite"},
      {"v 0 0 0\nv 1 -1.#IND 0\n", "a.obj:2:5", "not finite"},
      {"v 0 0 0\nv 1 0 1.#QNAN\n", "a.obj:2:7", "not finite"},
      {"v 0 0 0\nv 1 0 1.#inf # 1\n", "a.obj:2:7", "not finite"},
      {"v 0 0 0\nv 0x1 0 0\n", "a.obj:2:3", "not a number"},
      {"v 0 0 0\nv 1,5 0 0\n", "a.obj:2:3", "not a number"},
      {"v 0 0 0\nwhatever 3\n", "a.obj:2:1", "'whatever' is no statement"},
      {"hello\nworld\n", "a.obj", "no vertex line"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    ExpectError(Read(c.text), c.place, c.words);
  }
}

TEST(ObjFileTest, AnimatorsObjectIsRecognisedAndRefused) {
  ExpectError(Read("title a cone\ndetail cone.det\ntype polygon\nbounding_box -5 5 -5 5 -5 5\n"
                   "color 1 .5 .5\nshininess 0\n"),
              "a.obj:2:1", "Animator");
}

TEST(ObjFileTest, C47_CommentsAreComments) {
  const ShapeFile shape = Read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").value();
  EXPECT_EQ(WriteShape(shape, ShapeFormat::kObj, {"seed 7", "path C:\\"}).value(),
            "# seed 7\n# path C:\\ \nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
}

}  // namespace
}  // namespace fjord
