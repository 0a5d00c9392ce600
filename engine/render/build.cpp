#include "engine/render/build.h"

#include <algorithm>
#include <bit>
#include <string>
#include <utility>

#include "engine/animation/coarse.h"
#include "engine/animation/frame_geometry.h"
#include "engine/animation/frame_key.h"
#include "engine/animation/walk.h"
#include "engine/base/fpenv.h"
#include "engine/fractal/plain.h"
#include "engine/fractal/registry.h"
#include "engine/render/view.h"

namespace fjord {
namespace {

using Doubles = google::protobuf::RepeatedField<double>;

constexpr uint32_t kLargestSide = 16384;
constexpr double kAbsurd = 1e15;

Error Inconsistent(const std::string& what) { return Invalid("frame scene: " + what); }

Result<Vec3> Three(const Doubles& values, const Vec3& otherwise, const char* what) {
  if (values.empty()) return otherwise;
  if (values.size() != 3) return Inconsistent(std::string(what) + " needs three numbers");
  for (const double v : values) {
    if (!(v >= -kAbsurd && v <= kAbsurd)) {
      return Inconsistent(std::string(what) + " is not finite or beyond 1e15");
    }
  }
  return Vec3(values[0], values[1], values[2]);
}

bool Finite(const Doubles& values) {
  for (const double v : values) {
    if (!(v >= -kAbsurd && v <= kAbsurd)) return false;
  }
  return true;
}

// Collects the first error of a list of assignments.
class Reader {
 public:
  Vec3 Vector(const Doubles& values, const Vec3& otherwise, const char* what) {
    Result<Vec3> three = Three(values, otherwise, what);
    if (three) return *three;
    Fail(three.error());
    return otherwise;
  }
  Rgb Color(const Doubles& values, const char* what) { return Rgb(Vector(values, Vec3(0), what)); }
  double Number(double value, double least, double most, const char* what) {
    if (value >= least && value <= most) return value;
    Fail(Inconsistent(std::string(what) + " is " + std::to_string(value) + ", outside " +
                      std::to_string(least) + ".." + std::to_string(most)));
    return least;
  }
  void Fail(Error error) {
    if (ok_) error_ = std::move(error);
    ok_ = false;
  }
  bool ok() const { return ok_; }
  const Error& error() const { return error_; }

