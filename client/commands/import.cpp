#include "engine/formats/import.h"

#include <filesystem>
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
};

// `path` as the scene shall name it: relative to the scene's folder where that is short, else
// whole.
std::string SeenFrom(const std::string& path, const std::string& scene) {
  std::error_code error;
  const fs::path folder = fs::absolute(fs::path(scene), error).parent_path();
  const fs::path relative = fs::relative(fs::absolute(path, error), folder, error);
  return error || relative.empty() ? fs::absolute(path).string() : relative.string();
}

int RunImport(const Options& options) {
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
  const Result<std::string> scene =
      SceneTextFromShape(*shape, SeenFrom(options.shape, options.output),
                         parameters ? &*parameters : nullptr, options.parameters);
  if (!scene.ok()) {
    Error error = scene.error();
    if (error.place.file.empty()) error.place.file = options.shape;
    return console::Fail(error);
  }
  if (const Result<> written = WriteFileAtomically(options.output, *scene); !written.ok())
    return console::Fail(written.error());
  console::Note("a scene to begin with: " + options.output);
  return kExitDone;
}

}  // namespace

void AddImport(CLI::App& app, Run* run) {
  CLI::App* command = app.add_subcommand("import", "Write a first scene for a shape file");
  const auto options = std::make_shared<Options>();
  command->add_option("FILE", options->shape, "A .std, .epf, .obj, .ply or .svg file")->required();
  command->add_option("PAR", options->parameters, "A .par file whose numbers become fractal knobs");
  command->add_option("-o,--output", options->output, "The scene")->required();
  command->footer(
      "Camera and light are set from the shape's bounds: what is written renders at once.\n\n"
      "Examples:\n"
      "  fjord import taiwan.std -o taiwan.scene\n"
      "  fjord import taiwan.std taiwan.par -o taiwan.scene");
  command->callback([options, run] { *run = [options] { return RunImport(*options); }; });
}

}  // namespace fjord
