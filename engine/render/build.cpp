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
#include "engine/fractal/height_field.h"
#include "engine/fractal/plain.h"
#include "engine/fractal/registry.h"
#include "engine/scene/parameters.h"
#include "engine/texture/registry.h"

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
  if (from.fading() != 0 && from.fading() != kFadingVersion) {
    read->Fail(Inconsistent("unknown version of fading strokes"));
  }
  material.fill = from.fill();
  material.fading =
      from.fading() != 0 && !material.fill && material.line_width > 0 && material.line_width < 1;
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

Result<std::shared_ptr<const TextureChain>> ChainOf(const v1::FrameMaterial& from) {
  auto chain = std::make_shared<TextureChain>();
  for (const v1::FrameStage& stage : from.stage()) {
    const StageInfo* info = FindTextureStage(stage.kind());
    if (info == nullptr) {
      return Inconsistent("there is no texture stage \"" + stage.kind() + "\"");
    }
    std::vector<KnobDefect> defects;
    const std::any own = info->knobs.Read(ValuesOf(stage.parameter()), info->name, &defects);
    if (!defects.empty()) {
      return Inconsistent("stage " + stage.kind() + "." + defects.front().knob + ": " +
                          defects.front().message);
    }
    AppendStage(*info, own, chain.get());
  }
  return std::shared_ptr<const TextureChain>(std::move(chain));
}

// What decides how an object is prepared: all of it but where it stands and what it looks like.
Result<Digest> PreparedKey(const v1::FrameObject& object) {
  v1::FrameObject part = object;
  part.clear_transform();
  part.clear_material();
  part.clear_uv();
  part.clear_uv_size();
  part.clear_placement();
  part.clear_placement_asset();
  std::string bytes;
  if (Result<> walked = AppendWalk(part, bytes); !walked) return walked.error();
  return Sha256Of(bytes);
}

