#include <gtest/gtest.h>

#include "engine/formats/limits.h"
#include "engine/formats/shape_file.h"
#include "engine/geometry/check_mesh.h"
#include "tests/formats/expect_error.h"

namespace fjord {
namespace {

Result<ShapeFile> Read(const std::string& text) { return ReadShape(text, "a.std"); }

std::string DataPart(const std::string& text) { return text.substr(text.find("data ")); }

TEST(StdFileTest, S27_TaiwanHasItsCountsAndNoDefects) {
  struct Want {
    const char* path;
    size_t points, faces;
  };
  for (const Want& want :
       {Want{"examples/data/taiwan.std", 101, 167}, Want{"examples/data/taiwan_coast.std", 33, 1},
        Want{"examples/data/taiwan_relief.std", 101, 167}}) {
    const ShapeFile shape = ReadShape(ReadTestFile(want.path), want.path).value();
    EXPECT_EQ(shape.mesh.points.size(), want.points);
    EXPECT_EQ(shape.mesh.FaceCount(), want.faces);
    EXPECT_TRUE(shape.curves.empty());
    for (const MeshDefect& defect : CheckMesh(shape.mesh)) ADD_FAILURE() << defect.message;
  }
}

TEST(StdFileTest, S27_TaiwanRoundTripsByteForByte) {
  for (const char* path : {"examples/data/taiwan.std", "examples/data/taiwan_coast.std",
                           "examples/data/taiwan_relief.std"}) {
    const std::string bytes = ReadTestFile(path);
    const ShapeFile shape = ReadShape(bytes, path).value();
    for (ShapeFormat format : {ShapeFormat::kStd, ShapeFormat::kEpf}) {
      EXPECT_EQ(DataPart(WriteShape(shape, format, {}).value()), DataPart(bytes)) << path;
    }
  }
}

TEST(StdFileTest, S27_ChangedNumbersArePrintedInFull) {
  ShapeFile shape = Read("data 3 1\n0.10 0 0\n1.00 0 0\n0 1.500 0\n3 1 2 3\n").value();
  shape.mesh.points[0].x = .123456789;
  EXPECT_EQ(WriteShape(shape, ShapeFormat::kStd, {}).value(),
            "data 3 1\n0.123456789 0 0\n1.00 0 0\n0 1.500 0\n3 1 2 3\n");
}

TEST(StdFileTest, S27_LinesOfTheFileAreKept) {
  const ShapeFile shape =
      Read("free text\n\ndata 3 1\n# corner\n0 0 0\n1 0 0\n\n0 1 0\n3 1 2 3\n").value();
  EXPECT_EQ(shape.vertex_line, (std::vector<int>{5, 6, 8}));
  EXPECT_EQ(shape.face_line, (std::vector<int>{9}));
}

TEST(StdFileTest, S27_FreeTextMayHoldTheWordData) {
  EXPECT_TRUE(Read("data from the appendix\ndata\nmore\ndata 3 1\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3"));
}

TEST(StdFileTest, C47_CommentsGoIntoTheFreeText) {
  const ShapeFile shape = Read("data 3 1\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3\n").value();
  const std::string text =
      WriteShape(shape, ShapeFormat::kStd, {"seed 7, H 0.7", "data 9 9", "two\nlines"}).value();
  EXPECT_EQ(text.substr(0, text.find("\ndata 3")), "seed 7, H 0.7\n# data 9 9\ntwo lines");
  EXPECT_TRUE(Read(text));
}

TEST(StdFileTest, S27_WindowsLineEndsAndTabs) {
  const ShapeFile shape = Read("data\t3 1\r\n0 0 0\r\n1\t0 0 \r\n0 1 0\r\n3 1 2 3\r\n").value();
  EXPECT_EQ(shape.mesh.points[1], Vec3(1, 0, 0));
}

TEST(StdFileTest, S27_EveryFaultIsNamedWithItsPlace) {
  struct Case {
    const char* text;
    const char* place;
    const char* words;
  };
  const Case cases[] = {
      {"no such line\n0 0 0\n", "a.std", "no line `data NPTS NPOLYS`"},
      {"data\n0 0 0\n", "a.std:1:1", "no line `data NPTS NPOLYS`"},
      {"data 3\n0 0 0\n", "a.std:1:7", "number of polygons is missing"},
      {"data 3.5 1\n", "a.std:1:6", "whole number, not '3.5'"},
      {"data 0 1\n", "a.std:1:6", "at least 1"},
      {"data -3 1\n", "a.std:1:6", "at least 1"},
      {"data 3 0\n0 0 0\n1 0 0\n0 1 0\n", "a.std:1:8", "polygons must be at least 1"},
      {"data 3 1 7\n", "a.std:1:10", "takes two counts"},
      {"data 17000000 1\n", "a.std:1:6", "more than 16000000"},
      {"data 99999999999999999999 1\n", "a.std:1:6", "more than 16000000"},
      {"data 1000000 1000000\n0 0 0\n", "a.std:1:1", "only 6 bytes follow"},
      {"data 3 1\n0 0 0\n1 0\n0 1 0\n3 1 2 3\n", "a.std:3:4", "point 2 has 2 coordinates"},
      {"data 3 1\n0 0 0\n1 0 0 4\n0 1 0\n3 1 2 3\n", "a.std:3:7", "more than three coordinates"},
      {"data 3 1\n0 0 0\n1 zero 0\n0 1 0\n3 1 2 3\n", "a.std:3:3",
       "point 2: 'zero' is not a number"},
      {"data 3 1\n0 0 0\n1 nan 0\n0 1 0\n3 1 2 3\n", "a.std:3:3", "'nan' is not finite"},
      {"data 3 1\n0 0 0\n1 0 -inf\n0 1 0\n3 1 2 3\n", "a.std:3:5", "'-inf' is not finite"},
      {"data 3 1\n0 0 0\n1e308 0 0\n0 1 0\n3 1 2 3\n", "a.std:3:1", "'1e308' is too large"},
      {"data 3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.std:5:3", "vertex 0; vertices are 1 to 3"},
      {"data 3 1\n0 0 0\n1 0 0\n0 1 0\n3 1 2 -3\n", "a.std:5:7", "vertex -3"},
      {"data 3 1\n0 0 0\n1 0 0\n0 1 0\n3 1 2 4\n", "a.std:5:7", "vertex 4; vertices are 1 to 3"},
      {"data 3 1\n0 0 0\n1 0 0\n0 1 0\n2 1 2\n     ", "a.std:5:1", "at least 3"},
      {"data 3 1\n0 0 0\n1 0 0\n0 1 0\n4 1 2 3\n", "a.std:5:8", "says 4 vertices and lists 3"},
      {"data 3 1\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3 1\n", "a.std:5:9", "says 3 vertices and lists more"},
      {"data 3 1\n0 0 0\n1 0 0\n0 1 0\n3 1 b 3\n", "a.std:5:5", "'b' is no vertex number"},
      {"data 3 1\n0 0 0\n1 0 0\n0 1 0\nx 1 2 3\n", "a.std:5:1", "starts with the number"},
      {"data 3 1\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3\n3 1 2 3\n", "a.std:6:1", "more lines than"},
      {"data 3 1\n0.000 0 0\n1.000 0 0\n", "a.std:1:1", "cut short"},
      {"data 3 1\n0.000 0 0\n1.000 0 0\n0.000 1.0000 0\n", "a.std:4", "after 0 of 1 polygons"},
      {"data 3 1\n0.0000000 0 0\n1.0000000 0 0\n", "a.std:3", "after 2 of 3 points"},
      {"data 3 1\n0 0 0\n3 1 2 3\n0 1 0\n3 1 2 3\n", "a.std:3:7", "more than three coordinates"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    ExpectError(Read(c.text), c.place, c.words);
  }
}

TEST(StdFileTest, S27_EveryTruncationOfTaiwanIsAnErrorOrTheWhole) {
  const std::string bytes = ReadTestFile("examples/data/taiwan_coast.std");
  const size_t last = bytes.find_last_not_of("\n ");
  for (size_t n = 0; n < last; ++n) {
    const auto shape = ReadShape(std::string_view(bytes).substr(0, n), "a.std");
    // The last vertex number is 33: cut after its first digit it is still a number, and a lie that
    // cannot be seen.
    if (n == last) continue;
    EXPECT_FALSE(shape) << n;
  }
  EXPECT_TRUE(ReadShape(std::string_view(bytes).substr(0, last + 1), "a.std"));
}

TEST(StdFileTest, LongLinesAreRefusedByName) {
  const std::string line(limits::kLineBytes + 1, ' ');
  ExpectError(Read("data 3 1\n0 0 0\n" + line + "\n1 0 0\n0 1 0\n3 1 2 3\n"), "a.std:3:1",
              "longer than 16 MiB");
}

}  // namespace
}  // namespace fjord
