#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "engine/formats/shape_file.h"
#include "tests/formats/expect_error.h"

namespace fjord {
namespace {

Result<ShapeFile> Read(const std::string& text) { return ReadShape(text, "a.ply"); }

const char* const kAscii =
    "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255\n0 1 0.5 51 51 51\n3 0 1 2\n3 0 2 3\n";

TEST(PlyFileTest, Ascii) {
  const ShapeFile shape = Read(kAscii).value();
  EXPECT_EQ(shape.mesh.points[3], Vec3(0, 1, .5));
  EXPECT_EQ(shape.mesh.face_vertex, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(shape.mesh.colors[3], Rgb(.2f));
  EXPECT_EQ(shape.vertex_line, (std::vector<int>{14, 15, 16, 17}));
  EXPECT_EQ(shape.face_line, (std::vector<int>{18, 19}));
}

template <typename T>
void Put(T value, bool big, std::string* out) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if (big) std::reverse(bytes, bytes + sizeof(T));  // this test runs on little-endian machines
  out->append(bytes, sizeof(T));
}

std::string Binary(bool big, uint32_t faces = 1) {
  std::string out = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                    "_endian 1.0\nelement vertex 3\nproperty float x\nproperty double y\n"
                    "property short z\nproperty int extra\nelement other 1\n"
                    "property list ushort float noise\nelement face " +
                    std::to_string(faces) + "\nproperty list uchar uint vertex_index\nend_header\n";
  for (int v = 0; v < 3; ++v) {
    Put(float(v) + .5f, big, &out);
    Put(double(v * v) + .1, big, &out);
    Put(int16_t(-v), big, &out);
    Put(int32_t(77), big, &out);
  }
  Put(uint16_t(2), big, &out);
  Put(1.f, big, &out);
  Put(2.f, big, &out);
  Put(uint8_t(3), big, &out);
  for (uint32_t v : {0u, 1u, 2u}) Put(v, big, &out);
  return out;
}

// A header's lines end as its first one does: what follows `ply`. A body may begin with any byte.
TEST(PlyFileTest, HeadersEndTheirLinesAsTheFirstOneDoes) {
  for (const std::string first : {"\x0A", "\x0D"}) {
    for (const std::string end : {"\n", "\r\n", "\r", "\n\r"}) {
      for (const std::string blanks : {"", " ", "\t "}) {
        for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
          std::string header = mark;
          for (const char* line :
               {"ply", "format binary_little_endian 1.0", "comment a", "element vertex 3",
                "property uchar x", "property uchar y", "property uchar z", "element face 1",
                "property list uchar uchar vertex_indices", "end_header"}) {
            header += line + blanks + end;
          }
          const std::string body = first + std::string("\0\0\1\0\0\0\1\0\3\0\1\2", 12);
          const auto shape = Read(header + body);
          ASSERT_TRUE(shape) << shape.error().ToString();
          EXPECT_EQ(shape->mesh.points[0], Vec3(first[0], 0, 0));
        }
      }
    }
  }
}

TEST(PlyFileTest, AsciiWithOddLineEnds) {
  for (const std::string end : {"\r", "\r\n", "\n\r", " \n"}) {
    std::string text = "\xEF\xBB\xBF";
    for (const char* c = kAscii; *c != '\0'; ++c) text += *c == '\n' ? end : std::string(1, *c);
    EXPECT_EQ(Read(text).value().mesh.points.size(), 4u);
  }
  // A header of Unix with a line of Windows, as editors leave them.
  std::string mixed = kAscii;
  mixed.replace(mixed.find("comment by hand\n"), 16, "comment by hand\r\n");
  EXPECT_EQ(Read(mixed).value().mesh.points.size(), 4u);
  EXPECT_FALSE(Read("plywood\nformat ascii 1.0\n"));
}

TEST(PlyFileTest, BothByteOrders) {
  for (bool big : {false, true}) {
    const ShapeFile shape = Read(Binary(big)).value();
    ASSERT_EQ(shape.mesh.points.size(), 3u);
    EXPECT_EQ(shape.mesh.points[2], Vec3(2.5, 4.1, -2));
    EXPECT_EQ(shape.mesh.face_vertex, (std::vector<uint32_t>{0, 1, 2}));
  }
}

TEST(PlyFileTest, EveryTruncationOfABinaryFileIsAnError) {
  const std::string bytes = Binary(false);
  for (size_t n = 0; n < bytes.size(); ++n) {
    EXPECT_FALSE(ReadShape(std::string_view(bytes).substr(0, n), "a.ply")) << n;
  }
}

TEST(PlyFileTest, CountsThatLieAreSeenBeforeMemoryIsTaken) {
  ExpectError(Read(Binary(false, 4'000'000'000u)), "a.ply:10:1",
              "counts 4000000000 of element face");
  std::string text = kAscii;
  text.replace(text.find("vertex 4"), 8, "vertex 15999999");
  ExpectError(Read(text), "a.ply:4:1", "counts 15999999 of element vertex");
}

TEST(PlyFileTest, EdgesBecomeCurves) {
  const ShapeFile shape =
      Read(
          "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\n"
          "property double z\nelement edge 4\nproperty int vertex1\nproperty int vertex2\n"
          "end_header\n0 0 0\n1 0 0\n1 1 0\n7 7 7\n8 8 8\n0 1\n1 2\n2 0\n3 4\n")
          .value();
  ASSERT_EQ(shape.curves.size(), 2u);
  EXPECT_TRUE(shape.curves[0].closed);
  EXPECT_EQ(shape.curves[0].points.size(), 3u);
  EXPECT_FALSE(shape.curves[1].closed);
  EXPECT_EQ(shape.curves[1].points, (std::vector<Vec3>{Vec3(7), Vec3(8)}));
}

TEST(PlyFileTest, EveryFaultIsNamedWithItsPlace) {
  const std::string good = kAscii;
  const auto with = [&good](const std::string& old, const std::string& now) {
    std::string text = good;
    text.replace(text.find(old), old.size(), now);
    return text;
  };
  struct Case {
    std::string text;
    const char* place;
    const char* words;
  };
  const Case cases[] = {
      {"ply\nformat ascii 1.0\n", "a.ply:2", "no end_header"},
      {"ply\nend_header\n", "a.ply:2:1", "no line `format"},
      {with("ascii 1.0", "ebcdic 1.0"), "a.ply:2:8", "not 'ebcdic'"},
      {with("ascii 1.0", "ascii 2.0"), "a.ply:2:14", "version 1.0"},
      {with("element vertex 4", "element vertex -4"), "a.ply:4:16", "0 or more"},
      {with("element vertex 4", "element vertex 17000000"), "a.ply:4:1", "bytes are left"},
      {with("property float x", "property quux x"), "a.ply:5:10", "'quux' is no type"},
      {with("property float x", "property float q"), "a.ply:4:1", "x, y and z"},
      {with("list uchar int", "list float int"), "a.ply:12:15", "whole-number type"},
      {with("vertex_indices", "something"), "a.ply:11:1", "vertex_indices"},
      {with("comment by hand", "remark by hand"), "a.ply:3:1", "'remark' is no line"},
      {with("1 0 0 0 255 0", "1 nan 0 0 255 0"), "a.ply:15",
       "vertex 2: a coordinate is not finite"},
      {with("1 0 0 0 255 0", "1 0 0 0 256 0"), "a.ply:15", "not within 0 to 255"},
      {with("1 0 0 0 255 0", "1 0 0 0 nan 0"), "a.ply:15", "not within 0 to 255"},
      {with("1 0 0 0 255 0", "1 0 x 0 255 0"), "a.ply:15", "'x' is not a number"},
      {with("3 0 2 3\n", "3 0 2 3 9\n"), "a.ply:19:9", "more numbers"},
      {with("3 0 1 2", "nan 0 1 2"), "a.ply:18", "negative or absurd"},
      {with("3 0 1 2", "3 0 1 4"), "a.ply:18", "face 1: names vertex 4"},
      {with("3 0 1 2", "3 0 1 -1"), "a.ply:18", "names vertex -1"},
      {with("3 0 1 2", "3 0 1 1.5"), "a.ply:18", "not whole"},
      {with("3 0 1 2", "2 0 1"), "a.ply:18", "has 2 vertices"},
      {with("3 0 1 2", "-3 0 1 2"), "a.ply:18", "negative or absurd"},
      {with("3 0 2 3\n", ""), "a.ply:18", "the file ends here"},
      {good + "3 0 1 2\n", "a.ply:20:1", "more numbers"},
      {with("element face 2", "element tristrips 2"), "a.ply:11:1", "strips are not read"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.words);
    ExpectError(Read(c.text), c.place, c.words);
  }
}

const char* const kTriangle =
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

std::string Vertices(const std::string& more, const std::string& rows) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\n" +
         more + kTriangle + rows;
}

TEST(PlyFileTest, AsciiIsReadByNumbersNotByLines) {
  const std::vector<Vec3> points = {Vec3(0), Vec3(1, 0, 0), Vec3(1, 1, 0)};
  for (const char* rows : {"0 0 0 1 0 0 1 1 0\n3 0 1 2\n", "0 0 0 1\n\n0 0\n1 1 0 3 0\n1\n2",
                           "0\n0\n0\n1\n0\n0\n1\n1\n0\n3\n0\n1\n2\n"}) {
    SCOPED_TRACE(rows);
    const ShapeFile shape = Read(Vertices("", rows)).value();
    EXPECT_EQ(shape.mesh.points, points);
    EXPECT_EQ(shape.mesh.face_vertex, (std::vector<uint32_t>{0, 1, 2}));
  }
}

TEST(PlyFileTest, WhatIsNotUsedMayHoldAnything) {
  for (const char* odd : {"nan", "-nan(ind)", "1.#QNAN", "-inf", "1700000000000000001", "1e400"}) {
    SCOPED_TRACE(odd);
    const std::string o = odd;
    const auto shape = Read(Vertices(
        "property double time\nproperty list uchar float more\n",
        "0 0 0 " + o + " 1 " + o + "\n1 0 0 " + o + " 0\n1 1 0 0 2 " + o + " 7\n3 0 1 2\n"));
    ASSERT_TRUE(shape) << shape.error().message;
    EXPECT_EQ(shape->mesh.points[2], Vec3(1, 1, 0));
  }
}

TEST(PlyFileTest, ColoursAreScaledByTheirType) {
  for (const auto& [type, full] :
       std::vector<std::pair<std::string, std::string>>{{"uchar", "255"},
                                                        {"short", "255"},
                                                        {"ushort", "65535"},
                                                        {"int", "255"},
                                                        {"uint32", "255"},
                                                        {"float", "1"},
                                                        {"double", "1"}}) {
    SCOPED_TRACE(type);
    const std::string properties =
        "property " + type + " red\nproperty " + type + " green\nproperty " + type + " blue\n";
    const auto rows = [](const std::string& value) {
      return "0 0 0 " + value + " 0 0\n1 0 0 0 " + value + " 0\n1 1 0 0 0 " + value + "\n3 0 1 2\n";
    };
    const ShapeFile shape = Read(Vertices(properties, rows(full))).value();
    EXPECT_EQ(shape.mesh.colors, (std::vector<Rgb>{Rgb(1, 0, 0), Rgb(0, 1, 0), Rgb(0, 0, 1)}));
    ExpectError(Read(Vertices(properties, rows(full + "1"))), "a.ply:13", "a colour is not within");
  }
}

TEST(PlyFileTest, NotFiniteBinaryCoordinatesAreRefused) {
  std::string bytes = Binary(false);
  const size_t body = bytes.find("end_header\n") + 11;
  const float inf = std::numeric_limits<float>::infinity();
  std::memcpy(bytes.data() + body, &inf, sizeof(inf));
  ExpectError(Read(bytes), "a.ply", "vertex 1: a coordinate is not finite");
}

TEST(PlyFileTest, ByteColoursStayBytes) {
  const ShapeFile shape = Read(kAscii).value();
  const std::string bytes = WriteShape(shape, ShapeFormat::kPly, {"seed 7"}).value();
  EXPECT_NE(bytes.find("property uchar red"), std::string::npos);
  EXPECT_NE(bytes.find("\ncomment seed 7\n"), std::string::npos);
  EXPECT_EQ(Read(bytes).value().mesh.colors, shape.mesh.colors);
}

}  // namespace
}  // namespace fjord
