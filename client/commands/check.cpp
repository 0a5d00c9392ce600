#include <atomic>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "client/budget.h"
#include "client/commands/commands.h"
#include "client/commands/common.h"
#include "client/console.h"
#include "client/exit_code.h"
#include "client/files.h"
#include "client/interrupt.h"
#include "client/look_ahead.h"
#include "client/progress.h"
#include "engine/animation/check_animation.h"
#include "engine/formats/par_file.h"
#include "engine/formats/shape_file.h"
#include "engine/geometry/check_mesh.h"

namespace fjord {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> files;
  std::string budget;
  SceneChanges changes;
  bool animation = false;
  bool json = false;
};

Errors CheckShape(const std::string& path) {
  const Result<std::string> bytes = ReadFile(path);
  if (!bytes.ok()) return {bytes.error()};
  const Result<ShapeFile> shape = ReadShape(*bytes, path);
  if (!shape.ok()) return {shape.error()};
  for (const ShapeNote& note : shape->notes) {
    console::Note(note.place.ToString() + ": note: " + note.message);
  }
  Errors errors;
  for (const MeshDefect& defect : CheckMesh(shape->mesh)) {
    Place place{path, 0, 0};
    if (defect.face > 0 && defect.face <= shape->face_line.size())
      place.line = shape->face_line[defect.face - 1];
    else if (defect.vertex > 0 && defect.vertex <= shape->vertex_line.size())
      place.line = shape->vertex_line[defect.vertex - 1];
    if (place.line > 0) place.column = 1;
    errors.push_back(Invalid(defect.message, place));
  }
  return errors;
}

Errors CheckParameters(const std::string& path) {
  const Result<std::string> bytes = ReadFile(path);
  if (!bytes.ok()) return {bytes.error()};
  const Result<ParFile> parameters = ReadPar(*bytes, path);
  return parameters.ok() ? Errors{} : Errors{parameters.error()};
}

using Json = nlohmann::ordered_json;

Json ObjectJson(const ObjectCheck& object) {
  return {{"object", object.object},
          {"good", object.good},
          {"vertices", object.vertices},
          {"coarser", object.coarser},
          {"identities_change", object.identities_change},
          {"largest_step", object.largest_step},
          {"coarse_step", object.coarse_step},
          {"proportion", object.proportion},
          {"worst_frame", object.worst_frame},
          {"pops", object.pops},
          {"verdict", object.verdict}};
}

// Every frame's shapes, made and compared. What was found goes into `found`.
Errors CheckMotion(const std::string& path, const Animation& animation, bool quiet, Json* found) {
  FrameProgress progress(path, animation.last_frame() - animation.first_frame() + uint64_t{1},
                         FrameProgress::Console());
  AnimationCheckOptions options;
  const std::atomic<bool>& interrupted = CatchInterrupts();
  options.progress = [&](uint32_t) {
    progress.FrameDone();
    return !interrupted.load();
  };
  const Result<AnimationCheck> check = CheckAnimation(animation, options);
  if (!check.ok()) return {InScene(check.error(), path)};
  Errors errors;
  for (const ObjectCheck& object : check->objects) {
    found->push_back(ObjectJson(object));
    const std::string line = "object " + object.object + ": " + object.verdict;
    if (!object.good)
      errors.push_back(Invalid(line, {path, 0, 0}));
    else if (!quiet)
      console::Note(path + ": " + line);
  }
  return errors;
}

Json EstimateJson(const ObjectEstimate& estimate) {
  return {{"leaves", estimate.leaves}, {"in_view", estimate.in_view}};
}

// What the largest of some frames will make, by estimate; an error where that is too much.
Errors CheckCost(const std::string& path, const Animation& animation, const Options& options,
                 const std::vector<Setting>& settings, Json* found) {
  const Result<double> budget = ParseBudget(options.budget, kFrameBudget);
  if (!budget.ok()) return {budget.error()};
  LookAhead ahead;
  const Result<> held =
      LookAtFrames(animation, FrameSet(animation.first_frame(), animation.last_frame()), *budget,
                   {path, settings}, &ahead);
  const FrameEstimate& worst = ahead.worst;
  *found = EstimateJson(worst.all);
  Json objects = Json::array();
  for (size_t i = 0; i < worst.objects.size(); ++i) {
    objects.push_back(EstimateJson(worst.objects[i]));
    objects.back()["object"] = animation.scene().objects(static_cast<int>(i)).name();
  }
  (*found)["objects"] = std::move(objects);
  if (!held.ok()) return {held.error()};
  if (!ahead.advice.empty()) (*found)["advice"] = ahead.advice;
  if (!ahead.advice.empty() && !options.json) console::Note(ahead.advice);
  if (!options.json) {
    console::Note(path + ": at most about " + LeavesText(worst.all.in_view) +
                  " triangles and segments in a frame's picture, " + LeavesText(worst.all.leaves) +
                  " in its shapes");
  }
  return {};
}

