#include "engine/formats/known_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "engine/formats/readers.h"
#include "engine/formats/text.h"

namespace fjord {
namespace {

constexpr size_t kHead = 65536;  // of a file says what it is

enum class Use { kShape, kModel, kMap, kTerrain, kPicture, kScene, kText, kOther };

struct Known {
  std::string_view name;
  Use use = Use::kOther;
};

struct Magic {
  std::string_view bytes;
  Known known;
};

using namespace std::string_view_literals;

constexpr Magic kMagics[] = {
    {"\x89PNG\r\n"sv, {"a PNG picture", Use::kTerrain}},
    {"\x76\x2f\x31\x01"sv, {"an OpenEXR picture", Use::kTerrain}},
    {"\xff\xd8\xff"sv, {"a JPEG picture", Use::kPicture}},
    {"GIF8"sv, {"a GIF picture", Use::kPicture}},
    {"II*\0"sv, {"a TIFF picture", Use::kPicture}},
    {"MM\0*"sv, {"a TIFF picture", Use::kPicture}},
    {"II+\0"sv, {"a TIFF picture", Use::kPicture}},
    {"glTF"sv, {"a glTF model", Use::kModel}},
    {"Kaydara FBX Binary"sv, {"an FBX model", Use::kModel}},
    {"; FBX "sv, {"an FBX model", Use::kModel}},
    {"BLENDER"sv, {"a Blender file", Use::kModel}},
    {"\x28\xb5\x2f\xfd"sv, {"a compressed file, as Blender's are", Use::kModel}},
    {"PXR-USDC"sv, {"a USD scene", Use::kModel}},
    {"#usda"sv, {"a USD scene", Use::kModel}},
    {"Ogawa"sv, {"an Alembic archive", Use::kModel}},
    {"\x7fNSJb"sv, {"a Houdini geometry", Use::kModel}},
    {"OFF\n"sv, {"an OFF mesh", Use::kModel}},
    {"OFF\r"sv, {"an OFF mesh", Use::kModel}},
    {"\0\0\x27\x0a"sv, {"a shapefile of a map program", Use::kMap}},
    {"\xff\xfe"sv, {"text in UTF-16", Use::kText}},
    {"\xfe\xff"sv, {"text in UTF-16", Use::kText}},
    {"%PDF"sv, {"a PDF document", Use::kOther}},
    {"PK\x03\x04"sv, {"a zip archive", Use::kOther}},
    {"\x1f\x8b"sv, {"a gzip archive", Use::kOther}},
};

bool Holds(std::string_view text, std::string_view part) { return text.find(part) != text.npos; }

// 80 bytes of anything, a count, and 50 bytes a triangle.
bool IsBinaryStl(std::string_view bytes) {
  if (bytes.size() < 84) return false;
  uint64_t count = 0;
  for (size_t i = 4; i-- > 0;) count = count << 8 | static_cast<unsigned char>(bytes[80 + i]);
  return bytes.size() == 84 + 50 * count;
}

// The text of the first "type" whose value marks a map; keys of maps come in any order.
bool IsGeoJson(std::string_view json) {
  for (size_t at = json.find("\"type\""); at != json.npos; at = json.find("\"type\"", at + 6)) {
    const size_t from = json.find_first_not_of(" \t\r\n:", at + 6);
    if (from == json.npos || json[from] != '"') continue;
    const size_t to = json.find('"', from + 1);
    if (to != json.npos && IsGeoJsonType(json.substr(from + 1, to - from - 1))) return true;
  }
  return false;
}

Known OfJson(std::string_view json) {
  if (IsGeoJson(json)) return {"GeoJSON", Use::kMap};
  if (Holds(json, "\"asset\"") && Holds(json, "\"meshes\"")) return {"a glTF model", Use::kModel};
  if (Holds(json, "\"fileversion\"")) return {"a Houdini geometry", Use::kModel};
  return Holds(json, "\"objects\"") ? Known{"a scene of Fjord", Use::kScene}
                                    : Known{"JSON", Use::kOther};
}

std::optional<Known> OfXml(std::string_view xml) {
  constexpr Magic kRoots[] = {{"<svg", {"an .svg drawing", Use::kShape}},
                              {"<kml", {"a KML map", Use::kMap}},
                              {"<gpx", {"a GPX track", Use::kMap}},
                              {"<osm", {"an OpenStreetMap extract", Use::kMap}},
                              {"<COLLADA", {"a COLLADA model", Use::kModel}},
                              {"<X3D", {"an X3D model", Use::kModel}}};
  for (const Magic& root : kRoots) {
    if (Holds(xml, root.bytes)) return root.known;
  }
  return std::nullopt;
}

// By the first line that says anything; a .std has free text first.
std::optional<Known> OfLines(std::string_view head) {
  constexpr std::array<std::string_view, 9> kObjWords = {"v", "vn", "vt",     "f",     "l",
                                                         "o", "g",  "mtllib", "usemtl"};
  text::LineReader lines(head);
  text::Line line;
  bool first = true;
  while (lines.Next(&line)) {
    text::Words words(line.text.substr(0, 200));
    text::Word word, second;
    if (!words.Next(&word) || word.text[0] == '#') continue;
    const bool has_second = words.Next(&second) && second.text[0] != '{' && second.text[0] != ':';
    if (formats::IsStdDataLine(line.text)) return Known{"a .std shape", Use::kShape};
    if (first && word.text == "ply") return Known{"a .ply shape", Use::kShape};
    if (first && word.text == "solid" && Holds(head, "facet"))
      return Known{"an STL mesh", Use::kModel};
    if (first && word.text == "0" && Holds(head, "SECTION"))
      return Known{"a DXF drawing", Use::kMap};
    if (first && has_second &&
        std::find(kObjWords.begin(), kObjWords.end(), word.text) != kObjWords.end()) {
      return Known{"a Wavefront .obj shape", Use::kShape};
    }
    const std::string_view field = word.text.substr(0, word.text.find_first_of("{:"));
    if (field == "objects" || (first && (field == "output" || field == "camera"))) {
      return Known{"a scene of Fjord", Use::kScene};
    }
    first = false;
  }
  return std::nullopt;
}

std::optional<Known> Recognise(std::string_view bytes) {
  for (const Magic& magic : kMagics) {
    if (bytes.substr(0, magic.bytes.size()) == magic.bytes) return magic.known;
  }
  if (IsBinaryStl(bytes)) return Known{"an STL mesh", Use::kModel};
  std::string_view head = bytes.substr(0, kHead);
  const size_t first = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first == head.npos) return std::nullopt;
  head.remove_prefix(first);
  if (head.substr(0, 3) == "ply") return Known{"a .ply shape", Use::kShape};
  if (text::LooksBinary(head)) return std::nullopt;
  // A map's "type" may come last of all.
  if (head[0] == '{' || head[0] == '[') return OfJson(bytes);
  if (head[0] == '<') return OfXml(head);
  return OfLines(head);
}

// What to do with files whose use is the same wherever they are given; `otherwise` with others.
std::string AdviceFor(Use use, const char* otherwise) {
  const std::string heights =
      "as terrain a scene names it by shape { heights { file { path: \"...\" } } }";
  switch (use) {
    case Use::kTerrain:
      return "; " + heights;
    case Use::kPicture:
      return "; save it as .png of 16 bits or .exr, and " + heights;
    case Use::kText:
      return "; save it as UTF-8";
    default:
      return std::string("; ") + otherwise;
  }
}

}  // namespace

