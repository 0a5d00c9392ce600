#include "engine/formats/shape_file.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/formats/known_file.h"
#include "engine/formats/limits.h"
#include "engine/formats/read_bytes.h"
#include "engine/formats/readers.h"
#include "engine/formats/text.h"
#include "engine/formats/xml_document.h"

namespace fjord {
namespace {

using formats::Comment;

constexpr std::array<std::pair<std::string_view, ShapeFormat>, 5> kEndings = {{
    {".std", ShapeFormat::kStd},
    {".epf", ShapeFormat::kEpf},
    {".obj", ShapeFormat::kObj},
    {".ply", ShapeFormat::kPly},
    {".svg", ShapeFormat::kSvg},
}};

std::string EndingOf(const std::string& path) {
  const size_t dot = path.find_last_of("./");
  if (dot == path.npos || path[dot] != '.') return "";
  std::string ending = path.substr(dot);
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending;
}

enum class TextKind { kUnknown, kStd, kWavefront, kAnimator };

// Lines that only Animator's object file has (W48). They may stand in the free text of a .std file
// too, so they decide only when nothing else does.
bool IsAnimatorLine(std::string_view word, std::string_view second) {
  constexpr std::array<std::string_view, 5> kWords = {"detail", "poly_colors", "bounding_box",
                                                      "my_shading", "nor_perting"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end() ||
         (word == "type" && second == "polygon");
}

struct Guess {
  TextKind kind = TextKind::kUnknown;
  int animator_line = 0;
};

Guess GuessText(std::string_view bytes) {
  Guess guess;
  text::LineReader lines(bytes);
  text::Line line;
  while (lines.Next(&line)) {
    text::Words words(line.text.substr(0, 200));
    text::Word word, second;
    if (!words.Next(&word)) continue;
    if (formats::IsStdDataLine(line.text)) {
      guess.kind = TextKind::kStd;
      return guess;
    }
    const bool has_second = words.Next(&second);
    if (word.text == "v" && has_second && text::LooksLikeNumber(second.text)) {
      guess.kind = TextKind::kWavefront;
      return guess;
    }
    if (guess.animator_line == 0 && has_second && IsAnimatorLine(word.text, second.text)) {
      guess.animator_line = line.number;
    }
  }
  if (guess.animator_line > 0) guess.kind = TextKind::kAnimator;
  return guess;
}

// Some face names two vertices. Its sizes and indices are sound.
bool HasEdge(const Mesh& mesh) {
  size_t corner = 0;
  for (const uint32_t size : mesh.face_size) {
    for (size_t k = 1; k < size; ++k) {
      if (mesh.face_vertex[corner + k] != mesh.face_vertex[corner]) return true;
    }
    corner += size;
  }
  return false;
}

// The mesh of a shape obeys Mesh's invariants, its curves are curves, its numbers can be read
// again.
Result<> CheckWritable(const ShapeFile& shape, ShapeFormat format) {
  const Mesh& mesh = shape.mesh;
  if (mesh.face_size.empty() && shape.curves.empty()) {
    return Invalid("there is nothing to write: the shape has no faces and no curves");
  }
  const auto good = [](const Vec3& p) {
    for (int k = 0; k < 3; ++k) {
      if (!(p[k] >= -limits::kCoordinate && p[k] <= limits::kCoordinate)) return false;
    }
    return true;
  };
  size_t points = mesh.points.size();
  for (size_t v = 0; v < points; ++v) {
    if (!good(mesh.points[v])) {
      return Invalid("vertex " + std::to_string(v + 1) + " is not finite or beyond 1e15");
    }
  }
  size_t corners = 0;
  for (size_t f = 0; f < mesh.face_size.size(); ++f) {
    if (mesh.face_size[f] < 3) {
      return Invalid("face " + std::to_string(f + 1) + " has fewer than 3 vertices");
    }
    corners += mesh.face_size[f];
  }
  if (corners != mesh.face_vertex.size()) return Invalid("the sizes of the faces do not add up");
  for (const uint32_t v : mesh.face_vertex) {
    if (v >= points) return Invalid("a face names vertex " + std::to_string(uint64_t{v} + 1));
  }
  if (format == ShapeFormat::kSvg && shape.curves.empty() && !HasEdge(mesh)) {
    return Invalid(
        "no face of the mesh has an edge that .svg could show: each names one vertex only");
  }
  if (!mesh.colors.empty() && mesh.colors.size() != points) {
    return Invalid("there must be a colour for every vertex or for none");
  }
  for (const Rgb& c : mesh.colors) {
    if (!good(Vec3(c))) return Invalid("a colour is not finite or beyond 1e15");
  }
  for (size_t i = 0; i < shape.curves.size(); ++i) {
    const Polyline& curve = shape.curves[i];
    const std::string name = "curve " + std::to_string(i + 1);
    if (curve.points.size() < (curve.closed ? 3 : 2)) return Invalid(name + " has too few points");
    if (!curve.closed && (format == ShapeFormat::kStd || format == ShapeFormat::kEpf)) {
      return Invalid(name +
                     " is open: .std and .epf hold closed outlines only; use .obj, .ply or .svg");
    }
    for (const Vec3& p : curve.points) {
      if (!good(p)) return Invalid("a point of " + name + " is not finite or beyond 1e15");
    }
    points += curve.points.size();
  }
  if (points > limits::kVertices) return formats::TooManyVertices({});
  if (corners > limits::kIndices) return formats::TooManyIndices({});
  return Ok{};
}

}  // namespace

namespace formats {

Error TooManyVertices(Place place) {
  return MakeError(ErrorCode::kLimit, "more than 16,000,000 vertices", std::move(place));
}
Error TooManyIndices(Place place) {
  return MakeError(ErrorCode::kLimit, "more than 64,000,000 face corners", std::move(place));
}
Error LineTooLong(Place place) {
  return MakeError(ErrorCode::kLimit, "a line longer than 16 MiB", std::move(place));
}

}  // namespace formats

Result<ShapeFile> ReadShape(std::string_view bytes, const std::string& name) {
  const Place file = {name, 0, 0};
  if (bytes.empty()) return Invalid("the file is empty; a shape was expected", file);
  if (bytes.size() > limits::kFileBytes) {
    return MakeError(ErrorCode::kLimit, "the file is larger than 1 GiB", file);
  }
  if (formats::LooksLikePly(bytes)) return formats::ReadPly(bytes, name);
  if (formats::LooksLikeWideXml(bytes)) return formats::ReadSvg(bytes, name);
  if (text::LooksBinary(bytes)) {
    if (std::string why = WhyNotShape(bytes); !why.empty()) return Invalid(std::move(why), file);
    return Invalid("the file is binary; shapes are .std, .epf, Wavefront .obj, .ply or .svg", file);
  }
  const size_t first = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first == bytes.npos) return Invalid("the file holds nothing but spaces", file);
  if (bytes[first] == '<') {
    std::string why = WhyNotShape(bytes);
    return why.empty() ? formats::ReadSvg(bytes, name) : Invalid(std::move(why), file);
  }
  const Guess guess = GuessText(bytes);
  switch (guess.kind) {
    case TextKind::kStd:
      return formats::ReadStd(bytes, name);
    case TextKind::kWavefront:
      return formats::ReadObj(bytes, name);
    case TextKind::kAnimator:
      return Invalid(
          "this is an object file of Animator, not of Wavefront; Animator's are not read "
          "yet: give the shape as .std, Wavefront .obj or .ply",
          {name, guess.animator_line, 1});
    case TextKind::kUnknown:
      break;
  }
  if (std::string why = WhyNotShape(bytes); !why.empty()) return Invalid(std::move(why), file);
  const std::string ending = EndingOf(name);
  if (ending == ".std" || ending == ".epf") return formats::ReadStd(bytes, name);
  if (ending == ".obj") {
    return Invalid("no vertex line `v x y z`; this is no Wavefront .obj file", file);
  }
  return Invalid(
      "no shape is recognised: a .std or .epf file has a line `data NPTS NPOLYS`, a "
      "Wavefront .obj lines `v x y z`, a .ply starts with `ply`, a .svg with `<`",
      file);
}

Result<ShapeFile> ReadShapeFile(const std::string& path) {
  auto bytes = ReadBytes(path, limits::kFileBytes);
  if (!bytes) return bytes.error();
  return ReadShape(*bytes, path);
}

Result<ShapeFormat> ShapeFormatOf(const std::string& path) {
  const std::string ending = EndingOf(path);
  for (const auto& [known, format] : kEndings) {
    if (ending == known) return format;
  }
  return MakeError(ErrorCode::kUsage, (ending.empty() ? "'" + path + "' has no ending"
                                                      : "the ending " + ending + " is not known") +
                                          "; shapes are written as .std, .epf, .obj, .ply or .svg");
}

Result<std::string> WriteShape(const ShapeFile& shape, ShapeFormat format, const Comment& comment) {
  if (auto ok = CheckWritable(shape, format); !ok) return ok.error();
  switch (format) {
    case ShapeFormat::kStd:
    case ShapeFormat::kEpf:
      return formats::WriteStd(shape, comment);
    case ShapeFormat::kObj:
      return formats::WriteObj(shape, comment);
    case ShapeFormat::kPly:
      return formats::WritePly(shape, comment);
    case ShapeFormat::kSvg:
      return formats::WriteSvg(shape, comment);
  }
  FJORD_CHECK(false, static_cast<int>(format));
  return Error{};
}

}  // namespace fjord