 private:
  bool ok_ = true;
  Error error_;
};

Material MaterialOf(const v1::FrameMaterial& from, Reader* read) {
  Material material;
  material.color = read->Color(from.color(), "a material's color");
  material.ambient = static_cast<float>(read->Number(from.ambient(), 0, 1e6, "material.ambient"));
  material.diffuse = static_cast<float>(read->Number(from.diffuse(), 0, 1e6, "material.diffuse"));
  material.specular =
      static_cast<float>(read->Number(from.specular(), 0, 1e6, "material.specular"));
  material.shininess =
      static_cast<float>(read->Number(from.shininess(), 0, 1e4, "material.shininess"));
  material.smooth = from.smooth();
  material.vertex_color = from.vertex_color();
  material.line_width = read->Number(from.line_width(), 0, 4096, "material.line_width");
  material.fill = from.fill();
  if (from.ramp_size() % 4 != 0 || !Finite(from.ramp())) {
    read->Fail(Inconsistent("a ramp needs height r g b of each stop, all finite"));
    return material;
  }
  for (int i = 0; i < from.ramp_size(); i += 4) {
    const RampStop stop{from.ramp(i),
                        Rgb(Vec3(from.ramp(i + 1), from.ramp(i + 2), from.ramp(i + 3)))};
    if (i > 0 && stop.height < material.ramp.back().height) {
      read->Fail(Inconsistent("the heights of a ramp must ascend"));
    }
    material.ramp.push_back(stop);
  }
  return material;
}

// What decides how an object is prepared: all of it but where it stands and what it looks like, and
// the view where that is read.
Result<Digest> PreparedKey(const v1::FrameObject& object, const AdaptiveView& view) {
  v1::FrameObject part = object;
  part.clear_transform();
  part.clear_material();
  std::string bytes;
  if (Result<> walked = AppendWalk(part, bytes); !walked) return walked.error();
  if (part.fractal().split() == static_cast<uint32_t>(Split::kAdaptive)) {
    for (const double row : view.rows) AppendBigEndian(std::bit_cast<uint64_t>(row), bytes);
    AppendBigEndian(std::bit_cast<uint64_t>(view.near), bytes);
  }
  return Sha256Of(bytes);
}

Result<std::shared_ptr<const PreparedFractal>> Prepare(const CoarseShape& shape,
                                                       const FractalSettings& settings,
                                                       const AdaptiveView& view) {
  Result<std::unique_ptr<PreparedFractal>> prepared = MakeError(ErrorCode::kInternal, "");
  if (settings.method.empty()) {
    prepared = PreparePlain(shape, settings.seed);
  } else {
    const MethodInfo* method = FindFractalMethod(settings.method);
    if (method == nullptr) {
      return Inconsistent("there is no fractal method \"" + settings.method + "\"");
    }
    const Errors defects = CheckSettings(*method, settings);
    if (!defects.empty()) return defects.front();
    if ((method->takes == Takes::kCurve) != shape.curve) {
      return Inconsistent("the method \"" + settings.method + "\" takes " +
                          (shape.curve ? "meshes, not curves" : "curves, not meshes"));
    }
    prepared = method->prepare(shape, settings, &view);
  }
  if (!prepared) return prepared.error();
  return std::shared_ptr<const PreparedFractal>(std::move(*prepared));
}

bool Finite(const CoarseShape& shape) {
  const auto finite = [](const auto& list) {
    return std::all_of(list.begin(), list.end(), [](const auto& item) {
      for (int i = 0; i < 3; ++i) {
        if (!(item[i] >= -kAbsurd && item[i] <= kAbsurd)) return false;
      }
      return true;
    });
  };
  return finite(shape.now) && finite(shape.rest) && finite(shape.colors);
}

Result<PreparedObject> MakePrepared(const v1::FrameObject& from, const AssetResolver* assets,
                                    const AdaptiveView& view) {
  PreparedObject object;
  Result<CoarseShape> shape = CoarseShapeOf(from, assets);
  if (!shape) return shape.error();
  if (!Finite(*shape)) {
    return Inconsistent("an object's points and colours must be finite and below 1e15");
  }
  object.shape = std::make_shared<const CoarseShape>(std::move(*shape));
  if (from.has_fractal()) object.settings = FractalSettingsOf(from.fractal());
  auto prepared = Prepare(*object.shape, object.settings, view);
  if (!prepared) return prepared.error();
  object.prepared = std::move(*prepared);
  return object;
}

Result<BuiltObject> BuildObject(const v1::FrameObject& from, const AssetResolver* assets,
                                const View& view, PreparedCache& cache, Reader* read) {
  BuiltObject object;
  object.material = MaterialOf(from.material(), read);
  if (from.transform_size() == 12 && Finite(from.transform())) {
    for (int i = 0; i < 12; ++i) object.transform[i] = from.transform(i);
  } else if (from.transform_size() != 0) {
    read->Fail(Inconsistent("a transform needs 12 finite numbers"));
  }
  if (!read->ok()) return read->error();
  const AdaptiveView adaptive = MakeAdaptiveView(view, object.transform);
  const Result<Digest> key = PreparedKey(from, adaptive);
  if (!key) return key.error();
  auto prepared = cache.Get(*key, [&] { return MakePrepared(from, assets, adaptive); });
  if (!prepared) return prepared.error();
  object.prepared = (*prepared)->prepared;
  object.shape = (*prepared)->shape;
  object.settings = (*prepared)->settings;
  return object;
}

}  // namespace

Result<BuiltFrame> BuildFrame(const v1::FrameScene& from, const AssetResolver* assets,
                              PreparedCache& cache) {
  SetFloatEnvironment();
  BuiltFrame frame;
  Reader read;
  frame.width = from.output().width();
  frame.height = from.output().height();
  if (frame.width < 1 || frame.height < 1 || frame.width > kLargestSide ||
      frame.height > kLargestSide) {
    return MakeError(ErrorCode::kLimit, "frame scene: a picture of " + std::to_string(frame.width) +
                                            "x" + std::to_string(frame.height) +
                                            " pixels; 1x1 to 16384x16384 can be drawn");
  }
  if (from.output().format() > 3) return Inconsistent("unknown output format");
  frame.format = static_cast<PixelFormat>(from.output().format());
  frame.samples = from.output().samples();
  if (frame.samples != 1 && frame.samples != 4 && frame.samples != 16) {
    return Inconsistent("samples must be 1, 4 or 16, not " + std::to_string(frame.samples));
  }
  if (from.output().dither() != 0 && from.output().dither() != kDitherVersion) {
    return Inconsistent("unknown version of the dither");
  }
  frame.dither = from.output().dither() != 0 && frame.format == PixelFormat::kPng8;
  const v1::FrameCamera& camera = from.camera();
  frame.camera.eye = read.Vector(camera.eye(), Vec3(0), "camera.eye");
  frame.camera.look_at = read.Vector(camera.look_at(), Vec3(0), "camera.look_at");
  frame.camera.up = read.Vector(camera.up(), Vec3(0, 0, 1), "camera.up");
  frame.camera.orthographic = camera.orthographic();
  if (camera.orthographic()) {
    frame.camera.view_height =
        read.Number(camera.view_height(), 1e-12, kAbsurd, "camera.view_height");
    frame.camera.near = read.Number(camera.near(), -kAbsurd, kAbsurd, "camera.near");
  } else {
    frame.camera.fov = read.Number(camera.fov(), 1e-3, 179, "camera.fov");
    frame.camera.near = read.Number(camera.near(), 1e-12, kAbsurd, "camera.near");
  }
  if (from.background_size() == 6 && Finite(from.background())) {
    const auto& b = from.background();
    frame.background_top = Rgb(Vec3(b[0], b[1], b[2]));
    frame.background_bottom = Rgb(Vec3(b[3], b[4], b[5]));
  } else if (from.background_size() != 0) {
    return Inconsistent("background needs six finite numbers");
  }
  frame.ambient = read.Color(from.ambient(), "ambient");
  for (const v1::FrameLight& light : from.light()) {
    frame.lights.push_back({light.local(), read.Vector(light.place(), Vec3(0, 0, 1), "a light"),
                            read.Number(light.range(), 0, kAbsurd, "a light's range"),
                            read.Color(light.color(), "a light's color")});
  }
  if (from.has_sea()) {
    frame.sea =
        Sea{read.Number(from.sea().level(), -kAbsurd, kAbsurd, "sea.level"),
            read.Color(from.sea().color(), "sea.color"),
            static_cast<float>(read.Number(from.sea().specular(), 0, 1e6, "sea.specular")),
            static_cast<float>(read.Number(from.sea().shininess(), 0, 1e4, "sea.shininess"))};
  }
  if (!read.ok()) return read.error();
  const View view = MakeView(frame.camera, frame.width, frame.height);
  for (const v1::FrameObject& object : from.object()) {
    Result<BuiltObject> built = BuildObject(object, assets, view, cache, &read);
    if (!built) return built.error();
    frame.objects.push_back(std::move(*built));
  }
  return frame;
}

Result<std::shared_ptr<const PreparedFractal>> PrepareObject(const BuiltFrame& frame,
                                                             const BuiltObject& object,
                                                             double coarser) {
  SetFloatEnvironment();
  FractalSettings settings = object.settings;
  settings.fineness.epsilon *= coarser;
  settings.fineness.pixels *= coarser;
  const View view = MakeView(frame.camera, frame.width, frame.height);
  return Prepare(*object.shape, settings, MakeAdaptiveView(view, object.transform));
}

}  // namespace fjord
