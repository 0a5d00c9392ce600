#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "client/budget.h"
#include "client/commands/commands.h"
#include "client/commands/common.h"
#include "client/console.h"
#include "client/exit_code.h"
#include "engine/formats/shape_file.h"
#include "engine/image/codec.h"
#include "engine/render/build.h"
#include "engine/render/frame_renderer.h"
#include "engine/render/places.h"
#include "engine/render/view.h"

namespace fjord {
namespace {

// All of it is kept in memory, about 100 bytes a triangle.
constexpr double kWeldBudget = 1e8;

struct Options {
  std::string scene;
  uint32_t frame = 0;
  std::string output;
  std::string object;
  SceneChanges changes;
  std::string budget;
  uint64_t max_points = WeldLimits().max_points;
};

void AppendMesh(Mesh part, const Transform& transform, bool keep_colors, Mesh* whole) {
  if (!keep_colors) part.colors = {};
  if (whole->points.empty()) {
    *whole = std::move(part);
    for (Vec3& point : whole->points) point = Apply(transform, point);
    return;
  }
  const auto offset = static_cast<uint32_t>(whole->points.size());
  whole->points.reserve(offset + part.points.size());
  for (const Vec3& point : part.points) whole->points.push_back(Apply(transform, point));
  whole->face_size.insert(whole->face_size.end(), part.face_size.begin(), part.face_size.end());
  whole->face_vertex.reserve(whole->face_vertex.size() + part.face_vertex.size());
  for (const uint32_t vertex : part.face_vertex) whole->face_vertex.push_back(vertex + offset);
  whole->colors.insert(whole->colors.end(), part.colors.begin(), part.colors.end());
}

std::vector<Transform> PlacesOf(const BuiltObject& object) {
  if (object.placements.empty()) return {object.transform};
  std::vector<Transform> places;
  for (const Transform& placement : object.placements) {
    places.push_back(Composed(placement, object.transform));
  }
  return places;
}

// All chosen objects of the frame, fractalized, in the scene's space.
Result<ShapeFile> Weld(const BuiltFrame& frame, const v1::Scene& scene, const Options& options) {
  ShapeFile shape;
  bool all_colored = true;
  for (const BuiltObject& object : frame.objects)
    all_colored = all_colored && object.shape->colors.size() == object.shape->now.size();
  for (size_t i = 0; i < frame.objects.size(); ++i) {
    const std::string& name = scene.objects(static_cast<int>(i)).name();
    if (!options.object.empty() && name != options.object) continue;
    const BuiltObject& object = frame.objects[i];
    Result<WeldedShape> welded =
        object.prepared->Weld({.max_points = options.max_points, .threads = 0, .details = false});
    if (!welded.ok()) {
      return MakeError(welded.error().code, "object " + name + ": " + welded.error().message,
                       {options.scene, 0, 0});
    }
    const std::vector<Transform> places = PlacesOf(object);
    if (welded->mesh.points.size() * places.size() > options.max_points) {
      return MakeError(ErrorCode::kLimit,
                       "object " + name + ": " + std::to_string(places.size()) +
                           " placements have more than " + std::to_string(options.max_points) +
                           " points together",
                       {options.scene, 0, 0});
    }
    for (const Transform& place : places) {
      if (welded->curve) {
        Polyline curve{{}, welded->closed};
        for (const Vec3& point : welded->mesh.points) curve.points.push_back(Apply(place, point));
        shape.curves.push_back(std::move(curve));
      } else if (&place == &places.back()) {
        AppendMesh(std::move(welded->mesh), place, all_colored, &shape.mesh);
      } else {
        AppendMesh(welded->mesh, place, all_colored, &shape.mesh);
      }
    }
  }
  return shape;
}

Result<> CheckObject(const Options& options, const v1::Scene& scene) {
  if (options.object.empty()) return Ok{};
  std::string names;
  for (const v1::Object& object : scene.objects()) {
    if (object.name() == options.object) return Ok{};
    names += " " + object.name();
  }
  return MakeError(ErrorCode::kUsage,
                   "there is no object '" + options.object + "'; there are" + names,
                   {options.scene, 0, 0});
}

int RunFractalize(const Options& options) {
  const Result<ShapeFormat> format = ShapeFormatOf(options.output);
  if (!format.ok()) return console::Fail(format.error());
  const Result<std::vector<Setting>> settings = SettingsOf(options.changes, options.scene);
  if (!settings.ok()) return console::Fail(settings.error());
  const Result<double> budget = ParseBudget(options.budget, kWeldBudget);
  if (!budget.ok()) return console::Fail(budget.error());
  OpenedScene scene;
  if (const Errors errors = OpenScene(options.scene, *settings, &scene); !errors.empty())
    return console::Fail(errors);
  if (const Result<> named = CheckObject(options, scene.animation->scene()); !named.ok())
    return console::Fail(named.error());
  const Result<FrameSet> within =
      WithinAnimation(FrameSet(options.frame, options.frame), scene.animation->first_frame(),
                      scene.animation->last_frame(), options.scene);
  if (!within.ok()) return console::Fail(within.error());

  AssetSet assets;
  const Result<v1::FrameScene> frame = scene.animation->Inbetween(options.frame, &assets);
  if (!frame.ok()) return console::Fail(InScene(frame.error(), options.scene));
  if (const Result<> held = CheckFrameBudget(*scene.animation, *frame, &assets, options.frame,
                                             *budget, Counted::kWhole, {options.scene, *settings});
      !held.ok())
    return console::Fail(held.error());
  const Result<BuiltFrame> built = BuildFrame(*frame, &assets);
  if (!built.ok()) return console::Fail(InScene(built.error(), options.scene));
  const Result<ShapeFile> shape = Weld(*built, scene.animation->scene(), options);
  if (!shape.ok()) return console::Fail(shape.error());
  const Result<PictureInfo> info = DescribeFrame(*frame);
  if (!info.ok()) return console::Fail(info.error());
  std::vector<std::string> comment{scene.animation->scene().name() + ", frame " +
                                   std::to_string(options.frame) + ", made by Fjord"};
  for (const auto& [name, value] : *info) comment.push_back(name + ": " + value);
  const Result<std::string> bytes = WriteShape(*shape, *format, comment);
  if (!bytes.ok()) return console::Fail(bytes.error());
  if (const Result<> written = WriteFileAtomically(options.output, *bytes); !written.ok())
    return console::Fail(written.error());
  size_t points = shape->mesh.points.size();
  for (const Polyline& curve : shape->curves) points += curve.points.size();
  console::Note(std::to_string(points) + " points, " + std::to_string(shape->mesh.FaceCount()) +
                " faces: " + options.output);
  return kExitDone;
}

}  // namespace

void AddFractalize(CLI::App& app, Run* run) {
  CLI::App* command =
      app.add_subcommand("fractalize", "Write the fractal shapes of one frame to a file");
  const auto options = std::make_shared<Options>();
  command->add_option("SCENE", options->scene, "Scene file")->required();
  command->add_option("--frame", options->frame, "Frame number, from 1")
      ->required()
      ->check(CLI::Range(1u, 1000000u));
  command->add_option("-o,--output", options->output, "A .obj, .ply, .std, .epf or .svg file")
      ->required();
  command->add_option("--object", options->object, "This object only; default all together");
  command->add_option("--max-points", options->max_points, "Give up beyond so many points")
      ->capture_default_str();
  AddBudget(command, &options->budget, "1e8");
  AddSets(command, &options->changes);
  command->footer(
      "Seed and every parameter are in the file's comment lines.\n\n"
      "Examples:\n"
      "  fjord fractalize examples/taiwan-rising.scene --frame 96 -o taiwan.ply\n"
      "  fjord fractalize coast.scene --frame 1 -o coast.svg --set objects[coast].fractal.seed=7");
  command->callback([options, run] { *run = [options] { return RunFractalize(*options); }; });
}

}  // namespace fjord