Result<std::shared_ptr<const PreparedFractal>> Prepare(const CoarseShape& shape,
                                                       const MethodSettings& settings) {
  Result<std::unique_ptr<PreparedFractal>> prepared = MakeError(ErrorCode::kInternal, "");
  if (shape.heights) {
    if (!settings.method.empty()) return Inconsistent("heights are drawn without a fractal");
    prepared = PrepareHeights(*shape.heights, shape.heights_rest, settings.fineness, settings.seed);
  } else if (settings.method.empty()) {
    prepared = PreparePlain(shape, settings.seed);
  } else {
    const MethodInfo* method = FindFractalMethod(settings.method);
    FJORD_CHECK(method != nullptr, settings.method);
    if ((method->takes == Takes::kCurve) != shape.curve) {
      return Inconsistent("the method \"" + settings.method + "\" takes " +
                          (shape.curve ? "meshes, not curves" : "curves, not meshes"));
    }
    prepared = PrepareMethod(shape, settings);
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

Result<PreparedObject> MakePrepared(const v1::FrameObject& from, const AssetResolver* assets) {
  PreparedObject object;
  Takes takes = Takes::kTriangles;
  if (from.has_fractal()) {
    const MethodInfo* method = FindFractalMethod(from.fractal().method());
    if (method != nullptr) takes = method->takes;
  }
  Result<CoarseShape> shape = CoarseShapeOf(from, assets, takes);
  if (!shape) return shape.error();
  if (!Finite(*shape)) {
    return Inconsistent("an object's points and colours must be finite and below 1e15");
  }
  object.shape = std::make_shared<const CoarseShape>(std::move(*shape));
  if (from.has_fractal()) {
    Result<MethodSettings> settings = MethodSettingsOf(from.fractal());
    if (!settings) return settings.error();
    object.settings = std::move(*settings);
  }
  if (from.has_heights()) object.settings.fineness = FinenessOf(from.heights().fineness());
  auto prepared = Prepare(*object.shape, object.settings);
  if (!prepared) return prepared.error();
  object.prepared = std::move(*prepared);
  return object;
}

Result<BuiltObject> BuildObject(const v1::FrameObject& from, const AssetResolver* assets,
                                PreparedCache& cache, Reader* read) {
  BuiltObject object;
  object.material = MaterialOf(from.material(), read);
  if (from.transform_size() == 12 && Finite(from.transform())) {
    for (int i = 0; i < 12; ++i) object.transform[i] = from.transform(i);
  } else if (from.transform_size() != 0) {
    read->Fail(Inconsistent("a transform needs 12 finite numbers"));
  }
  if (from.uv() > static_cast<uint32_t>(UvKind::kBox)) return Inconsistent("unknown rule of (u,v)");
  object.uv = {static_cast<UvKind>(from.uv()), read->Vector(from.uv_size(), Vec3(1), "uv_size")};
  if (from.material().stage_size() > 0) {
    Result<std::shared_ptr<const TextureChain>> chain = ChainOf(from.material());
    if (!chain) return chain.error();
    object.texture = std::move(*chain);
  }
  if (!read->ok()) return read->error();
  Result<PlacementList> placements = PlacementsOf(from, assets);
  if (!placements) return placements.error();
  object.placements = std::move(*placements);
  const Result<Digest> key = PreparedKey(from);
  if (!key) return key.error();
  auto prepared = cache.Get(*key, [&] { return MakePrepared(from, assets); });
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
  for (const uint32_t layer : from.output().layer()) {
    constexpr uint32_t kDepth = 1;  // Output.DEPTH
    if (layer != kDepth) return Inconsistent("unknown output layer");
    if (FileEnding(frame.format) != std::string_view("exr")) {
      return Inconsistent("only EXR pictures have layers");
    }
    frame.depth_layer = true;
  }
  if (from.output().dither() != 0 && from.output().dither() != kDitherVersion) {
    return Inconsistent("unknown version of the dither");
  }
  frame.dither = from.output().dither() != 0 && frame.format == PixelFormat::kPng8;
  frame.alpha = from.output().alpha();
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
    frame.sky.top = Rgb(Vec3(b[0], b[1], b[2]));
    frame.sky.bottom = Rgb(Vec3(b[3], b[4], b[5]));
  } else if (from.background_size() != 0) {
    return Inconsistent("background needs six finite numbers");
  }
  if (from.sky() > 1) return Inconsistent("unknown kind of sky");
  frame.sky.kind = static_cast<SkyKind>(from.sky());
  if (from.has_haze()) {
    frame.haze = Haze{read.Color(from.haze().color(), "haze.color"),
                      read.Number(from.haze().density(), 0, 1e9, "haze.density")};
  }
  frame.instant = read.Number(from.instant(), -kAbsurd, kAbsurd, "instant");
  frame.ambient = read.Color(from.ambient(), "ambient");
  for (const v1::FrameLight& light : from.light()) {
    frame.lights.push_back({light.local(), read.Vector(light.place(), Vec3(0, 0, 1), "a light"),
                            read.Number(light.range(), 0, kAbsurd, "a light's range"),
                            read.Color(light.color(), "a light's color"),
                            read.Number(light.shadow(), 0, kAbsurd, "a light's shadow")});
    if (light.local() && light.shadow() > 0) {
      return Inconsistent("only directional lights have shadows");
    }
  }
  if (from.has_sea()) {
    frame.sea =
        Sea{read.Number(from.sea().level(), -kAbsurd, kAbsurd, "sea.level"),
            read.Color(from.sea().color(), "sea.color"),
            static_cast<float>(read.Number(from.sea().specular(), 0, 1e6, "sea.specular")),
            static_cast<float>(read.Number(from.sea().shininess(), 0, 1e4, "sea.shininess"))};
  }
  if (!read.ok()) return read.error();
  for (const v1::FrameObject& object : from.object()) {
    Result<BuiltObject> built = BuildObject(object, assets, cache, &read);
    if (!built) return built.error();
    frame.objects.push_back(std::move(*built));
  }
  return frame;
}

Result<std::shared_ptr<const PreparedFractal>> PrepareObject(const BuiltObject& object,
                                                             double coarser) {
  SetFloatEnvironment();
  MethodSettings settings = object.settings;
  settings.fineness.epsilon *= coarser;
  settings.fineness.pixels *= coarser;
  const std::optional<HeightField>& heights = object.shape->heights;
  if (heights && settings.fineness.epsilon <= 0 && settings.fineness.focal <= 0) {
    settings.fineness.epsilon = coarser * heights->size.x / heights->source->columns();
  }
  return Prepare(*object.shape, settings);
}

}  // namespace fjord