// What is found besides defects.
struct Found {
  Json motion = Json::array();
  Json estimate;
};

// Defects of the shapes that a scene names, which render may do without but their fractals show:
// cracks, slivers, sides turned in.
Errors CheckShapesOf(const std::string& path, const v1::Scene& scene) {
  const fs::path folder = fs::path(path).parent_path();
  std::set<std::string> seen;
  Errors errors;
  const auto look = [&](const v1::Shape& shape) {
    const v1::File& file = shape.file();
    if (file.path().empty() || file.curve() > 0 || !seen.insert(file.path()).second) return;
    for (Error& error : CheckShape((folder / file.path()).string())) {
      errors.push_back(std::move(error));
    }
  };
  for (const v1::Object& object : scene.objects()) {
    if (object.has_shape()) look(object.shape());
    for (const v1::Key& key : object.key()) look(key.shape());
  }
  return errors;
}

Errors CheckScene(const std::string& path, const Options& options, Found* found) {
  const Result<std::vector<Setting>> settings = SettingsOf(options.changes, path);
  if (!settings.ok()) return {settings.error()};
  OpenedScene scene;
  Errors errors = OpenScene(path, *settings, &scene);
  if (!errors.empty()) return errors;
  errors = CheckShapesOf(path, scene.animation->scene());
  const auto add = [&](const Errors& more) {
    errors.insert(errors.end(), more.begin(), more.end());
    return more.empty();
  };
  const bool affordable =
      add(CheckCost(path, *scene.animation, options, *settings, &found->estimate));
  if (affordable && options.animation) {
    add(CheckMotion(path, *scene.animation, options.json, &found->motion));
  }
  return errors;
}

Errors CheckFile(const std::string& path, const Options& options, Found* found) {
  if (path.ends_with(".par")) return CheckParameters(path);
  if (ShapeFormatOf(path).ok()) return CheckShape(path);
  return CheckScene(path, options, found);
}

// A line a defect: what `check` is asked for, so it goes to standard output.
std::string ReportOf(const std::string& path, const Errors& errors) {
  if (errors.empty()) return path + ": good\n";
  std::string report;
  for (const Error& error : errors) report += error.ToString() + "\n";
  return report;
}

int RunCheck(const Options& options) {
  if (const Result<double> budget = ParseBudget(options.budget, kFrameBudget); !budget.ok())
    return console::Fail(budget.error());
  Json list = Json::array();
  int code = kExitDone;
  for (const std::string& path : options.files) {
    Found found;
    const Errors errors = CheckFile(path, options, &found);
    Json defects = Json::array();
    for (const Error& error : errors) {
      code = kExitFailed;
      defects.push_back({{"file", error.place.file.empty() ? path : error.place.file},
                         {"line", error.place.line},
                         {"column", error.place.column},
                         {"message", error.message}});
    }
    list.push_back({{"file", path}, {"good", errors.empty()}, {"defects", std::move(defects)}});
    if (!found.estimate.is_null()) list.back()["estimate"] = std::move(found.estimate);
    if (options.animation) list.back()["animation"] = std::move(found.motion);
    if (options.json) continue;
    const Result<> printed = console::Print(ReportOf(path, errors));
    if (!printed.ok()) return console::Fail(printed.error());
  }
  if (options.json) {
    const Result<> printed =
        console::Print(list.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
    if (!printed.ok()) return console::Fail(printed.error());
  }
  return code;
}

}  // namespace

void AddCheck(CLI::App& app, Run* run) {
  CLI::App* command =
      app.add_subcommand("check", "Check scenes, shapes and parameter files; name every defect");
  const auto options = std::make_shared<Options>();
  command->add_option("FILE", options->files, "Scenes, .std .epf .obj .ply .svg shapes, .par files")
      ->required();
  command->add_flag("--animation", options->animation,
                    "Make every frame's shapes too: the same vertices in each, and no jumps");
  AddBudget(command, &options->budget);
  AddSceneChanges(command, &options->changes);
  command->add_flag("--json", options->json, "A list as JSON on standard output");
  command->footer(
      "A defect is a line FILE:LINE:COLUMN: error: what is wrong, on standard output. Exit code 1 "
      "where there is one, or where a file can not be read.\n\n"
      "Examples:\n"
      "  fjord check examples/*.scene\n"
      "  fjord check --animation examples/taiwan-rising.scene\n"
      "  fjord check island.scene --set objects[island].fractal.pixels=1\n"
      "  fjord check coast.std");
  command->callback([options, run] { *run = [options] { return RunCheck(*options); }; });
}

}  // namespace fjord
