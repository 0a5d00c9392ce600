// Properties that hide or move something: attributes, style sheets and style attributes.
#include <gtest/gtest.h>

#include "engine/formats/shape_file.h"
#include "tests/formats/expect_error.h"

namespace fjord {
namespace {

Result<ShapeFile> Read(const std::string& text) { return ReadShape(text, "a.svg"); }

// `hidden` shows nothing beside a path of length 1.
void ExpectHidden(const std::string& hidden) {
  SCOPED_TRACE(hidden);
  const auto shape = Read("<svg viewBox='0 0 9 9'>" + hidden + "<path d='M0 0H1'/></svg>");
  ASSERT_TRUE(shape) << shape.error().ToString();
  ASSERT_EQ(shape->curves.size(), 1u);
  EXPECT_EQ(shape->curves[0].points[1], Vec3(1, 0, 0));
}

void ExpectShown(const std::string& shown) {
  SCOPED_TRACE(shown);
  const auto shape = Read("<svg viewBox='0 0 9 9'>" + shown + "</svg>");
  ASSERT_TRUE(shape) << shape.error().ToString();
  EXPECT_EQ(shape->curves.size(), 1u);
}

TEST(SvgStyleTest, SheetsHideByNameClassAndId) {
  const std::string path = "<path id='i' class='a b' d='M0 0H5'/>";
  const auto sheet = [](const std::string& rules) { return "<style>" + rules + "</style>"; };
  for (const char* selector :
       {".a", ".b", "#i", "path.a", "path#i", "path.a.b", ".b.a#i", "line, .a", "*.a"}) {
    ExpectHidden(sheet(std::string(selector) + "{display:none}") + path);
    ExpectHidden(path +
                 sheet("x{fill:red}" + std::string(selector) + " { VISIBILITY : hidden ; }"));
  }
  for (const char* selector :
       {".c", "#j", "line.a", "path.c", ".a.c", ".A", "line, .c", ".a:hover", "#i:focus"}) {
    ExpectShown(sheet(std::string(selector) + "{display:none}") + path);
  }
}

TEST(SvgStyleTest, TheMoreParticularRuleWins) {
  const auto path = [](const std::string& rules, const std::string& attributes) {
    return "<style>" + rules + "</style><path id='i' class='a' " + attributes + " d='M0 0H5'/>";
  };
  ExpectHidden(path(".a{display:none}path{display:inline}", ""));
  ExpectHidden(path("#i{display:none}.a{display:inline}", ""));
  ExpectHidden(path(".a{display:inline}.a{display:none}", ""));
  ExpectShown(path(".a{display:none}#i{display:inline}", ""));
  ExpectShown(path(".a{display:none}.a{display:inline}", ""));
  ExpectHidden(path(".a{display:none}", "display='inline'"));
  ExpectShown(path(".a{display:inline}", "display='none'"));
  ExpectShown(path(".a{display:none}", "style='display:inline'"));
  ExpectHidden(path(".a{display:none!important}", "style='display:inline'"));
  ExpectShown(path(".a{display:none ! important}", "style='display:inline!important'"));
}

TEST(SvgStyleTest, SheetsMove) {
  const auto shape = Read(
      "<svg><style>.a{transform:translate(1px,2px)} circle{r:5px;cx:10}</style>"
      "<path class='a' d='M0 0H1'/><circle r='1'/></svg>");
  ASSERT_TRUE(shape) << shape.error().ToString();
  EXPECT_EQ(shape->curves[0].points[0], Vec3(1, -2, 0));
  EXPECT_EQ(shape->curves[1].points[0], Vec3(15, 0, 0));
}

TEST(SvgStyleTest, SheetsAreReadAsCssIs) {
  const std::string path = "<path class='a' d='M0 0H5'/>";
  for (const char* css :
       {"/* .b{} */.a/**/{/* x */display:none}", "@charset 'x';.a{display:none}",
        "@font-face{font-family:'}';src:url(a;b)}.a{display:none}",
        "@keyframes k{from{transform:none}to{transform:scale(2)}}.a{display:none}",
        "@media print{.a{fill:red}}.a{display:none}", ".a{background:url('a;}');display:none",
        "<![CDATA[.a{display:none}]]>", "g>.b{fill:red}.a{fill:blue;display:none}"}) {
    ExpectHidden("<style>" + std::string(css) + "</style>" + path);
  }
  ExpectHidden("<defs><style type='text/css'>.a{display:none}</style></defs>" + path);
  ExpectShown("<style type='text/x-other'>.a{display:none}</style>" + path);
  ExpectHidden("<path style='background:url(data:x;y);display:none' d='M0 0H5'/>");
  ExpectHidden("<path style='/*display:inline*/display:none' d='M0 0H5'/>");
}

// Icon sets hold a box that nobody sees, for programs that crop; DXF converters paint nothing at
// all.
TEST(SvgStyleTest, CurvesWithoutPaintAreLeftOutBesidePaintedOnes) {
  for (const char* unseen :
       {"<path fill='none' d='M0 0H5V5z'/>", "<rect width='9' height='9' style='fill:none'/>",
        "<path d='M0 0H5V5z' fill='transparent' stroke='none'/>",
        "<g fill='none'><circle r='4'/></g>",
        "<style>.n{fill:none}</style><circle class='n' r='4'/>",
        "<g stroke='red'><path fill='none' stroke='none' d='M0 0H5'/></g>"}) {
    ExpectHidden(unseen);
    const auto shape = Read("<svg>\n" + std::string(unseen) + "<path d='M0 0H1'/></svg>");
    ASSERT_EQ(shape->notes.size(), 1u);
    EXPECT_EQ(shape->notes[0].place.line, 2);
    EXPECT_EQ(shape->notes[0].message, "a curve with neither fill nor stroke is passed over");
    // Where nothing is painted, all is read.
    ExpectShown(unseen);
    EXPECT_TRUE(Read("<svg>" + std::string(unseen) + "</svg>")->notes.empty());
  }
  ExpectHidden("<g opacity='0'><path d='M0 0H5'/></g>");
  for (const char* seen :
       {"<g fill='none' stroke='black'><path d='M0 0H5'/></g>",
        "<g fill='none'><path d='M0 0H5' style='stroke:#000'/></g>",
        "<g fill='none'><path d='M0 0H5' fill='red'/></g>",
        "<style>g path{fill:none}.s{stroke:red}</style><path class='s' d='M0 0H5'/>"}) {
    const auto shape = Read("<svg>" + std::string(seen) + "<path d='M0 0H1'/></svg>");
    ASSERT_TRUE(shape) << shape.error().ToString();
    EXPECT_EQ(shape->curves.size(), 2u) << seen;
    EXPECT_TRUE(shape->notes.empty());
  }
}

TEST(SvgStyleTest, ManyRulesForManyElementsAreBounded) {
  std::string text = "<svg><style>";
  for (int i = 0; i < 9000; ++i) text += ".a.b" + std::to_string(i) + "{display:none}";
  text += "</style>";
  for (int i = 0; i < 1200; ++i) text += "<g class='a'/>";
  const auto shape = Read(text + "</svg>");
  ASSERT_FALSE(shape.ok());
  EXPECT_EQ(shape.error().code, ErrorCode::kLimit) << shape.error().ToString();
}

TEST(SvgStyleTest, WhatMayHideOrMoveAndIsNotKnownIsRefused) {
  const std::pair<const char*, const char*> cases[] = {
      {"<style>g .a{display:none}</style>", "hides or moves what 'g .a'"},
      {"<style>[x]{visibility:hidden}</style>", "hides or moves what '[x]'"},
      {"<style>g > path, .a{transform:none}</style>", "hides or moves what 'g > path'"},
      {"<style>.a:nth-child(2){display:none}</style>", "what '.a:nth-child(2)'"},
      {"<style>@media print{.a{display:none}}</style>", "@media"},
      {"<style>@supports (x:y){.a{display:none}}</style>", "@supports"},
      {"<style>@import url(a.css);</style>", "@import"},
      {"<path style='rotate: 45deg'/>", "rotate in a style"},
      {"<path style='offset-path: none; translate: 1px'/>", "translate in a style"},
      {"<path style='d: path(\"M0 0\")'/>", "d in a style is not read"},
      {"<path transform='scale(2)' style='transform-box: fill-box'/>", "box 'fill-box'"}};
  for (const auto& [text, words] : cases) {
    SCOPED_TRACE(text);
    ExpectError(Read("<svg>\n" + std::string(text) + "</svg>"), "a.svg:2:1", words);
  }
  std::string many = "<svg>\n<style>";
  for (int i = 0; i < 10001; ++i) many += ".a{display:none}";
  ExpectError(Read(many + "</style></svg>"), "a.svg:2:1", "more than 10,000 rules");
}

}  // namespace
}  // namespace fjord
