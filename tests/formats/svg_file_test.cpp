#include <gtest/gtest.h>

#include <cmath>

#include "engine/formats/shape_file.h"
#include "engine/geometry/edges.h"
#include "tests/formats/expect_error.h"

namespace fjord {
namespace {

Result<ShapeFile> Read(const std::string& text) { return ReadShape(text, "a.svg"); }

// The curves of one path.
std::vector<Polyline> Path(const std::string& d) {
  auto shape = Read("<svg><path d=\"" + d + "\"/></svg>");
  if (!shape) ADD_FAILURE() << shape.error().ToString();
  return shape ? shape->curves : std::vector<Polyline>{};
}

using Points = std::vector<Vec3>;

TEST(SvgFileTest, StraightCommandsAndTheirRelativeForms) {
  const Points square = {{0, 0, 0}, {2, 0, 0}, {2, -2, 0}, {0, -2, 0}};  // y is turned up
  for (const char* d :
       {"M0 0 L2 0 L2 2 L0 2 Z", "m0,0 2,0 0,2 -2,0z", "M0 0H2V2H0Z", "M0 0h2v2h-2z",
        "M0 0 2 0 2 2 0 2 0 0Z", "M 0-0L2 0 2 2l-2 0Z", "\n M 0 , 0 \t h+2v2H0 z "}) {
    const auto curves = Path(d);
    ASSERT_EQ(curves.size(), 1u) << d;
    EXPECT_TRUE(curves[0].closed);
    EXPECT_EQ(curves[0].points, square) << d;
  }
}

TEST(SvgFileTest, NumbersMayTouch) {
  EXPECT_EQ(Path("M1-2L.5.5-1e1.5")[0].points, (Points{{1, 2, 0}, {.5, -.5, 0}, {-10, -.5, 0}}));
}

TEST(SvgFileTest, SubpathsAreCurvesOfTheirOwn) {
  const auto curves = Path("M0 0H1M5 5h1v1zl3 0m1 1l1 0M9 9");
  ASSERT_EQ(curves.size(), 4u);
  EXPECT_FALSE(curves[0].closed);
  EXPECT_TRUE(curves[1].closed);
  EXPECT_EQ(curves[2].points, (Points{{5, -5, 0}, {8, -5, 0}}));  // goes on where the z came home
  EXPECT_EQ(curves[3].points, (Points{{9, -6, 0}, {10, -6, 0}}));
}

// The usual four-Bezier circle: every point lies on the radius within its known 2.7e-4.
TEST(SvgFileTest, CurvesAreFlattenedFinely) {
  const auto curves = Path(
      "M1 0C1 .5522847 .5522847 1 0 1c-.5522847 0 -1 -.4477153 -1 -1"
      "S-.5522847 -1 0 -1 S1-.5522847 1 0z");
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_GT(curves[0].points.size(), 60u);
  EXPECT_LT(curves[0].points.size(), 600u);
  double length = 0;
  for (size_t i = 0; i < curves[0].points.size(); ++i) {
    const Vec3 p = curves[0].points[i];
    EXPECT_NEAR(Length(p), 1, 3e-4);
    length += Length(p - curves[0].points[(i + 1) % curves[0].points.size()]);
  }
  EXPECT_NEAR(length, 2 * 3.14159265, 3e-3);
}

TEST(SvgFileTest, QuadraticsAndTheirSmoothForm) {
  const auto curves = Path("M0 0Q1 2 2 0T4 0");
  for (const Vec3& p : curves[0].points) {
    const double t = p.x <= 2 ? p.x / 2 : (p.x - 2) / 2;
    EXPECT_NEAR(p.y, (p.x <= 2 ? -1 : 1) * 4 * t * (1 - t), 1e-12);
  }
  EXPECT_EQ(curves[0].points.back(), Vec3(4, 0, 0));
}

TEST(SvgFileTest, WhatIsHiddenIsNotDrawn) {
  const std::string seen = "<path d='M0 0H10V10'/>";
  for (const char* hidden :
       {"<path style='display:none' d='M0 0H50V50'/>", "<path display='none' d='M0 0H50V50'/>",
        "<path visibility='hidden' d='M0 0H50V50'/>",
        "<g style='fill:red; Display : NONE !important;'><path display='inline' d='M0 0H5'/></g>",
        "<g visibility='collapse'><g><path d='M0 0H50'/></g></g>",
        "<path display='inline' style='display:inline;display:none' d='M0 0H50'/>",
        "<g display='none'><rect/><svg width='1'><path d='M0 0H50'/></svg></g>"}) {
    const auto shape = Read("<svg>" + std::string(hidden) + seen + "</svg>");
    ASSERT_TRUE(shape) << hidden << shape.error().ToString();
    ASSERT_EQ(shape->curves.size(), 1u) << hidden;
    EXPECT_EQ(shape->curves[0].points[1], Vec3(10, 0, 0)) << hidden;
  }
  // Visibility is inherited, but what is inside may say otherwise; style wins over the attribute.
  EXPECT_TRUE(
      Read("<svg><g visibility='hidden'><path visibility='visible' d='M0 0H1'/></g></svg>"));
  EXPECT_TRUE(Read("<svg><path display='none' style='display:inline' d='M0 0H1'/></svg>"));
}

TEST(SvgFileTest, DrawingsThatOtherProgramsSaved) {
  const auto first = [](const std::string& name) {
    const ShapeFile shape = Read(ReadTestFile("tests/fuzz/corpus/shape/" + name)).value();
    EXPECT_EQ(shape.curves.size(), 1u) << name;
    return shape.curves[0].points;
  };
  const Points seen = {{0, 0, 0}, {10, 0, 0}, {10, -10, 0}};
  EXPECT_EQ(first("hidden_layers.svg"), seen);
  EXPECT_EQ(first("hidden_path.svg"), seen);
  const Points line = first("line_units.svg");
  EXPECT_NEAR(line[0].x, 37.7953, 1e-4);
  EXPECT_NEAR(line[1].x, 96, 1e-9);
  EXPECT_NEAR(line[1].y, -75.5906, 1e-4);
}

TEST(SvgFileTest, LengthsHaveUnits) {
  const auto line = [](const std::string& x) {
    return Read("<svg>\n<line x1='" + x + "' x2='1e3' y2='1'/></svg>");
  };
  const std::pair<const char*, double> cases[] = {{"10mm", 10 * 96 / 25.4},
                                                  {"1in", 96},
                                                  {"2cm", 2 * 96 / 2.54},
                                                  {"3pt", 4},
                                                  {"1pc", 16},
                                                  {"40Q", 96 / 2.54},
                                                  {"7px", 7},
                                                  {" 7 ", 7}};
  for (const auto& [text, pixels] : cases) {
    EXPECT_NEAR(line(text).value().curves[0].points[0].x, pixels, 1e-12) << text;
  }
  for (const char* text : {"1em", "2ex", "1furlong"}) {
    ExpectError(line(text), "a.svg:2:12", "a length is in px");
  }
  ExpectError(line("50%"), "a.svg:2:13", "give the outer <svg> a viewBox");
  ExpectError(line("1 2"), "a.svg:2:13", "one length is wanted");
}

TEST(SvgFileTest, ListsAndLines) {
  const ShapeFile shape =
      Read(
          "<svg><polyline points=\"0,0 1,0 1,1\"/><polygon points='0 0 1 0 1 1'/>"
          "<line x1='1' y1='2' x2='3px' y2='4'/></svg>")
          .value();
  ASSERT_EQ(shape.curves.size(), 3u);
  EXPECT_FALSE(shape.curves[0].closed);
  EXPECT_TRUE(shape.curves[1].closed);
  EXPECT_EQ(shape.curves[2].points, (Points{{1, -2, 0}, {3, -4, 0}}));
}

TEST(SvgFileTest, TransformsOfGroupsApply) {
  const ShapeFile shape =
      Read(
          "<svg><g transform='translate(10 20)'><g transform='scale(2)'>"
          "<path transform='matrix(1 0 0 1 1 1)' d='M0 0L1 0'/></g></g>"
          "<path transform='rotate(90)' d='M0 0L1 0'/><path d='M0 0L1 0'/></svg>")
          .value();
  EXPECT_EQ(shape.curves[0].points, (Points{{12, -22, 0}, {14, -22, 0}}));
  EXPECT_NEAR(shape.curves[1].points[1].y, -1, 1e-15);
  EXPECT_EQ(shape.curves[2].points, (Points{{0, 0, 0}, {1, 0, 0}}));
}

TEST(SvgFileTest, WhatIsNotDrawnIsPassedOver) {
  const ShapeFile shape = Read(
                              "<?xml version='1.0'?>\n<!DOCTYPE svg [<!ENTITY a 'b>'>]>\n"
                              "<svg:svg xmlns:svg='http://www.w3.org/2000/svg'><!-- <path d='M0 "
                              "0L9 9'/> --><defs><path d='M0 0L9 9'/>"
                              "</defs><text>a &lt; b</text><![CDATA[<path>]]>"
                              "<svg:path d='M0 0L1 1'/></svg:svg>")
                              .value();
  ASSERT_EQ(shape.curves.size(), 1u);
  EXPECT_EQ(shape.curves[0].points[1], Vec3(1, -1, 0));
}

TEST(SvgFileTest, EveryFaultIsNamedWithItsPlace) {
  struct Case {
    const char* text;
    const char* place;
    const char* words;
  };
  const Case cases[] = {
      {"<html></html>", "a.svg:1:1", "no <svg>"},
      {"<svg></svg>", "a.svg:1:1", "nothing of the drawing is a curve"},
      {"<svg xmlns='http://example.com/'/>", "a.svg:1:1", "no <svg>"},
      {"<svg>\n<path d=\"M0 0 L1\"/></svg>", "a.svg:2:17", "a number is missing"},
      {"<svg>\n<path d=\"M0 0\nL1 x\"/></svg>", "a.svg:3:4", "'x' is not a number"},
      {"<svg><path d=\"L1 1\"/></svg>", "a.svg:1:15", "starts with M"},
      {"<svg><path d=\"M0 0A1 1 0 2 0 2 2\"/></svg>", "a.svg:1:26", "a flag of an arc is 0 or 1"},
      {"<svg><path d=\"M0 0A1 1 0 .5 0 2 2\"/></svg>", "a.svg:1:26", "a flag of an arc is 0 or 1"},
      {"<svg><path d=\"M0 0A1 1 0 10\"/></svg>", "a.svg:1:28", "a number is missing"},
      {"<svg><path d=\"M0 0 K1 1\"/></svg>", "a.svg:1:20", "'K' is no path command"},
      {"<svg><path d=\"M0 0 L1e308 1\"/></svg>", "a.svg:1:21", "too large"},
      {"<svg><path d=\"M0 0 Lnan 1\"/></svg>", "a.svg:1:21", "a number is missing"},
      {"<svg>\n<circle r='-1'/></svg>", "a.svg:2:1", "r is negative"},
      {"<svg>\n<rect width='1' height='&#45;1' /></svg>", "a.svg:2:1", "height is negative"},
      {"<svg><path transform='twist(3)' d='M0 0L1 1'/></svg>", "a.svg:1:30", "no transform"},
      {"<svg><g transform='scale(1e15)'><path transform='scale(1e15)' d='M0 0L1 1'/></g></svg>",
       "a.svg:1:33", "beyond 1e15"},
      {"<svg><path d=\"M0 0L1 1\"/>", "a.svg:1:26", "ends inside <svg>; it is cut short"},
      {"<svg><path d=\"M0 0L1 1\"", "a.svg:1:6", "cut short"},
      {"<svg><path d=\"M0 0L1 1", "a.svg:1:6", "cut short"},
      {"<svg><path d=M0/></svg>", "a.svg:1:14", "no good XML"},
      {"<svg></svg></svg>", "a.svg:1:13", "no good XML"},
      {"<svg>\n<g>\n</svg>", "a.svg:3:3", "does not belong to <g> of line 2"},
      {"<svg><!-- ", "a.svg:1:6", "cut short"},
      {"<svg>< path/></svg>", "a.svg:1:7", "no good XML"},
      {"<svg><path d='' d=''/></svg>", "a.svg:1:17", "duplicate attribute"},
      {"<svg><path d='&nothing;'/></svg>", "a.svg:1:6", "undefined entity"},
      {"<svg><path a:b=''/></svg>", "a.svg:1:6", "xmlns:PREFIX"},
      {"<svg><!-- \xE9 --></svg>", "a.svg:1:11", "save as UTF-8"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    ExpectError(Read(c.text), c.place, c.words);
  }
  std::string deep;
  for (int i = 0; i < 100; ++i) deep += "<svg>";
  ExpectError(Read(deep), "a.svg:1:321", "64 elements");
}

TEST(SvgFileTest, AMeshIsWrittenAsItsEdges) {
  const ShapeFile mesh =
      ReadShape("data 4 2\n0 0 0\n1 0 0\n1 1 5\n0 1 0\n3 1 2 3\n3 1 3 4\n", "a").value();
  const std::string text = WriteShape(mesh, ShapeFormat::kSvg, {"seed 7 -- of --> it"}).value();
  EXPECT_NE(text.find("<!-- seed 7 - - of - -> it -->"), std::string::npos);
  const ShapeFile back = Read(text).value();
  const EdgeTable edges(mesh.mesh);
  ASSERT_EQ(back.curves.size(), edges.edges().size());
  for (size_t e = 0; e < back.curves.size(); ++e) {
    EXPECT_EQ(back.curves[e].points[0].y, mesh.mesh.points[edges.edges()[e].a].y);
    EXPECT_EQ(back.curves[e].points[1].x, mesh.mesh.points[edges.edges()[e].b].x);
  }
}

}  // namespace
}  // namespace fjord
