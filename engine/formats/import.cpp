#include "engine/formats/import.h"

#include <algorithm>
#include <array>
#include <vector>

#include "engine/base/clamp.h"
#include "engine/base/exact_math.h"
#include "engine/formats/text.h"
#include "engine/geometry/check_mesh.h"
#include "engine/geometry/edges.h"

namespace fjord {
namespace {

constexpr size_t kMostNotes = 5;
constexpr size_t kMostCurves = 1000;  // that become objects
// The default amplitude is for shapes of this extent.
constexpr double kAmplitude = .15, kAmplitudeExtent = 2, kH = .7;
constexpr double kAspect = 960. / 540;
constexpr double kMargin = 1.1;
// Eye distance that holds a ball of radius 1 at a vertical angle of 35 degrees: 1 / sin(17.5
// degrees).
constexpr double kBallDistance = 3.33;

struct Box {
  Vec3 low{0}, high{0};
  bool empty = true;

  void Add(const Vec3& p) {
    for (int k = 0; k < 3; ++k) {
      low[k] = empty ? p[k] : std::min(low[k], p[k]);
      high[k] = empty ? p[k] : std::max(high[k], p[k]);
    }
    empty = false;
  }
};

std::string Text(double value) {
  std::string text;
  text::Append(value + 0, &text);
  return text;
}

std::string Xyz(const Vec3& v) {
  return "{ x: " + Text(v.x) + " y: " + Text(v.y) + " z: " + Text(v.z) + " }";
}

// Enough digits for a camera; whole pictures do not hang on the last bit of where it stands.
double Rounded(double value, double unit) {
  const double scaled = value * (1000 / unit);
  const bool exact = scaled > -1e15 && scaled < 1e15;  // else rounding would change it too much
  return exact ? static_cast<double>(RoundToInt64(scaled)) / (1000 / unit) : value;
}

std::string ProtoString(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

// The file's stem as a name that scenes accept.
std::string NameOf(const std::string& path) {
  const size_t slash = path.find_last_of('/');
  std::string stem = slash == path.npos ? path : path.substr(slash + 1);
  stem = stem.substr(0, std::min(stem.rfind('.'), size_t{60}));
  std::string name;
  for (const char c : stem) {
    const bool good = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '_' || c == '-';
    name += good ? c : '_';
  }
  const bool digits = name.find_first_not_of("0123456789") == name.npos;
  return digits ? "shape" + name : name;  // a name is no number
}

enum class Form { kCurve, kOutline, kFlatMesh, kRelief, kClosedMesh };

// What becomes an object: the file's faces, or one of its curves.
struct Piece {
  Form form = Form::kCurve;
  bool closed = false;
  size_t curve = 0;  // from 1; 0: all that the file holds
};

struct Judged {
  Form form = Form::kRelief;  // of the faces, else of the first curve
  bool closed = false;        // of a curve
  bool level_border = false;  // of a relief: all boundary vertices lie at the lowest height
  Box box;
  double longest =
      0;  // edge of the curves, or of a flat mesh; how far the fractal strays goes by it
};

Judged Judge(const ShapeFile& shape) {
  Judged judged;
  const Mesh& mesh = shape.mesh;
  for (const Polyline& curve : shape.curves) {
    for (size_t k = 0; k < curve.points.size(); ++k) {
      judged.box.Add(curve.points[k]);
      if (k == 0 && !curve.closed) continue;
      const Vec3& before = k > 0 ? curve.points[k - 1] : curve.points.back();
      judged.longest = std::max(judged.longest, Length(curve.points[k] - before));
    }
  }
  if (mesh.face_size.empty()) {
    judged.form = Form::kCurve;
    judged.closed = shape.curves[0].closed;
    return judged;
  }
  for (const uint32_t v : mesh.face_vertex) judged.box.Add(mesh.points[v]);
  if (mesh.FaceCount() == 1 && mesh.face_size[0] > 4) {
    judged.form = Form::kOutline;
    judged.closed = true;
    for (size_t k = 0; k < mesh.face_vertex.size(); ++k) {
      const uint32_t before = mesh.face_vertex[k > 0 ? k - 1 : mesh.face_vertex.size() - 1];
      judged.longest =
          std::max(judged.longest, Length(mesh.points[mesh.face_vertex[k]] - mesh.points[before]));
    }
    return judged;
  }
  const EdgeTable table(mesh);
  bool open = false;
  judged.level_border = true;
  for (const Edge& edge : table.edges()) {
    if (edge.use_count != 1) continue;
    judged.longest = std::max(judged.longest, Length(mesh.points[edge.a] - mesh.points[edge.b]));
    open = true;
    judged.level_border = judged.level_border && mesh.points[edge.a].z == judged.box.low.z &&
                          mesh.points[edge.b].z == judged.box.low.z;
  }
  if (!open) {
    judged.form = Form::kClosedMesh;
  } else {
    judged.form = judged.box.low.z == judged.box.high.z ? Form::kFlatMesh : Form::kRelief;
  }
  return judged;
}

std::vector<Piece> PiecesOf(const ShapeFile& shape, const Judged& judged) {
  std::vector<Piece> pieces;
  const bool faces = !shape.mesh.face_size.empty();
  if (faces || shape.curves.size() == 1) pieces.push_back({judged.form, judged.closed, 0});
  if (!faces && shape.curves.size() == 1) return pieces;
  for (size_t k = 0; k < shape.curves.size(); ++k) {
    pieces.push_back({Form::kCurve, shape.curves[k].closed, k + 1});
  }
  return pieces;
}

std::string FormText(const ShapeFile& shape, const Judged& judged) {
  const std::string vertices = std::to_string(shape.mesh.points.size()) + " vertices, ";
  std::string faces = std::to_string(shape.mesh.FaceCount()) + " faces";
  if (!shape.curves.empty()) faces += ", and " + std::to_string(shape.curves.size()) + " curves";
  switch (judged.form) {
    case Form::kCurve: {
      if (shape.curves.size() > 1) return std::to_string(shape.curves.size()) + " curves";
      return std::string(judged.closed ? "a closed" : "an open") + " curve of " +
             std::to_string(shape.curves[0].points.size()) + " points";
    }
    case Form::kOutline:
      return "one outline of " + std::to_string(shape.mesh.face_size[0]) + " vertices";
    case Form::kFlatMesh:
      return "a flat mesh, " + vertices + faces;
    case Form::kRelief:
      return "a relief, " + vertices + faces;
    case Form::kClosedMesh:
      return "a closed mesh, " + vertices + faces;
  }
  return "";
}

// The knobs of a .par file, each with a comment that names its source.
std::string Knobs(const ParFile& par) {
  std::string out;
  const auto add = [&out](const char* field, double value, const std::string& source) {
    out += "    " + std::string(field) + ": " + Text(value) + "  # " + source + "\n";
  };
  if (par.fixvl) {
    out += "    law: SHIH  # fixvl belongs to the historic law of amount\n";
    add("move", *par.fixvl, "fixvl");
  }
  if (par.seed) add("seed", *par.seed, "seed");
  if (par.H) add("H", *par.H, "H-Fdim");
  if (par.sigma) add("sigma", *par.sigma, "sigma");
  if (par.max_level) add("max_level", *par.max_level, "maxlevel");
  if (par.epsilon) {
    add("epsilon", *par.epsilon, "epsilon");
  } else if (par.scale && par.eye_distance) {
    const double epsilon = .01 * *par.eye_distance / *par.scale;
    add("epsilon", std::clamp(epsilon, 1e-12, 1e12),
        "0.01 x eye distance " + Text(*par.eye_distance) + " / scale " + Text(*par.scale));
  }
  return out;
}

std::string Camera(const Judged& judged) {
  const Vec3 size = judged.box.high - judged.box.low;
  const double extent = std::max({size.x, size.y, size.z});
  Vec3 center = (judged.box.low + judged.box.high) * .5;
  for (int k = 0; k < 3; ++k) center[k] = Rounded(center[k], extent);
  const auto at = [&](const Vec3& offset) {
    Vec3 eye = center + offset;
    for (int k = 0; k < 3; ++k) eye[k] = Rounded(eye[k], extent);
    return eye;
  };
  if (size.z == 0) {
    // Lines stray from their coarse form by up to some two fifths of an edge on either side.
    const double stray = 2 * .4 * judged.longest;
    const double height =
        Rounded(std::max(size.y + stray, (size.x + stray) / kAspect) * kMargin, extent);
    return "camera {  # from above: the shape is flat\n  eye " + Xyz(at({0, 0, extent})) +
           "\n  look_at " + Xyz(center) +
           "\n  up { x: 0 y: 1 z: 0 }\n  projection: ORTHOGRAPHIC\n" +
           "  view_height: " + Text(height > 0 ? height : extent) + "\n}\n";
  }
  const double distance = .5 * Length(size) * kBallDistance;
  return "camera {  # from the south, so that all of it is in view\n  eye " +
         Xyz(at(Unit(Vec3(.32, -.8, .5)) * distance)) + "\n  look_at " + Xyz(center) +
         "\n  up { x: 0 y: 0 z: 1 }\n  fov: 35\n}\n";
}

std::string Lights() {
  return "ambient { r: 0.25 g: 0.27 b: 0.32 }\n"
         "lights {  # a sun from the south-west\n"
         "  name: \"sun\"\n"
         "  direction { x: -0.5 y: -0.55 z: 0.65 }\n"
         "  color { r: 1 g: 0.95 b: 0.86 }\n"
         "}\n";
}

const char* MethodOf(Form form) {
  switch (form) {
    case Form::kCurve:
    case Form::kOutline:
      return "curve";
    case Form::kFlatMesh:
      return "coast";
    case Form::kRelief:
    case Form::kClosedMesh:
      break;
  }
  return "surface";
}

// Law AFFINE gives a shape k times as large the same relief under an amplitude k^(1-H) times as
// large.
std::string Amplitude(const Judged& judged, const ParFile* par) {
  if (par != nullptr && (par->fixvl || par->sigma)) return "";  // its own numbers say how much
  const Vec3 size = judged.box.high - judged.box.low;
  const double extent = std::max({size.x, size.y, size.z});
  const double H = par != nullptr && par->H ? *par->H : kH;
  const double amplitude = kAmplitude * exact::Pow(extent / kAmplitudeExtent, 1 - H);
  if (amplitude == kAmplitude) return "";
  return "    amplitude: " + Text(std::min(amplitude, 1e6)) + "  # by the size of the shape\n";
}

std::string ObjectText(const Piece& piece, size_t number, const std::string& name,
                       const std::string& shape_path, const Judged& judged, const ParFile* par,
                       bool colors) {
  std::string out = "objects {\n  name: " + ProtoString(name) +
                    "\n  shape { file { path: " + ProtoString(shape_path);
  if (piece.form == Form::kOutline) out += " outline: true";
  if (piece.curve > 0) out += " curve: " + std::to_string(piece.curve);
  out += std::string(" } }\n  fractal {\n    method: \"") + MethodOf(piece.form) + "\"\n";
  if (par != nullptr) out += Knobs(*par);
  if (number > 0 && (par == nullptr || !par->seed)) {
    out += "    seed: " + std::to_string(number + 1) + "  # no two alike\n";
  }
  const bool relief = piece.form == Form::kRelief;
  if (relief || piece.form == Form::kClosedMesh) out += Amplitude(judged, par);
  if (relief && judged.level_border) {
    out += "    coast: true  # the border is level, so it stays a shore\n";
  }
  out += "  }\n";
  if (piece.closed) {
    out += "  material { color { r: 0.1 g: 0.2 b: 0.05 } fill: true }\n";
  } else if (colors && piece.curve == 0) {
    out += "  material { vertex_color: true }  # the file's own colours\n";
  }
  return out + "}\n";
}

}  // namespace

Result<std::string> SceneTextFromShape(const ShapeFile& shape, const std::string& shape_path,
                                       const ParFile* par, const std::string& par_path) {
  if (shape.mesh.face_size.empty() && shape.curves.empty()) {
    return Invalid("the shape has no faces and no curves", {shape_path, 0, 0});
  }
  for (const char c : shape_path) {
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) {
      return Invalid("the path of the shape holds a control character; rename the file",
                     {shape_path, 0, 0});
    }
  }
  const Judged judged = Judge(shape);
  const Vec3 size = judged.box.high - judged.box.low;
  if (!(std::max({size.x, size.y, size.z}) > 0)) {
    return Invalid("all points of the shape are at one place; there is nothing to see",
                   {shape_path, 0, 0});
  }
  if (shape.curves.size() > kMostCurves) {
    return MakeError(ErrorCode::kLimit,
                     std::to_string(shape.curves.size()) + " curves; at most " +
                         std::to_string(kMostCurves) +
                         " become objects. Join or thin them, or take single ones by "
                         "`file { curve: ... }`",
                     {shape_path, 0, 0});
  }
  const std::string name = NameOf(shape_path);
  std::string out = "# " + text::OneLine(shape_path) + ": " + FormText(shape, judged) + ", x " +
                    Text(judged.box.low.x) + " to " + Text(judged.box.high.x) + ", y " +
                    Text(judged.box.low.y) + " to " + Text(judged.box.high.y) + ", z " +
                    Text(judged.box.low.z) + " to " + Text(judged.box.high.z) + "\n";
  if (par != nullptr) {
    out +=
        "# Fractal knobs from " + text::OneLine(par_path) + "; all others are the method's own.\n";
  }
  for (const ShapeNote& note : shape.notes) {
    out +=
        "# Not in the shape: " + text::OneLine(note.place.ToString() + ": " + note.message) + "\n";
  }
  if (!shape.mesh.face_size.empty()) {
    const std::vector<MeshDefect> defects = CheckMesh(shape.mesh, kMostNotes);
    for (const MeshDefect& defect : defects) {
      out += "# To mend in " + text::OneLine(shape_path) + ": " + defect.message + "\n";
    }
  }
  out += "name: " + ProtoString(name) + "\noutput { width: 960 height: 540 }\n";
  out += Camera(judged) + Lights();
  if (judged.form == Form::kRelief && judged.level_border) {
    out += "sea { level: " + Text(judged.box.low.z) + " }  # the height of the shape's border\n";
  }
  const std::vector<Piece> pieces = PiecesOf(shape, judged);
  for (size_t k = 0; k < pieces.size(); ++k) {
    out += ObjectText(pieces[k], k, k == 0 ? name : name + "_" + std::to_string(k + 1), shape_path,
                      judged, par, !shape.mesh.colors.empty());
  }
  return out;
}

}  // namespace fjord
