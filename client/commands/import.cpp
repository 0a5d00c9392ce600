#include "engine/formats/import.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "client/commands/commands.h"
#include "client/console.h"
#include "client/exit_code.h"
#include "client/files.h"
#include "engine/image/codec.h"

namespace fjord {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string shape;
  std::string parameters;
  std::string output;
  UpAxis up = UpAxis::kZ;
  std::optional<double> spacing;
  bool force = false;
};

// Nothing that is there is written over without a word; the shape itself never is.
Result<> CheckOutput(const Options& options) {
  std::error_code error;
  if (!fs::exists(options.output, error)) return Ok{};
  for (const std::string& input : {options.shape, options.parameters}) {
    if (!input.empty() && fs::equivalent(input, options.output, error)) {
      return Invalid("-o names the file that is read; name another for the scene",
                     {options.output, 0, 0});
    }
  }
  if (options.force) return Ok{};
  return Invalid("the file exists already; name another with -o, or write over it with --force",
                 {options.output, 0, 0});
}

// `path` as the scene shall name it: relative to the scene's folder where that is short, else
// whole.
std::string SeenFrom(const std::string& path, const std::string& scene) {
  std::error_code error;
  const fs::path folder = fs::absolute(fs::path(scene), error).parent_path();
  const fs::path relative = fs::relative(fs::absolute(path, error), folder, error);
  return error || relative.empty() ? fs::absolute(path).string() : relative.string();
}

int RunImport(const Options& options) {
  if (const Result<> output = CheckOutput(options); !output.ok()) {
    return console::Fail(output.error());
  }
  const Result<std::string> bytes = ReadFile(options.shape);
  if (!bytes.ok()) return console::Fail(bytes.error());
  const Result<ShapeFile> shape = ReadShape(*bytes, options.shape);
  if (!shape.ok()) return console::Fail(shape.error());
  std::optional<ParFile> parameters;
  if (!options.parameters.empty()) {
    const Result<std::string> text = ReadFile(options.parameters);
    if (!text.ok()) return console::Fail(text.error());
    const Result<ParFile> read = ReadPar(*text, options.parameters);
    if (!read.ok()) return console::Fail(read.error());
    parameters = *read;
  }
  const Result<std::string> scene = SceneTextFromShape(
      *shape, SeenFrom(options.shape, options.output), parameters ? &*parameters : nullptr,
      options.parameters, {options.up, options.spacing});
  if (!scene.ok()) {
    Error error = scene.error();
    if (error.place.file.empty()) error.place.file = options.shape;
    return console::Fail(error);
  }
  if (const Result<> written = WriteFileAtomically(options.output, *scene); !written.ok())
    return console::Fail(written.error());
  console::Note("a scene to begin with: " + options.output);
  if (options.up == UpAxis::kZ && LooksTurned(*shape)) {
    console::Note("the shape is thin along y: where y is up in the file, import it with --up y");
  }
  return kExitDone;
}

}  // namespace

void AddImport(CLI::App& app, Run* run) {
  CLI::App* command = app.add_subcommand("import", "Write a first scene for a shape file");
  const auto options = std::make_shared<Options>();
  command->add_option("FILE", options->shape, "A .std, .epf, .obj, .ply or .svg file")->required();
  command->add_option("PAR", options->parameters, "A .par file whose numbers become fractal knobs");
  command->add_option("-o,--output", options->output, "The scene")->required();
  command
      ->add_option("--up", options->up,
                   "Which axis of the file is up: z (what Blender calls Z up), y (.obj as Blender "
                   "and Houdini write them) or x; default z in every format")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, UpAxis>{{"z", UpAxis::kZ}, {"y", UpAxis::kY}, {"x", UpAxis::kX}},
          CLI::ignore_case));
  command
      ->add_option("--spacing", options->spacing,
                   "Longest edge of the coarse shape: longer ones are divided and flat faces "
                   "triangulated evenly; 0: as it is. Default: where edges or triangles are so "
                   "uneven that the shape would have two looks")
      ->check(CLI::Range(0., 1e12));
  command->add_flag("--force", options->force, "Write over a scene that exists");
  command->footer(
      "Camera and light go by the shape: what is written renders at once, all of it in view.\n\n"
      "Examples:\n"
      "  fjord import taiwan.std -o taiwan.scene\n"
      "  fjord import taiwan.std taiwan.par -o taiwan.scene\n"
      "  fjord import from-blender.obj --up y -o mountain.scene");
  command->callback([options, run] { *run = [options] { return RunImport(*options); }; });
}

}  // namespace fjord
