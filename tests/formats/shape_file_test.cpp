#include "engine/formats/shape_file.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/formats/expect_error.h"

namespace fjord {
namespace {

const char* const kTriangleStd = "data 3 1\n0 0 0\n1 0 0\n0 1 0\n3 1 2 3\n";
const char* const kTriangleObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(ShapeFileTest, S27_ContentDecidesNotTheEnding) {
  for (const char* name : {"a.std", "a.obj", "a.txt", "a"}) {
    EXPECT_TRUE(ReadShape(kTriangleStd, name)) << name;
    EXPECT_TRUE(ReadShape(kTriangleObj, name)) << name;
    EXPECT_TRUE(ReadShape(std::string("\xEF\xBB\xBF") + kTriangleObj, name)) << name;
    EXPECT_TRUE(ReadShape("\n <svg><path d='M0 0L1 1'/></svg>", name)) << name;
  }
}

TEST(ShapeFileTest, BadFilesAreNamed) {
  ExpectError(ReadShape("", "a.std"), "a.std", "the file is empty");
  ExpectError(ReadShape(" \n\n", "a.std"), "a.std", "nothing but spaces");
  ExpectError(ReadShape(std::string("ab\0cd", 5), "a.std"), "a.std", "binary");
  ExpectError(ReadShape("\x01\x02\x03\x04\x05", "a.obj"), "a.obj", "binary");
  ExpectError(ReadShape("just some words\n", "a.txt"), "a.txt", "no shape is recognised");
  ExpectError(ReadShape("just some words\n", "a.std"), "a.std", "no line `data NPTS NPOLYS`");
}

TEST(ShapeFileTest, FormatsByEnding) {
  EXPECT_EQ(ShapeFormatOf("x/y.std").value(), ShapeFormat::kStd);
  EXPECT_EQ(ShapeFormatOf("y.EPF").value(), ShapeFormat::kEpf);
  EXPECT_EQ(ShapeFormatOf("y.z.obj").value(), ShapeFormat::kObj);
  EXPECT_EQ(ShapeFormatOf("y.ply").value(), ShapeFormat::kPly);
  EXPECT_EQ(ShapeFormatOf("y.svg").value(), ShapeFormat::kSvg);
  for (const char* bad : {"y.stl", "y", "a.std/y"}) {
    const auto format = ShapeFormatOf(bad);
    ASSERT_FALSE(format);
    EXPECT_EQ(format.error().code, ErrorCode::kUsage);
    EXPECT_NE(format.error().message.find(".std, .epf, .obj, .ply or .svg"), std::string::npos);
  }
}

TEST(ShapeFileTest, OnlyWhatCanBeReadAgainIsWritten) {
  const ShapeFile good = ReadShape(kTriangleStd, "a").value();
  const auto refuse = [](const ShapeFile& shape, ShapeFormat format, const std::string& words) {
    ExpectError(WriteShape(shape, format, {}), "", words);
  };
  refuse({}, ShapeFormat::kObj, "nothing to write");
  ShapeFile shape = good;
  shape.mesh.points[1].y = std::numeric_limits<double>::quiet_NaN();
  refuse(shape, ShapeFormat::kPly, "vertex 2 is not finite");
  shape = good;
  shape.mesh.face_vertex[2] = 3;
  refuse(shape, ShapeFormat::kObj, "names vertex 4");
  shape = good;
  shape.mesh.face_size[0] = 4;
  refuse(shape, ShapeFormat::kObj, "do not add up");
  shape = good;
  shape.mesh.colors.resize(2);
  refuse(shape, ShapeFormat::kObj, "colour for every vertex");
  shape = good;
  shape.mesh.face_vertex.assign(3, 1);
  refuse(shape, ShapeFormat::kSvg, "no face of the mesh has an edge");
  EXPECT_TRUE(WriteShape(shape, ShapeFormat::kObj, {}));
  shape = {};
  shape.curves.push_back({{{0, 0, 0}, {1, 0, 0}}, false});
  refuse(shape, ShapeFormat::kStd, "curve 1 is open");
  EXPECT_TRUE(WriteShape(shape, ShapeFormat::kSvg, {}));
  shape.curves[0].points.pop_back();
  refuse(shape, ShapeFormat::kSvg, "too few points");
}

TEST(ShapeFileTest, G52_ClosedCurvesBecomePolygonsOfTheOldFormat) {
  ShapeFile shape;
  shape.curves.push_back({{{0, 0, 0}, {1, 0, 0}, {.5, 1, 0}}, true});
  EXPECT_EQ(WriteShape(shape, ShapeFormat::kEpf, {"made by Fjord"}).value(),
            "made by Fjord\ndata 3 1\n0 0 0\n1 0 0\n0.5 1 0\n3 1 2 3\n");
}

}  // namespace
}  // namespace fjord
