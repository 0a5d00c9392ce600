#include <google/protobuf/descriptor.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "client/commands/commands.h"
#include "client/console.h"
#include "client/entry_docs.h"
#include "client/exit_code.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string name;
  bool json = false;
  bool markdown = false;
  bool schema = false;
};

// The lists of words a scene may use, from the one definition.
struct WordList {
  const char* name;
  const char* where;
  const google::protobuf::EnumDescriptor* words;
  std::map<std::string, std::string> effects;
};

std::vector<WordList> WordLists() {
  return {
      {"formats",
       "output.format",
       v1::Output::Format_descriptor(),
       {{"PNG8", "8 bits a sample, sRGB; with output.alpha straight"},
        {"PNG16", "16 bits a sample, sRGB; with output.alpha straight"},
        {"EXR_HALF", "linear light, 16-bit floats; with output.alpha associated"},
        {"EXR_FLOAT", "linear light, 32-bit floats; with output.alpha associated"}}},
      {"easing",
       "ease of keys and track keys",
       v1::Key::Ease_descriptor(),
       {{"LINEAR", "even speed"},
        {"SMOOTH", "slow out, slow in"},
        {"IN", "starts slowly"},
        {"OUT", "ends slowly"},
        {"HOLD", "stays until the next key"}}},
      {"lights",
       "lights.kind",
       v1::Light::Kind_descriptor(),
       {{"DIRECTIONAL", "far away, as the sun: direction points from the scene to the light"},
        {"LOCAL", "at position; falls off as (1 - distance / range)^2, nothing beyond range"}}},
      {"paths",
       "path.kind",
       v1::Path::Kind_descriptor(),
       {{"STRAIGHT", "the straight way"},
        {"STEER", "a Bezier curve, bent by the control points"},
        {"THROUGH", "passes the control points at even times"},
        {"SPLINE", "smooth through three or more keys"}}},
      {"correspondence",
       "objects.correspondence",
       v1::Correspondence_descriptor(),
       {{"BY_INDEX", "vertex n with vertex n; equal counts"},
        {"BY_PAIRS", "as the keys' pairs say"},
        {"COMPUTED", "found for outlines of any point counts"}}},
      {"primitives",
       "shape.primitive.kind",
       v1::Primitive::Kind_descriptor(),
       {{"SPHERE", "radius, base, segments, rings"},
        {"ELLIPSOID", "radii, base, segments, rings"},
        {"TORUS", "radius, tube, segments, rings"},
        {"BOX", "size, segments, rings"},
        {"GRID", "size, segments, rings; flat"}}},
  };
}

Json AllPresets() {
  Json all;
  for (const EntryKind& kind : EntryKinds()) {
    Json& entries = all[std::string(kind.name)] = Json::array();
    for (const EntryInfo* info : kind.entries()) entries.push_back(EntryJson(*info));
  }
  for (const WordList& list : WordLists()) {
    Json words = Json::array();
    for (int i = 0; i < list.words->value_count(); ++i) {
      const std::string& word = list.words->value(i)->name();
      const auto effect = list.effects.find(word);
      words.push_back(
          {{"name", word}, {"effect", effect == list.effects.end() ? "" : effect->second}});
    }
    all[list.name] = {{"field", list.where}, {"words", std::move(words)}};
  }
  return all;
}

std::string Padded(std::string text, size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text + " ";
}

std::string ListText(const std::string& name, const Json& list) {
  std::string text = name + "  (" + list["field"].get<std::string>() + ")\n";
  for (const Json& word : list["words"])
    text += "  " + Padded(word["name"].get<std::string>(), 12) + word["effect"].get<std::string>() +
            "\n";
  return text;
}

Result<std::string> PresetsText(const Options& options) {
  if (options.schema) return SceneSchema().dump(1) + "\n";
  const Json all = AllPresets();
  Json chosen;
  std::string text, names;
  for (const EntryKind& kind : EntryKinds()) {
    const bool whole = options.name.empty() || options.name == kind.name;
    names.append(" ").append(kind.name);
    if (options.markdown && whole) text += KindMarkdown(kind);
    if (options.name == kind.name) chosen = all[std::string(kind.name)];
    for (const EntryInfo* info : kind.entries()) {
      names.append(" ").append(info->name);
      if (options.name == info->name) chosen = EntryJson(*info);
      if (!options.markdown && (whole || options.name == info->name))
        text += EntryText(kind, *info) + "\n";
    }
  }
  for (const WordList& list : WordLists()) {
    names.append(" ").append(list.name);
    if (options.name == list.name) chosen = all[list.name];
    if (!options.markdown && (options.name.empty() || options.name == list.name))
      text += ListText(list.name, all[list.name]) + "\n";
  }
  if (options.name.empty()) chosen = all;
  if (text.empty() && chosen.is_null()) {
    return MakeError(ErrorCode::kUsage,
                     "there is no preset '" + options.name + "'; there are" + names);
  }
  if (!text.empty()) text.pop_back();
  return options.json ? chosen.dump(1) + "\n" : text;
}

int RunPresets(const Options& options) {
  const Result<std::string> text = PresetsText(options);
  if (!text) return console::Fail(text.error());
  const Result<> printed = console::Print(*text);
  return printed.ok() ? kExitDone : console::Fail(printed.error());
}

}  // namespace

void AddPresets(CLI::App& app, Run* run) {
  CLI::App* command =
      app.add_subcommand("presets", "Show methods, their knobs, and the words a scene may use");
  const auto options = std::make_shared<Options>();
  command->add_option("NAME", options->name,
                      "One kind of entry, one entry or one list of words; default all");
  CLI::Option* json = command->add_flag("--json", options->json, "JSON on standard output");
  CLI::Option* markdown =
      command->add_flag("--markdown", options->markdown, "Tables for the documentation");
  CLI::Option* schema = command->add_flag("--schema", options->schema,
                                          "A JSON Schema of scenes in JSON, for editors");
  json->excludes(markdown)->excludes(schema);
  markdown->excludes(schema);
  command->footer(
      "Knobs are shown with default, range and what one sees when the knob alone is turned up.\n\n"
      "Examples:\n"
      "  fjord presets\n"
      "  fjord presets surface\n"
      "  fjord presets fractal --json\n"
      "  fjord presets --schema > scene.schema.json\n"
      "  fjord presets easing");
  command->callback([options, run] { *run = [options] { return RunPresets(*options); }; });
}

}  // namespace fjord
