#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "client/commands/commands.h"
#include "client/console.h"
#include "client/exit_code.h"
#include "engine/fractal/registry.h"
#include "fjord/v1/scene.pb.h"

namespace fjord {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string name;
  bool json = false;
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
       {{"PNG8", "8 bits a sample, sRGB"},
        {"PNG16", "16 bits a sample, sRGB"},
        {"EXR_HALF", "linear light, 16-bit floats"},
        {"EXR_FLOAT", "linear light, 32-bit floats"}}},
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
       {{"SPHERE", "radius, segments, rings"},
        {"ELLIPSOID", "radii, segments, rings"},
        {"TORUS", "radius, tube, segments, rings"},
        {"BOX", "size, segments, rings"},
        {"GRID", "size, segments, rings; flat"}}},
  };
}

// "DIRECTION" names of settings.h are those of scene.proto; 0 is the default.
template <typename Enum>
std::string WordOf(const google::protobuf::EnumDescriptor* words, Enum value) {
  const auto* word = words->FindValueByNumber(static_cast<int>(value));
  return word == nullptr ? "?" : word->name();
}

template <typename Enum>
Json WordsOf(const google::protobuf::EnumDescriptor* words, std::span<const Enum> values) {
  Json list = Json::array();
  for (const Enum value : values) list.push_back(WordOf(words, value));
  return list;
}

Json DescribeMethod(const MethodInfo& method) {
  const FractalSettings& defaults = method.defaults;
  Json knobs = Json::array();
  for (const Knob& knob : AllKnobs()) {
    if (std::find(method.knobs.begin(), method.knobs.end(), knob.name) == method.knobs.end())
      continue;
    knobs.push_back({{"name", knob.name},
                     {"default", defaults.*knob.value},
                     {"lowest", knob.lowest},
                     {"highest", knob.highest},
                     {"effect", knob.effect}});
  }
  return {{"name", method.name},
          {"version", method.version},
          {"summary", method.summary},
          {"takes", method.takes == Takes::kCurve ? "a curve" : "triangles"},
          {"laws", WordsOf(v1::Fractal::Law_descriptor(), method.laws)},
          {"directions", WordsOf(v1::Fractal::Direction_descriptor(), method.directions)},
          {"variants", WordsOf(v1::Fractal::Variant_descriptor(), method.variants)},
          {"defaults",
           {{"law", WordOf(v1::Fractal::Law_descriptor(), defaults.law)},
            {"direction", WordOf(v1::Fractal::Direction_descriptor(), defaults.direction)},
            {"variant", WordOf(v1::Fractal::Variant_descriptor(), defaults.variant)}}},
          {"knobs", knobs}};
}

Json AllPresets() {
  Json all;
  Json methods = Json::array();
  for (const MethodInfo& method : FractalMethods()) methods.push_back(DescribeMethod(method));
  all["methods"] = std::move(methods);
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

std::string Shortest(const Json& number) { return number.dump(); }

std::string Joined(const Json& words) {
  std::string text;
  for (const Json& word : words) text += (text.empty() ? "" : ", ") + word.get<std::string>();
  return text;
}

std::string Padded(std::string text, size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text + " ";
}

std::string MethodText(const Json& method) {
  std::string text = method["name"].get<std::string>() + "  (version " + method["version"].dump() +
                     ", takes " + method["takes"].get<std::string>() + ")\n  " +
                     method["summary"].get<std::string>() + "\n";
  for (const char* list : {"laws", "directions", "variants"})
    text += "  " + Padded(list, 11) + Joined(method[list]) + "\n";
  const Json& defaults = method["defaults"];
  text += "  by default  " + defaults["law"].get<std::string>() + ", " +
          defaults["direction"].get<std::string>() + ", " + defaults["variant"].get<std::string>() +
          "\n";
  for (const Json& knob : method["knobs"]) {
    text += "  " + Padded(knob["name"].get<std::string>(), 11) +
            Padded(Shortest(knob["default"]), 7) +
            Padded(Shortest(knob["lowest"]) + " .. " + Shortest(knob["highest"]), 16) +
            knob["effect"].get<std::string>() + "\n";
  }
  return text;
}

std::string ListText(const std::string& name, const Json& list) {
  std::string text = name + "  (" + list["field"].get<std::string>() + ")\n";
  for (const Json& word : list["words"])
    text += "  " + Padded(word["name"].get<std::string>(), 12) + word["effect"].get<std::string>() +
            "\n";
  return text;
}

int RunPresets(const Options& options) {
  const Json all = AllPresets();
  Json chosen;
  std::string text;
  for (const Json& method : all["methods"]) {
    if (options.name.empty() || options.name == "methods" || options.name == method["name"]) {
      text += MethodText(method) + "\n";
      if (options.name == method["name"]) chosen = method;
    }
  }
  for (const auto& [name, list] : all.items()) {
    if (options.name == name) chosen = list;
    if (name != "methods" && (options.name.empty() || options.name == name))
      text += ListText(name, list) + "\n";
  }
  if (options.name.empty()) chosen = all;
  if (text.empty()) {
    std::string names;
    for (const Json& method : all["methods"]) names += " " + method["name"].get<std::string>();
    for (const auto& [name, list] : all.items()) names += " " + name;
    return console::Fail(MakeError(ErrorCode::kUsage,
                                   "there is no preset '" + options.name + "'; there are" + names));
  }
  text.pop_back();
  const Result<> printed = console::Print(options.json ? chosen.dump(1) + "\n" : text);
  return printed.ok() ? kExitDone : console::Fail(printed.error());
}

}  // namespace

void AddPresets(CLI::App& app, Run* run) {
  CLI::App* command =
      app.add_subcommand("presets", "Show methods, their knobs, and the words a scene may use");
  const auto options = std::make_shared<Options>();
  command->add_option("NAME", options->name, "One method or list; default all");
  command->add_flag("--json", options->json, "JSON on standard output");
  command->footer(
      "Knobs are shown with default, range and what one sees when the knob alone is turned up.\n\n"
      "Examples:\n"
      "  fjord presets\n"
      "  fjord presets surface\n"
      "  fjord presets easing");
  command->callback([options, run] { *run = [options] { return RunPresets(*options); }; });
}

}  // namespace fjord