bool IsGeoJsonType(std::string_view type) {
  for (const std::string_view known :
       {"FeatureCollection", "Feature", "GeometryCollection", "Point", "MultiPoint", "LineString",
        "MultiLineString", "Polygon", "MultiPolygon", "Topology"}) {
    if (type == known) return true;
  }
  return false;
}

std::string WhyNotScene(std::string_view bytes, const std::string& name) {
  const std::optional<Known> known = Recognise(bytes);
  if (!known || known->use == Use::kScene) return "";
  const std::string what = "this is " + std::string(known->name) + ", not a scene";
  switch (known->use) {
    case Use::kShape:
      return what + "; `fjord import " + name + " -o NAME.scene` makes a first scene of it";
    case Use::kModel:
      return what + "; save it as .obj or .ply, and `fjord import` makes a first scene of that";
    case Use::kMap:
      return what + "; save its outlines as .svg or .obj, and `fjord import` makes a first scene";
    default:
      return what +
             AdviceFor(known->use, "a scene has fields such as objects and camera (docs/scene.md)");
  }
}

std::string WhyNotShape(std::string_view bytes) {
  const std::optional<Known> known = Recognise(bytes);
  if (!known || known->use == Use::kShape) return "";
  const std::string what = "this is " + std::string(known->name) + ", not a shape that is read";
  switch (known->use) {
    case Use::kScene:
      return what + "; `fjord fractalize` makes shapes of a scene's objects";
    case Use::kMap:
      return what + "; save its outlines as .svg or .obj";
    default:
      return what + AdviceFor(known->use, "save it as .obj, .ply, .std or, for curves, .svg");
  }
}

}  // namespace fjord
