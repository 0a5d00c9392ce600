// What of XML a .svg file may use, and what it may not.
#include "engine/formats/xml_document.h"

#include <gtest/gtest.h>

#include "engine/formats/shape_file.h"
#include "tests/formats/expect_error.h"

namespace fjord {
namespace {

Result<ShapeFile> Read(const std::string& text) { return ReadShape(text, "a.svg"); }

const std::vector<Vec3> kLine = {{0, 0, 0}, {1, 0, 0}};

void ExpectLine(const std::string& text) {
  const auto shape = Read(text);
  ASSERT_TRUE(shape) << shape.error().ToString();
  EXPECT_EQ(shape->curves[0].points, kLine);
}

std::string Wide(const std::string& text, bool high_first, bool mark) {
  std::string wide = mark ? (high_first ? "\xFE\xFF" : "\xFF\xFE") : "";
  for (const char c : text) {
    if (high_first) wide += '\0';
    wide += c;
    if (!high_first) wide += '\0';
  }
  return wide;
}

TEST(XmlDocumentTest, ReferencesAndEntitiesStandForTheirText) {
  for (const char* d : {"M0 0&#10;H1", "M0 0&#x9;H1", "&#x4D;0 0H&#49;", "M0 0H1&#x20;", "&p;",
                        "M0&b;0H1", "&nested;", "M0 0H&one;"}) {
    SCOPED_TRACE(d);
    ExpectLine(
        "<!DOCTYPE svg [<!ENTITY p 'M0 0H1'><!ENTITY b ' '><!ENTITY one '&#49;'>"
        "<!ENTITY nested 'M0 0H&one;'>]><svg><path d='" +
        std::string(d) + "'/></svg>");
  }
  ExpectLine("<!DOCTYPE svg [<!ENTITY e '<path d=\"M0 0H1\"/>'>]><svg>&e;</svg>");
  ExpectLine("<svg><g id='a&amp;&lt;&gt;&quot;&apos;'/><path d='M0 0H1'/></svg>");
  ExpectLine("<!DOCTYPE svg [<!ATTLIST path d CDATA 'M0 0H1'>]><svg><path/></svg>");
}

TEST(XmlDocumentTest, EncodingsByMarkAndDeclaration) {
  const std::string body = "<svg><path d='M0 0H1'/></svg>";
  ExpectLine("\xEF\xBB\xBF" + body);
  ExpectLine("\xEF\xBB\xBF<?xml version='1.0' encoding='utf-8'?>" + body);
  ExpectLine("\n <?xml version='1.0'?>" + body);  // not well-formed, but met
  for (const char* name : {"ISO-8859-1", "windows-1252", "ISO-8859-15", "us-ascii", "Shift_JIS"}) {
    SCOPED_TRACE(name);
    const std::string odd = std::string(name) == "us-ascii" ? "x" : "\xE9\x80";
    ExpectLine("<?xml version='1.0' encoding='" + std::string(name) + "'?><svg><g id='" + odd +
               "'/><path d='M0 0H1'/></svg>");
  }
  for (const bool high_first : {false, true}) {
    for (const bool mark : {false, true}) {
      ExpectLine(Wide("<?xml version='1.0' encoding='UTF-16'?>" + body, high_first, mark));
    }
  }
  ExpectError(Read("<svg><g id='\xE9'/></svg>"), "a.svg:1:13", "declare the file's encoding");
}

TEST(XmlDocumentTest, PlacesAreThoseOfTheCharacters) {
  const std::string good = "<svg>\r\n<path\n\tid='d=x' d\t=\n'M0 0";
  ExpectError(Read(good + "K'/></svg>"), "a.svg:4:6", "'K'");
  ExpectError(Read(good + "&#32;K'/></svg>"), "a.svg:4:11", "'K'");
  ExpectError(Read("<svg>\r<path d='M0 0\r\nK'/></svg>"), "a.svg:3:1", "'K'");
  ExpectError(Read(Wide("<svg>\n<path d='M0 0K'/></svg>", false, true)), "a.svg:2:14", "'K'");
  ExpectError(Read("<!DOCTYPE svg [<!ENTITY k 'K'>]>\n<svg><path d='M0 0&k;'/></svg>"),
              "a.svg:2:19", "'K'");
}

// A DTD elsewhere may declare anything; what it does is not known, so nothing vanishes quietly.
TEST(XmlDocumentTest, WhatIsDeclaredElsewhereIsRefused) {
  const std::string dtd = "<!DOCTYPE svg PUBLIC '-//W3C//DTD SVG 1.1//EN' 'svg11.dtd' [";
  ExpectLine(dtd + "]><svg><path d='M0 0H1'/></svg>");
  ExpectLine(dtd + "<!ENTITY one '1'>]><svg><path d='M0 0H&one;'/></svg>");
  ExpectError(Read(dtd + "]>\n<svg><path d='M0 0&far;H1'/></svg>"), "a.svg:2:19",
              "entity 'far' is not declared");
  ExpectError(Read(dtd + "]>\n<svg>&far;</svg>"), "a.svg:2:6", "entity 'far' is not declared");
  ExpectError(Read(dtd + "<!ENTITY a '&far;'>]>\n<svg><path d='&a;'/></svg>"), "a.svg:1:81",
              "entity 'far' is not declared");
  ExpectError(Read("<!DOCTYPE svg [<!ENTITY % p SYSTEM 'x'> %p; ]>\n<svg>&far;</svg>"), "a.svg:2:6",
              "entity 'far' is not declared");
  ExpectError(Read("<!DOCTYPE svg [<!ENTITY f SYSTEM '/etc/passwd'>]>\n<svg>&f;</svg>"),
              "a.svg:2:6", "nothing is fetched");
  ExpectError(Read("<!DOCTYPE svg [<!ENTITY f SYSTEM 'x'>]>\n<svg><path d='&f;'/></svg>"),
              "a.svg:2:15", "nothing is fetched");
}

TEST(XmlDocumentTest, EntitiesThatGrowWithoutEndAreRefused) {
  std::string laughs = "<!DOCTYPE svg [<!ENTITY a0 'ha ha ha ha ha ha ha '>";
  for (int i = 1; i < 12; ++i) {
    laughs += "<!ENTITY a" + std::to_string(i) + " '";
    for (int k = 0; k < 10; ++k) laughs += "&a" + std::to_string(i - 1) + ";";
    laughs += "'>";
  }
  for (const char* body : {"<svg>&a11;</svg>", "<svg><path d='&a11;'/></svg>"}) {
    const auto shape = Read(laughs + "]>" + body);
    ASSERT_FALSE(shape.ok());
    EXPECT_EQ(shape.error().code, ErrorCode::kLimit) << shape.error().ToString();
  }
  ExpectError(Read("<!DOCTYPE svg [<!ENTITY a '&b;'><!ENTITY b '&a;'>]>\n<svg>&a;</svg>"),
              "a.svg:2:6", "recursive");
}

TEST(XmlDocumentTest, NamespacesTellElementsApart) {
  const std::string bytes =
      "<a:svg xmlns:a='http://www.w3.org/2000/svg' xmlns:b='urn:b' b:id='x' id='y'>"
      "<b:path/><path xmlns='urn:c'/></a:svg>";
  const std::string name = "a.svg";
  const auto document = formats::XmlDocument::Read(bytes, name, "");
  ASSERT_TRUE(document) << document.error().ToString();
  const auto& elements = document->elements();
  ASSERT_EQ(elements.size(), 3u);
  EXPECT_EQ(elements[0].name, "svg");
  EXPECT_EQ(elements[0].space, "http://www.w3.org/2000/svg");
  EXPECT_EQ(elements[0].end, 3u);
  EXPECT_EQ(document->Attribute(elements[0], "id"), "y");
  EXPECT_EQ(elements[1].name, "path");
  EXPECT_EQ(elements[1].space, "urn:b");
  EXPECT_EQ(elements[2].space, "urn:c");
  EXPECT_EQ(document->PlaceOf(elements[2]).column, 86);
}

}  // namespace
}  // namespace fjord
