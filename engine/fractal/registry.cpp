#include "engine/fractal/registry.h"

#include <sstream>

#include "engine/base/random.h"
#include "engine/fractal/coast.h"
#include "engine/fractal/curve.h"
#include "engine/fractal/surface.h"

namespace fjord {
namespace {

constexpr uint32_t kMaxLevel = 40;
constexpr double kLowestSimilarH = .06;

constexpr std::string_view kSurfaceKnobs[] = {"H",    "sigma",   "amplitude",
                                              "move", "perturb", "coast_H"};
constexpr std::string_view kLineKnobs[] = {"H", "sigma", "amplitude", "move", "perturb"};
constexpr Law kAllLaws[] = {Law::kAffine, Law::kSimilar, Law::kShih};
constexpr Direction kSurfaceDirections[] = {Direction::kEdge, Direction::kFace, Direction::kVertex,
                                            Direction::kUp};
constexpr Direction kCurveDirections[] = {Direction::kEdge, Direction::kVertex, Direction::kUp};
constexpr Direction kCoastDirections[] = {Direction::kEdge, Direction::kVertex};
constexpr Variant kAllVariants[] = {Variant::kFixed, Variant::kCurrent, Variant::kPerturbed};
constexpr Split kAllSplits[] = {Split::kShot, Split::kAdaptive, Split::kLength};

FractalSettings Defaults(std::string_view name, Law law, Direction direction, Variant variant,
                         double H) {
  FractalSettings settings;
  settings.method = name;
  settings.law = law;
  settings.direction = direction;
  settings.variant = variant;
  settings.H = H;
  return settings;
}

std::span<const MethodInfo> Methods() {
  static const MethodInfo kMethods[] = {
      {.name = "surface",
       .version = 3,
       .summary = "triangle meshes roughened by midpoint displacement: terrain, planets, any solid",
       .takes = Takes::kTriangles,
       .defaults = Defaults("surface", Law::kAffine, Direction::kVertex, Variant::kFixed, .7),
       .knobs = kSurfaceKnobs,
       .laws = kAllLaws,
       .directions = kSurfaceDirections,
       .variants = kAllVariants,
       .splits = kAllSplits,
       .additions = false,
       .prepare = PrepareSurface},
      {.name = "coast",
       .version = 3,
       .summary = "meshes whose border becomes a coastline, cut into triangles inside it",
       .takes = Takes::kTriangles,
       .defaults = Defaults("coast", Law::kSimilar, Direction::kEdge, Variant::kPerturbed, .75),
       .knobs = kLineKnobs,
       .laws = kAllLaws,
       .directions = kCoastDirections,
       .variants = kAllVariants,
       .splits = kAllSplits,
       .additions = false,
       .prepare = PrepareCoast},
      {.name = "curve",
       .version = 3,
       .summary = "lines roughened by midpoint displacement: coastlines, ridges, charts, cracks",
       .takes = Takes::kCurve,
       .defaults = Defaults("curve", Law::kSimilar, Direction::kVertex, Variant::kPerturbed, .75),
       .knobs = kLineKnobs,
       .laws = kAllLaws,
       .directions = kCurveDirections,
       .variants = kAllVariants,
       .splits = kAllSplits,
       .additions = true,
       .prepare = PrepareCurve},
  };
  return kMethods;
}

template <typename T>
bool Has(std::span<const T> list, T value) {
  for (const T& item : list) {
    if (item == value) {
      return true;
    }
  }
  return false;
}

template <typename T, typename NameOf>
std::string Names(std::span<const T> list, NameOf name_of) {
  std::string names;
  for (const T& item : list) {
    names += (names.empty() ? "" : ", ") + std::string(name_of(item));
  }
  return names;
}

std::string OutOfRange(std::string_view field, double value, const MethodInfo& method,
                       double lowest, double highest) {
  std::ostringstream text;
  text << field << " is " << value << "; " << method.name << " takes " << lowest << " to "
       << highest;
  return text.str();
}

// Not a NaN, and within the range.
bool Within(double value, double lowest, double highest) {
  return value >= lowest && value <= highest;
}

void CheckNumbers(const MethodInfo& method, const FractalSettings& s,
                  std::vector<SettingDefect>* defects) {
  for (const Knob& knob : AllKnobs()) {
    const double value = s.*knob.value;
    if (Has(method.knobs, knob.name) && !Within(value, knob.lowest, knob.highest)) {
      defects->push_back(
          {knob.name, OutOfRange(knob.name, value, method, knob.lowest, knob.highest)});
    }
  }
  if (s.max_level > kMaxLevel) {
    defects->push_back({"max_level", OutOfRange("max_level", s.max_level, method, 0, kMaxLevel)});
  }
  if (!Within(s.uniforms, 1, kMaxUniforms)) {
    defects->push_back({"uniforms", OutOfRange("uniforms", s.uniforms, method, 1, kMaxUniforms)});
  }
}

void CheckChoices(const MethodInfo& method, const FractalSettings& s,
                  std::vector<SettingDefect>* defects) {
  const auto refuse = [&](std::string_view field, std::string_view value,
                          const std::string& known) {
    defects->push_back({field, std::string(field) + " " + std::string(value) + " is not one of " +
                                   std::string(method.name) + "'s: " + known});
  };
  if (!Has(method.laws, s.law)) {
    refuse("law", LawName(s.law), Names(method.laws, LawName));
  }
  if (!Has(method.directions, s.direction)) {
    refuse("direction", DirectionName(s.direction), Names(method.directions, DirectionName));
  }
  if (!Has(method.variants, s.variant)) {
    refuse("variant", VariantName(s.variant), Names(method.variants, VariantName));
  }
  if (!Has(method.splits, s.split)) {
    refuse("split", SplitName(s.split), Names(method.splits, SplitName));
  }
  if (s.law == Law::kSimilar && Within(s.H, 0, kLowestSimilarH) && s.H < kLowestSimilarH) {
    defects->push_back(
        {"H", OutOfRange("H", s.H, method, kLowestSimilarH, 1) + " with law SIMILAR"});
  }
  if (s.increments == Increments::kAdditions) {
    if (!method.additions) {
      defects->push_back({"increments", "increments ADDITIONS is not known to " +
                                            std::string(method.name) + "; curve has it"});
    } else if (s.law != Law::kAffine || s.direction != Direction::kEdge ||
               s.variant != Variant::kFixed) {
      defects->push_back({"increments",
                          "increments ADDITIONS goes with law AFFINE, direction EDGE and variant "
                          "FIXED only"});
    }
  }
}

}  // namespace

std::span<const MethodInfo> FractalMethods() { return Methods(); }

const MethodInfo* FindFractalMethod(std::string_view name) {
  for (const MethodInfo& method : Methods()) {
    if (method.name == name) {
      return &method;
    }
  }
  return nullptr;
}

FractalSettings ResolveSettings(const MethodInfo& method, FractalSettings settings) {
  settings.method = method.name;
  if (settings.law == Law::kDefault) {
    settings.law = method.defaults.law;
  }
  if (settings.direction == Direction::kDefault) {
    settings.direction = method.defaults.direction;
  }
  if (settings.variant == Variant::kDefault) {
    settings.variant = method.defaults.variant;
  }
  if (settings.split == Split::kDefault) {
    settings.split = Split::kShot;
  }
  return settings;
}

std::vector<SettingDefect> FindSettingDefects(const MethodInfo& method,
                                              const FractalSettings& settings) {
  std::vector<SettingDefect> defects;
  const FractalSettings resolved = ResolveSettings(method, settings);
  CheckNumbers(method, resolved, &defects);
  CheckChoices(method, resolved, &defects);
  return defects;
}

Errors CheckSettings(const MethodInfo& method, const FractalSettings& settings) {
  Errors errors;
  for (SettingDefect& defect : FindSettingDefects(method, settings)) {
    errors.push_back(Invalid("fractal." + std::string(defect.field) + ": " + defect.message));
  }
  return errors;
}

std::string_view LawName(Law law) {
  constexpr std::string_view kNames[] = {"LAW_DEFAULT", "AFFINE", "SIMILAR", "SHIH"};
  const auto number = static_cast<uint32_t>(law);
  return number < std::size(kNames) ? kNames[number] : "(unknown)";
}

std::string_view DirectionName(Direction direction) {
  constexpr std::string_view kNames[] = {"DIRECTION_DEFAULT", "EDGE", "FACE", "VERTEX", "UP"};
  const auto number = static_cast<uint32_t>(direction);
  return number < std::size(kNames) ? kNames[number] : "(unknown)";
}

std::string_view VariantName(Variant variant) {
  constexpr std::string_view kNames[] = {"VARIANT_DEFAULT", "FIXED", "CURRENT", "PERTURBED"};
  const auto number = static_cast<uint32_t>(variant);
  return number < std::size(kNames) ? kNames[number] : "(unknown)";
}

std::string_view SplitName(Split split) {
  constexpr std::string_view kNames[] = {"SPLIT_DEFAULT", "SHOT", "ADAPTIVE", "LENGTH"};
  const auto number = static_cast<uint32_t>(split);
  return number < std::size(kNames) ? kNames[number] : "(unknown)";
}

}  // namespace fjord
