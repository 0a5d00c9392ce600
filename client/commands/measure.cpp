#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "client/commands/commands.h"
#include "client/console.h"
#include "client/exit_code.h"
#include "client/files.h"
#include "engine/formats/shape_file.h"
#include "engine/fractal/measure_shape.h"

namespace fjord {
namespace {

struct Options {
  std::string file;
  bool json = false;
};

// Numbers and truth values as such, anything else as text.
nlohmann::ordered_json JsonOf(const std::string& value) {
  const nlohmann::ordered_json json = nlohmann::ordered_json::parse(value, nullptr, false);
  if (json.is_number() || json.is_boolean()) return json;
  if (value == "yes") return true;
  if (value == "no") return false;
  return value;
}

int RunMeasure(const Options& options) {
  const Result<std::string> bytes = ReadFile(options.file);
  if (!bytes.ok()) return console::Fail(bytes.error());
  const Result<ShapeFile> shape = ReadShape(*bytes, options.file);
  if (!shape.ok()) return console::Fail(shape.error());
  const ShapeMeasure measure = MeasureShape(shape->mesh, shape->curves);
  std::string text = measure.ToText();
  if (options.json) {
    nlohmann::ordered_json json = {{"file", options.file}};
    for (const auto& [name, value] : measure.Rows()) json[name] = JsonOf(value);
    text = json.dump(1) + "\n";
  }
  const Result<> printed = console::Print(text);
  return printed.ok() ? kExitDone : console::Fail(printed.error());
}

}  // namespace

void AddMeasure(CLI::App& app, Run* run) {
  CLI::App* command =
      app.add_subcommand("measure", "Measure a shape: dimension, H, counts, whether it is closed");
  const auto options = std::make_shared<Options>();
  command->add_option("FILE", options->file, "A .std, .epf, .obj, .ply or .svg file")->required();
  command->add_flag("--json", options->json, "JSON on standard output");
  command->footer(
      "Examples:\n"
      "  fjord measure taiwan.ply\n"
      "  fjord measure coast.svg --json");
  command->callback([options, run] { *run = [options] { return RunMeasure(*options); }; });
}

}  // namespace fjord
