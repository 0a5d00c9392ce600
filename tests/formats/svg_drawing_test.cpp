// What of a .svg file is drawn, and where: viewports, units, transforms, shapes, arcs, <use>.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/formats/limits.h"
#include "engine/formats/shape_file.h"
#include "tests/formats/expect_error.h"

namespace fjord {
namespace {

using Points = std::vector<Vec3>;

Result<ShapeFile> Read(const std::string& text) { return ReadShape(text, "a.svg"); }

std::vector<Polyline> Curves(const std::string& text) {
  auto shape = Read(text);
  if (!shape) ADD_FAILURE() << text << "\n" << shape.error().ToString();
  return shape ? shape->curves : std::vector<Polyline>{};
}

// The one curve of a drawing of 200 by 100.
Polyline Curve(const std::string& inside) {
  const auto curves = Curves("<svg viewBox='0 0 200 100'>" + inside + "</svg>");
  EXPECT_EQ(curves.size(), 1u) << inside;
  return curves.empty() ? Polyline{} : curves[0];
}

void ExpectNear(const Points& points, const Points& wanted) {
  ASSERT_EQ(points.size(), wanted.size());
  for (size_t k = 0; k < points.size(); ++k) {
    EXPECT_LT(Length(points[k] - wanted[k]), 1e-9)
        << k << ": " << points[k].x << " " << points[k].y;
  }
}

double LengthOf(const Polyline& curve) {
  double length = 0;
  for (size_t k = 1; k < curve.points.size(); ++k) {
    length += Length(curve.points[k] - curve.points[k - 1]);
  }
  return length + (curve.closed ? Length(curve.points.front() - curve.points.back()) : 0);
}

bool Passes(const Polyline& curve, const Vec3& place) {
  for (const Vec3& p : curve.points) {
    if (Length(p - place) < 1e-9) return true;
  }
  return false;
}

TEST(SvgDrawingTest, DrawingsThatOtherProgramsSaved) {
  const auto shape = [](const std::string& name) {
    return Read(ReadTestFile("tests/fuzz/corpus/shape/" + name)).value();
  };
  ExpectNear(shape("nested.svg").curves[0].points,
             {{100, -200, 0}, {400, -200, 0}, {400, -500, 0}});
  ExpectNear(shape("entities.svg").curves[0].points, {{5, -5, 0}, {15, -5, 0}, {15, -15, 0}});
  ExpectNear(shape("references.svg").curves[0].points, {{0, 0, 0}, {10, 0, 0}, {10, -10, 0}});
  const Polyline arc = shape("arc.svg").curves[0];
  EXPECT_NEAR(LengthOf(arc), 5 * 3.14159265, 1e-3);
  EXPECT_TRUE(Passes(arc, {5, 5, 0}));
  EXPECT_EQ(arc.points.back(), Vec3(10, 0, 0));
  const Polyline packed = shape("packed_arc.svg").curves[0];
  EXPECT_TRUE(packed.closed);
  EXPECT_EQ(packed.points.back(), Vec3(50, 25, 0));
}

TEST(SvgDrawingTest, NestedViewportsFitTheirViewBox) {
  const auto nested = [](const std::string& attributes) {
    return Curve("<svg " + attributes + "><path d='M0 0L10 0'/></svg>").points;
  };
  ExpectNear(nested("x='5' y='7'"), {{5, -7, 0}, {15, -7, 0}});
  ExpectNear(nested("x='10%' y='10%'"), {{20, -10, 0}, {30, -10, 0}});
  // Sides that are not given are the whole of what is around: 200 by 100.
  ExpectNear(nested("viewBox='0 0 20 10'"), {{0, 0, 0}, {100, 0, 0}});
  ExpectNear(nested("viewBox='0 0 10 10' width='20'"), {{0, -40, 0}, {20, -40, 0}});
  ExpectNear(nested("viewBox='-10 -10 20 20' width='40' height='40'"),
             {{20, -20, 0}, {40, -20, 0}});
  const std::string tall = "viewBox='0 0 10 10' width='20' height='60' preserveAspectRatio=";
  ExpectNear(nested(tall + "'none'"), {{0, 0, 0}, {20, 0, 0}});
  ExpectNear(nested(tall + "'xMidYMid'"), {{0, -20, 0}, {20, -20, 0}});
  ExpectNear(nested(tall + "'xMinYMin meet'"), {{0, 0, 0}, {20, 0, 0}});
  ExpectNear(nested(tall + "'xMaxYMax'"), {{0, -40, 0}, {20, -40, 0}});
  ExpectNear(nested(tall + "'xMidYMid slice'"), {{-20, 0, 0}, {40, 0, 0}});
  ExpectNear(nested(tall + "'xMaxYMin slice'"), {{-40, 0, 0}, {20, 0, 0}});
  ExpectNear(nested("width='40mm' height='1in' viewBox='0 0 40 40' preserveAspectRatio='xMinYMin'"),
             {{0, 0, 0}, {24, 0, 0}});
  // Per cents inside are of the view box, and viewports nest.
  ExpectNear(Curve("<svg x='10' width='100' height='100' viewBox='0 0 50 50'><svg x='50%' "
                   "width='50%' height='50%' viewBox='0 0 5 5'><path d='M0 0H5'/></svg></svg>")
                 .points,
             {{60, 0, 0}, {110, 0, 0}});
}

TEST(SvgDrawingTest, ViewportsOfNoSizeDrawNothing) {
  for (const char* attributes : {"width='0'", "height='0'", "viewBox='0 0 0 5'"}) {
    Curve("<svg " + std::string(attributes) + "><path d='M0 0H9'/></svg><path d='M0 0H1'/>");
  }
  ExpectError(Read("<svg viewBox='0 0 9 9'>\n<svg width='-1'/></svg>"), "a.svg:2:1", "negative");
  ExpectError(Read("<svg>\n<svg viewBox='0 0 -1 1'/></svg>"), "a.svg:2:23", "negative size");
  ExpectError(Read("<svg>\n<svg viewBox='0 0 1'/></svg>"), "a.svg:2:20", "a number is missing");
  ExpectError(Read("<svg>\n<svg viewBox='0 0 1 1'/></svg>"), "a.svg:2:1", "needs width and height");
  ExpectError(
      Read("<svg viewBox='0 0 9 9'>\n<svg viewBox='0 0 1 1' preserveAspectRatio='xMid'/></svg>"),
      "a.svg:2:45", "preserveAspectRatio is");
}

TEST(SvgDrawingTest, TheOuterViewportBendsNothing) {
  for (const char* outer : {"<svg x='5' y='9' width='40mm' height='10' viewBox='0 0 4 4'>",
                            "<svg width='100%' height='100%'>", "<svg viewBox='5 5 1 1'>",
                            "<svg width='10em' height='-1'>", "<svg viewBox='0 0 100px 50px'>"}) {
    ExpectNear(Curves(outer + std::string("<path d='M0 0H1'/></svg>"))[0].points,
               {{0, 0, 0}, {1, 0, 0}});
  }
  ExpectNear(Curves("<svg width='50' height='80'><line x2='50%' y2='50%'/></svg>")[0].points,
             {{0, 0, 0}, {25, -40, 0}});
}

TEST(SvgDrawingTest, PerCentsInEveryLength) {
  ExpectNear(Curve("<line x1='10%' y1='10%' x2='50%' y2='100%'/>").points,
             {{20, -10, 0}, {100, -100, 0}});
  ExpectNear(Curve("<rect x='25%' y='50%' width='10%' height='10%'/>").points,
             {{50, -50, 0}, {70, -50, 0}, {70, -60, 0}, {50, -60, 0}});
  const double both = std::sqrt((200. * 200 + 100 * 100) / 2);
  EXPECT_NEAR(Curve("<circle r='10%'/>").points[0].x, both / 10, 1e-12);
  EXPECT_NEAR(Curve("<ellipse cx='50%' rx='10%' ry='1in'/>").points[0].x, 120, 1e-12);
  ExpectNear(Curve("<g transform='translate(10% 10%)'><path d='M0 0H1'/></g>").points,
             {{20, -10, 0}, {21, -10, 0}});
}

TEST(SvgDrawingTest, ShapesAreDrawnAsTheyStand) {
  const Polyline circle = Curve("<circle cx='10' cy='20' r='5'/>");
  EXPECT_TRUE(circle.closed);
  for (const Vec3& p : circle.points) EXPECT_NEAR(Length(p - Vec3(10, -20, 0)), 5, 1e-12);
  for (const Vec3& p : Points{{15, -20, 0}, {10, -25, 0}, {5, -20, 0}, {10, -15, 0}}) {
    EXPECT_TRUE(Passes(circle, p));
  }
  EXPECT_NEAR(LengthOf(circle), 10 * 3.14159265, 1e-2);
  const Polyline ellipse = Curve("<ellipse rx='4' ry='2' />");
  for (const Vec3& p : ellipse.points) EXPECT_NEAR(p.x * p.x / 16 + p.y * p.y / 4, 1, 1e-12);
  const Polyline round = Curve("<rect width='10' height='6' rx='2'/>");
  EXPECT_EQ(round.points[0], Vec3(2, 0, 0));
  EXPECT_EQ(round.points[1], Vec3(8, 0, 0));
  for (const Vec3& p : Points{{10, -2, 0}, {10, -4, 0}, {8, -6, 0}, {2, -6, 0}, {0, -4, 0}}) {
    EXPECT_TRUE(Passes(round, p));
  }
  EXPECT_NEAR(LengthOf(round), 2 * 6 + 2 * 2 + 4 * 3.14159265, 1e-2);
  // Radii are at most half a side: a pill, of two half circles.
  EXPECT_NEAR(LengthOf(Curve("<rect width='10' height='6' rx='9' ry='9'/>")),
              LengthOf(Curve("<ellipse rx='5' ry='3'/>")), 1e-9);
  EXPECT_EQ(Curve("<rect width='10' height='6' rx='auto' ry='0'/>").points.size(), 4u);
}

TEST(SvgDrawingTest, ShapesOfNoSizeDrawNothing) {
  for (const char* none : {"<circle r='0'/>", "<circle/>", "<ellipse rx='3' ry='0'/>", "<rect/>",
                           "<rect width='5'/>", "<rect width='5' height='0'/>"}) {
    Curve(none + std::string("<path d='M0 0H1'/>"));
  }
}

// All four arcs between two points, as the specification draws them.
TEST(SvgDrawingTest, ArcsGoTheWayTheirFlagsSay) {
  struct Case {
    const char* flags;
    double length;  // of the quarter or the three quarters
    Vec3 middle;
  };
  const double r = 10, diagonal = r * std::sqrt(.5);
  const Case cases[] = {{"0 0", .25, {10 - diagonal, -10 + diagonal, 0}},
                        {"0 1", .25, {diagonal, -diagonal, 0}},
                        {"1 0", .75, {-diagonal, -10 - diagonal, 0}},
                        {"1 1", .75, {10 + diagonal, diagonal, 0}}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.flags);
    const Polyline arc = Curve("<path d='M0 10A10 10 0 " + std::string(c.flags) + " 10 0'/>");
    EXPECT_NEAR(LengthOf(arc), c.length * 2 * 3.14159265 * r, 1e-2);
    EXPECT_EQ(arc.points.front(), Vec3(0, -10, 0));
    EXPECT_EQ(arc.points.back(), Vec3(10, 0, 0));
  }
}

TEST(SvgDrawingTest, FlagsOfArcsMayTouch) {
  const Polyline wanted = Curve("<path d='M0 0 a 1 1 0 0 0 1 1 a 1 1 0 0 1 1 1'/>");
  for (const char* d : {"M0 0a1 1 0 001 1 1 1 0 011 1", "m0 0a1,1,0,0,0,1,1a1,1 0,01,1,1",
                        "M0 0a1 1 0 0 01 1A1 1 0 012 2", "M0 0a1 1 0 00.1e1 1a1 1 0 01+1+1"}) {
    SCOPED_TRACE(d);
    EXPECT_EQ(Curve("<path d='" + std::string(d) + "'/>").points, wanted.points);
  }
}

TEST(SvgDrawingTest, ArcsAtTheirLimits) {
  // Radii that are too small grow; without a radius, or of endless ones, the way is straight.
  EXPECT_NEAR(LengthOf(Curve("<path d='M0 0A1 1 0 0 1 10 0'/>")), 5 * 3.14159265, 1e-3);
  EXPECT_NEAR(LengthOf(Curve("<path d='M0 0A-5 -5 0 0 1 10 0'/>")), 5 * 3.14159265, 1e-3);
  ExpectNear(Curve("<path d='M0 0A0 5 0 0 1 10 0'/>").points, {{0, 0, 0}, {10, 0, 0}});
  ExpectNear(Curve("<path d='M0 0A1e14 1e14 0 0 1 10 0'/>").points, {{0, 0, 0}, {10, 0, 0}});
  // From a point to itself there is no arc.
  ExpectNear(Curve("<path d='M0 0A5 5 0 1 1 0 0L1 0'/>").points, {{0, 0, 0}, {1, 0, 0}});
  // All but the whole of a circle, and all but none of it.
  EXPECT_NEAR(LengthOf(Curve("<path d='M0 0A5 5 0 1 1 0 1e-9'/>")), 10 * 3.14159265, 1e-2);
  EXPECT_NEAR(LengthOf(Curve("<path d='M0 0A5 5 0 0 1 0 1e-9'/>")), 0, 1e-6);
}

// A turned ellipse: every point keeps to its equation.
TEST(SvgDrawingTest, ArcsOfTurnedEllipses) {
  const Polyline arc = Curve("<path d='M10 0A20 5 90 0 1 10 40A20 5 450 0 1 10 0z'/>");
  for (const Vec3& p : arc.points) {
    const double x = (p.x - 10) / 5, y = (p.y + 20) / 20;
    EXPECT_NEAR(x * x + y * y, 1, 1e-9);
  }
  EXPECT_TRUE(Passes(arc, {15, -20, 0}));
  EXPECT_TRUE(Passes(arc, {5, -20, 0}));
  EXPECT_TRUE(arc.closed);
}

TEST(SvgDrawingTest, ArcsAreTransformedAsArcs) {
  const Polyline arc =
      Curve("<g transform='matrix(3 0 1 2 5 7)'><circle cx='1' cy='2' r='3'/></g>");
  for (const Vec3& p : arc.points) {
    const double v = (-p.y - 7) / 2, u = (p.x - 5 - v) / 3;
    EXPECT_NEAR((u - 1) * (u - 1) + (v - 2) * (v - 2), 9, 1e-9);
  }
}

// How finely curved pieces are cut follows from the drawing, not from the piece.
TEST(SvgDrawingTest, SmallPiecesOfALargeDrawingGetFewPoints) {
  const std::string bump = "<path d='M0 0c0 1 1 1 1 0'/><circle r='1'/>";
  const auto alone = Curves("<svg>" + bump + "</svg>");
  const auto among = Curves("<svg>" + bump + "<path d='M0 0H2000'/></svg>");
  EXPECT_GT(alone[0].points.size(), 20u);
  EXPECT_GT(alone[1].points.size(), 100u);
  EXPECT_LE(among[0].points.size(), 5u);
  EXPECT_LT(among[1].points.size(), 20u);
  // 1e-4 of 2000: a circle of radius 200 keeps within .2 of its curve, and needs no more.
  const auto large = Curves("<svg><circle r='200'/><path d='M0 0H2000'/></svg>")[0].points;
  double worst = 0;
  for (size_t k = 0; k < large.size(); ++k) {
    const Vec3 middle = (large[k] + large[(k + 1) % large.size()]) * .5;
    worst = std::max(worst, 200 - Length(middle));
  }
  EXPECT_LT(worst, .2);
  EXPECT_GT(worst, .02);
}

TEST(SvgDrawingTest, RelativeWaysHomeClose) {
  const Polyline square = Curve("<path d='m.1.1l.3.1-.1.3-.2-.4z'/>");
  EXPECT_TRUE(square.closed);
  EXPECT_EQ(square.points.size(), 3u);
}

TEST(SvgDrawingTest, TransformsHaveOriginsAndUnits) {
  const auto moved = [](const std::string& attributes) {
    return Curve("<path " + attributes + " d='M0 0H10'/>").points;
  };
  const std::string twice = "transform='scale(2)' transform-origin=";
  ExpectNear(moved(twice + "'10 20'"), {{-10, 20, 0}, {10, 20, 0}});
  ExpectNear(moved(twice + "'10px 1in'"), {{-10, 96, 0}, {10, 96, 0}});
  ExpectNear(moved(twice + "'50% 50%'"), {{-100, 50, 0}, {-80, 50, 0}});
  ExpectNear(moved(twice + "'center'"), {{-100, 50, 0}, {-80, 50, 0}});
  ExpectNear(moved(twice + "'bottom right'"), {{-200, 100, 0}, {-180, 100, 0}});
  ExpectNear(moved(twice + "'left 10'"), {{0, 10, 0}, {20, 10, 0}});
  ExpectNear(moved(twice + "'top'"), {{-100, 0, 0}, {-80, 0, 0}});
  ExpectNear(moved("style='transform-origin: 5px 0; transform: rotate(180deg)'"),
             {{10, 0, 0}, {0, 0, 0}});
  ExpectNear(moved("transform-origin='5 5'"), {{0, 0, 0}, {10, 0, 0}});
  ExpectNear(moved("style='transform: translate(10px, 1in) scaleX(2)'"),
             {{10, -96, 0}, {30, -96, 0}});
  ExpectNear(moved("transform='rotate(.25turn)'"), {{0, 0, 0}, {0, -10, 0}});
  ExpectNear(moved("transform='rotate(100grad)translateY(1)'"), {{-1, 0, 0}, {-1, -10, 0}});
  ExpectNear(moved("transform='none'"), {{0, 0, 0}, {10, 0, 0}});
  ExpectError(Read("<svg>\n<path transform='scale(2)' transform-origin='50% 0'/></svg>"),
              "a.svg:2:48", "viewBox");
  ExpectError(Read("<svg>\n<path transform='scale(2)' transform-origin='up'/></svg>"), "a.svg:2:46",
              "an origin is two lengths");
  ExpectError(Read("<svg>\n<path transform='rotate(1px)'/></svg>"), "a.svg:2:26", "an angle is");
  ExpectError(Read("<svg>\n<path style='transform: turn(1)'/></svg>"), "a.svg:2:1",
              "transform in a style: 'turn' with 1");
}

TEST(SvgDrawingTest, UseDrawsAgain) {
  const auto curves = Curves(
      "<svg xmlns='http://www.w3.org/2000/svg' xmlns:l='http://www.w3.org/1999/xlink'>"
      "<defs><g id='g' transform='scale(2)'><path d='M0 0H1'/></g></defs>"
      "<use href='#g' x='10' y='20'/><use l:href='#g' transform='translate(5)' x='1'/></svg>");
  ASSERT_EQ(curves.size(), 2u);
  ExpectNear(curves[0].points, {{10, -20, 0}, {12, -20, 0}});
  ExpectNear(curves[1].points, {{6, 0, 0}, {8, 0, 0}});
  ExpectNear(Curve("<use href='#s' width='20' height='20'/><symbol id='s' viewBox='0 0 10 10'>"
                   "<path d='M0 0H10'/></symbol>")
                 .points,
             {{0, 0, 0}, {20, 0, 0}});
  ExpectNear(Curve("<use href='#s' x='50%'/><symbol id='s' viewBox='0 0 10 10' width='20' "
                   "height='10'><path d='M0 0H10'/></symbol>")
                 .points,
             {{105, 0, 0}, {115, 0, 0}});
  // What is used may be hidden itself; the place of its use may be, too.
  Curve(
      "<path id='a' d='M0 0H1'/><use href='#a' display='none'/>"
      "<defs><path id='b' display='none' d='M0 0H2'/></defs><use href='#b'/>"
      "<use href='#a' visibility='hidden'/>");
}

TEST(SvgDrawingTest, UseThatCannotBeDrawnIsRefused) {
  ExpectError(Read("<svg>\n<use href='#x'/></svg>"), "a.svg:2:1", "no element's id");
  ExpectError(Read("<svg>\n<use href='b.svg#x'/></svg>"), "a.svg:2:1", "of this file");
  ExpectError(Read("<svg>\n<use/></svg>"), "a.svg:2:1", "of this file");
  ExpectError(Read("<svg>\n<g id='a'><use href='#a'/></g></svg>"), "a.svg:2:11", "uses itself");
  ExpectError(Read("<svg>\n<use id='a' href='#a'/></svg>"), "a.svg:2:1", "uses itself");
  ExpectError(
      Read("<svg><defs><g id='a'><use href='#b'/></g><g id='b'>\n<use href='#a'/></g></defs>"
           "<use href='#a'/></svg>"),
      "a.svg:2:1", "uses itself");
  std::string many = "<svg><defs><g id='n0'/>";
  for (int i = 1; i <= 12; ++i) {
    many += "<g id='n" + std::to_string(i) + "'>";
    for (int k = 0; k < 12; ++k) many += "<use href='#n" + std::to_string(i - 1) + "'/>";
    many += "</g>";
  }
  const auto bomb = Read(many + "</defs><use href='#n12'/></svg>");
  ASSERT_FALSE(bomb.ok());
  EXPECT_EQ(bomb.error().code, ErrorCode::kLimit);
}

TEST(SvgDrawingTest, OfASwitchTheFirstThatAppliesIsDrawn) {
  ExpectNear(Curve("<switch><foreignObject requiredExtensions='http://x'/>"
                   "<path systemLanguage='de, fr' d='M0 0H1'/>"
                   "<path systemLanguage='de, en-GB' d='M0 0H2'/><path d='M0 0H3'/></switch>")
                 .points,
             {{0, 0, 0}, {2, 0, 0}});
}

TEST(SvgDrawingTest, OnlyWhatSvgDrawsIsDrawn) {
  for (const char* none :
       {"<flowRoot><flowRegion><path d='M0 0H9'/></flowRegion></flowRoot>",
        "<x:path xmlns:x='http://example.com/' d='M0 0H9'/>",
        "<x:g xmlns:x='http://example.com/'><path d='M0 0H9'/></x:g>",
        "<linearGradient><path d='M0 0H9'/></linearGradient>",
        "<path xmlns:x='http://example.com/' x:d='M0 0H9'/>", "<title><path d='M0 0H9'/></title>",
        "<symbol><path d='M0 0H9'/></symbol>", "<clipPath><circle r='9'/></clipPath>",
        "<metadata><path d='M0 0H9'/></metadata>", "<unknown><path d='M0 0H9'/></unknown>"}) {
    ExpectNear(Curve(none + std::string("<path d='M0 0H1'/>")).points, {{0, 0, 0}, {1, 0, 0}});
  }
}

TEST(SvgDrawingTest, WhatIsShownAndYetNoCurveIsNoted) {
  const ShapeFile shape = Read(
                              "<svg>\n<path d='M0 0H1' clip-path='url(#c)'><animate/></path>\n"
                              "<text>a</text><text>b</text>\n<image/><set/></svg>")
                              .value();
  EXPECT_THAT(NotesOf(shape), testing::UnorderedElementsAre(
                                  "a.svg:2:1: clip-path cuts nothing off: curves stay whole",
                                  "a.svg:2:38: <animate> moves nothing here",
                                  "a.svg:3:1: <text> is passed over: it is no curve",
                                  "a.svg:4:1: <image> is passed over: it is no curve",
                                  "a.svg:4:9: <set> moves nothing here"));
  EXPECT_TRUE(Read("<svg><path d='M0 0H1' fill='red' clip-path='none'/></svg>")->notes.empty());
}

}  // namespace
}  // namespace fjord
