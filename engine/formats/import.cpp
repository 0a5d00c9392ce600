#include "engine/formats/import.h"

#include <algorithm>
#include <vector>

#include "engine/base/exact_math.h"
#include "engine/formats/import_form.h"
#include "engine/formats/text.h"
#include "engine/geometry/check_mesh.h"

namespace fjord {

using namespace import;  // NOLINT(google-build-using-namespace): this folder's own part

namespace {

constexpr size_t kMostNotes = 5;
constexpr size_t kMostCurves = 1000;  // that become objects
// The default amplitude is for shapes of this extent.
constexpr double kAmplitude = .15, kAmplitudeExtent = 2, kH = .7;

std::string Text(double value) {
  std::string text;
  text::Append(value + 0, &text);
  return text;
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

// The default camera has all of the fractal in view, and follows what becomes of the scene.
std::string Camera(const Judged& judged) {
  if (judged.box.Size().z == 0) {
    return "camera { projection: ORTHOGRAPHIC }  # from above: the shape is flat; stands so that "
           "all "
           "is in view\n";
  }
  return "# The camera stands where all is in view. To place it: camera { eye { } look_at { } fov: "
         "35 "
         "}\n";
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
  const double extent = judged.box.Extent();
  const double H = par != nullptr && par->H ? *par->H : kH;
  const double amplitude = kAmplitude * exact::Pow(extent / kAmplitudeExtent, 1 - H);
  if (amplitude == kAmplitude) return "";
  return "    amplitude: " + Text(std::min(amplitude, 1e6)) + "  # by the size of the shape\n";
}

// What every object of the scene has in common.
struct Common {
  const Judged& judged;
  const std::string& shape_path;
  const ParFile* par;
  const ImportOptions& options;
  bool has_faces;
  bool has_colors;
};

const char* WordOf(UpAxis up) { return up == UpAxis::kY ? "Y" : up == UpAxis::kX ? "X" : "Z"; }

std::string ObjectText(const Piece& piece, size_t number, const std::string& name,
                       const Common& common) {
  const ParFile* par = common.par;
  std::string out = "objects {\n  name: " + ProtoString(name) +
                    "\n  shape { file { path: " + ProtoString(common.shape_path);
  if (common.options.up != UpAxis::kZ) out += std::string(" up: ") + WordOf(common.options.up);
  if (piece.form == Form::kOutline) out += " outline: true";
  if (piece.curve > 0) out += " curve: " + std::to_string(piece.curve);
  const double spacing =
      common.options.spacing.value_or(par == nullptr ? common.judged.spacing : 0);
  if (spacing > 0 && (piece.curve == 0 || !common.has_faces)) out += " spacing: " + Text(spacing);
  out += std::string(" } }\n  fractal {\n    method: \"") + MethodOf(piece.form) + "\"\n";
  if (par != nullptr) out += Knobs(*par);
  if (number > 0 && (par == nullptr || !par->seed)) {
    out += "    seed: " + std::to_string(number + 1) + "  # no two alike\n";
  }
  const bool relief = piece.form == Form::kRelief;
  if (relief || piece.form == Form::kClosedMesh) out += Amplitude(common.judged, par);
  if (relief && common.judged.level_border) {
    out += "    coast: true  # the border is level, so it stays a shore\n";
  }
  out += "  }\n";
  if (piece.closed) {
    out += "  material { color { r: 0.1 g: 0.2 b: 0.05 } fill: true }\n";
  } else if (common.has_colors && piece.curve == 0) {
    out += "  material { vertex_color: true }  # the file's own colours\n";
  }
  return out + "}\n";
}

}  // namespace

bool LooksTurned(const ShapeFile& shape) {
  if (shape.mesh.face_size.empty() && shape.curves.empty()) return false;
  const Vec3 size = Judge(shape).box.Size();
  return size.y < .5 * std::min(size.x, size.z);
}

Result<std::string> SceneTextFromShape(const ShapeFile& file, const std::string& shape_path,
                                       const ParFile* par, const std::string& par_path,
                                       const ImportOptions& options) {
  ShapeFile shape = file;
  TurnUp(options.up, &shape.mesh.points);
  for (Polyline& curve : shape.curves) TurnUp(options.up, &curve.points);
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
  if (!(judged.box.Extent() > 0)) {
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
  const Common common = {
      judged, shape_path, par, options, !shape.mesh.face_size.empty(), !shape.mesh.colors.empty()};
  const std::vector<Piece> pieces = PiecesOf(shape, judged);
  for (size_t k = 0; k < pieces.size(); ++k) {
    out += ObjectText(pieces[k], k, k == 0 ? name : name + "_" + std::to_string(k + 1), common);
  }
  return out;
}

}  // namespace fjord
